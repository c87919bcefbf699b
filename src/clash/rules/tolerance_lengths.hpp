// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "strake/clash/options.hpp"

namespace strake::clash {

/// A length among the tolerances, as people and documents call it.
struct ToleranceLength {
  std::string_view name;  ///< as in rules files: "touch_gap"; documents add its unit
  double Tolerances::* value_mm;
  std::string_view help;  ///< for the command line

  /// The name with another character between its words: "touch-gap".
  [[nodiscard]] std::string name_with(char between) const {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', between);
    return text;
  }
};

/// All lengths of Tolerances, in the order in which they are checked and written. Command line,
/// rules files, checks and results go by this table.
inline constexpr std::array kToleranceLengths{
    ToleranceLength{"clearance", &Tolerances::clearance_mm,
                    "Pairs nearer than this violate it; '@INSU + 25mm' adds what both objects of a "
                    "pair have as that attribute (default 0)"},
    ToleranceLength{"touch_gap", &Tolerances::touch_gap_mm,
                    "Up to this far apart is a contact (default 1mm)"},
    ToleranceLength{"touch_overlap", &Tolerances::touch_overlap_mm,
                    "Up to this deep is a contact (default 1mm)"},
};

}  // namespace strake::clash
