// SPDX-License-Identifier: Apache-2.0
// The order in which people expect names with numbers: "P2" before "P10".
#pragma once

#include <string_view>

namespace strake::sheets {

/// Returns whether one name comes before another. Digits that follow each other are compared as
/// the number that they write, everything else byte by byte. Of names that differ in leading zeros
/// only, the one with fewer of them at the first such place comes first; so it is a total order.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace strake::sheets
