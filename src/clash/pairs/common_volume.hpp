// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace strake::clash {

/// The volume that the solids of two objects have in common, as Pair::volume_mm3 adds it up, with a
/// bracket that also holds what tessellation and snap account for. Cubic millimetres.
struct CommonVolume {
  double lower = 0, upper = 0;

  /// It is not known how much more there is: sheets have no volume, and some solids take too long.
  void add_unknown() { upper = std::numeric_limits<double>::infinity(); }

  /// Whether it is certainly at most, or certainly less than, a limit; a volume just at the limit
  /// is known to the rounding of its sum.
  [[nodiscard]] bool is_at_most(double limit) const { return upper <= limit * (1 + kRounding); }
  [[nodiscard]] bool is_less_than(double limit) const { return upper < limit * (1 - kRounding); }
  /// Whether it may be so.
  [[nodiscard]] bool may_be_at_most(double limit) const { return lower <= limit * (1 + kRounding); }
  [[nodiscard]] bool may_be_less_than(double limit) const {
    return lower < limit * (1 - kRounding);
  }

 private:
  static constexpr double kRounding = 1e-9;
};

}  // namespace strake::clash
