// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sheets/arrangement.hpp"
#include "sheets/description.hpp"
#include "sheets/placeholders.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Where the views of a sheet may lie: within its frame, beside its title block.
[[nodiscard]] Room room_of(const Description& sheet);

/// The fields of the built-in title block (ISO 7200).
[[nodiscard]] std::vector<std::string> title_block_fields();

/// The built-in border (ISO 5457: 20 mm for binding, 10 mm elsewhere, centring marks and reference
/// fields) and title block. `narrow`, if not null, gets the names of fields whose texts are too
/// long for their boxes in any letters that can be read.
[[nodiscard]] Marks draw_frame(const Description& sheet, Lookup field,
                               std::vector<std::string>* narrow);

}  // namespace strake::sheets
