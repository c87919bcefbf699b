// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sheets/description.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Draws frame and title block of a sheet, built-in or from its template, with the fields of the
/// file and those that the sheet knows itself: scale, size, projection. Names what is not filled
/// and what there is no place for.
void fill_frame(const Description& what, double scale, Sheet& sheet);

}  // namespace strake::sheets
