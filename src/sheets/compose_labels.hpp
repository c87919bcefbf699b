// SPDX-License-Identifier: Apache-2.0
// The labels of a sheet, from what its file says, and what is reported about them.
#pragma once

#include <span>
#include <vector>

#include "sheets/arrangement/free_place.hpp"
#include "sheets/place_notes.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Writes tags and balloons on a sheet on which all else stands. `picked` are the objects of each
/// [[tag]]; `notes` says which objects the rows of the lists are. Warns of labels that the sheet
/// lacks. Errors: cancelled.
[[nodiscard]] Status compose_labels(const SheetSpec& what, const model::Model& model,
                                    std::span<const std::vector<bool>> picked, const Notes& notes,
                                    const SheetArea& room, Sheet& sheet,
                                    const parallel::Context& context);

}  // namespace strake::sheets
