// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sheets/arrangement/view_paper.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Appends a dimension to a view (ISO 129-1): extension lines, the line with filled arrows, which
/// point inwards where there is no room between them, and the value in millimetres of the model:
/// above a level line, and elsewhere in a gap of it, always to be read from below (ISO 129:1985,
/// method 2).
///
/// Errors: input, where the view is in perspective, an object is not there or one of several of
/// its name, sides of objects are requested in a view that looks along no axis of the model, or the
/// two ends lie on each other.
[[nodiscard]] Status draw_dimension(const DimensionSpec& spec, const model::Scene& scene,
                                    const MarkedView& in, Marks& marks);

}  // namespace strake::sheets
