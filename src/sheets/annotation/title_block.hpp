// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "sheets/spec/template.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Where the views of a sheet may lie: within its frame, beside its title block.
[[nodiscard]] SheetArea sheet_area_of(const SheetSpec& sheet);

/// The fields of the built-in title block (ISO 7200).
[[nodiscard]] std::vector<std::string> title_block_fields();

/// The built-in border (ISO 5457: 20 mm for binding, 10 mm elsewhere, centring marks and reference
/// fields) and title block. `narrow`, if not null, gets the names of fields whose texts are too
/// long for their boxes in any letters that can be read.
[[nodiscard]] Marks draw_frame(const SheetSpec& sheet, Lookup field,
                               std::vector<std::string>* narrow);

/// Draws frame and title block of a sheet, built-in or from its template, with the fields of the
/// file and those that the sheet knows itself: scale, size, projection. Names what is not filled
/// and what there is no place for.
void fill_frame(const SheetSpec& what, double scale, Sheet& sheet);

}  // namespace strake::sheets
