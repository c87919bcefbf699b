// SPDX-License-Identifier: Apache-2.0
// The frame of a sheet: the built-in border and title block, and the fields of either frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "sheets/spec/template.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns the area where the views of a sheet may lie: within its frame, beside its title block.
[[nodiscard]] SheetArea sheet_area_of(const SheetSpec& sheet);

/// Returns the fields of the built-in title block (ISO 7200).
[[nodiscard]] std::vector<std::string> title_block_fields();

/// Draws the built-in border (ISO 5457: 20 mm for binding, 10 mm elsewhere, centring marks and
/// reference fields) and title block. `narrow`, if not null, receives the names of fields whose
/// texts are too long for their boxes at any legible size.
[[nodiscard]] Marks draw_frame(const SheetSpec& sheet, Lookup field,
                               std::vector<std::string>* narrow);

/// Draws frame and title block of a sheet, built-in or from its template, with the fields of the
/// file and the automatic ones: scale (a dash where the sheet has none), size, projection. Reports
/// fields without a value and values without a field.
void fill_frame(const SheetSpec& what, std::optional<double> scale, Sheet& sheet);

}  // namespace strake::sheets
