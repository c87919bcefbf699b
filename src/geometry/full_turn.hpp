// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/trig.hpp"

namespace strake::geometry {

/// Whether an angle, radians, is all of a turn: float32 sources write 2·pi a little short or long.
[[nodiscard]] inline bool is_full_turn(double angle) { return angle >= 2 * kPi * (1 - 1e-6); }

}  // namespace strake::geometry
