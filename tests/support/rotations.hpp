// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/vec.hpp"

namespace strake::test {

/// A turn about no axis of the grid, in thirds and fifteenths.
inline constexpr geometry::Mat3d kTurn{{geometry::Vec3d{-2.0 / 3, 2.0 / 15, 11.0 / 15},
                                        geometry::Vec3d{2.0 / 3, -1.0 / 3, 2.0 / 3},
                                        geometry::Vec3d{1.0 / 3, 14.0 / 15, 2.0 / 15}}};

}  // namespace strake::test
