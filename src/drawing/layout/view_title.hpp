// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/hlr/hlr.hpp"

namespace strake::drawing {

/// Returns the title of a view that has none of its own: what it is called, and which section it
/// is.
///
/// "SECTION z = 4.5 m" for one section plane that is seen square; "iso, SECTION z = 4.5 m, x = 2 m"
/// for others. A plane across no axis has its normal and its distance from the model's origin, as
/// in drawing::parse_section(): "SECTION 1,2,0 = 4.5 m", whichever side is cut away; its first
/// component that is not 0 is positive. Lengths below a metre are millimetres.
[[nodiscard]] std::string title_of(std::string_view name, const hlr::View& view);

}  // namespace strake::drawing
