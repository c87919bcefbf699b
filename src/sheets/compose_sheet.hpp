// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"
#include "strake/sheets/sheet_file.hpp"

namespace strake::sheets {

/// Composes the sheet that a file describes for a scene.
[[nodiscard]] Result<Sheet> compose(const SheetSpec& what, const model::Scene& scene,
                                    const ComposeOptions& options,
                                    const parallel::Context& context);

}  // namespace strake::sheets
