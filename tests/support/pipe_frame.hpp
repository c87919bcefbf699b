// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "strake/geometry/vec.hpp"

namespace strake::test {

/// The matrix of columns x, y and z.
[[nodiscard]] inline geometry::Mat3d from_columns(const geometry::Vec3d& x,
                                                  const geometry::Vec3d& y,
                                                  const geometry::Vec3d& z) {
  return {{geometry::Vec3d{x.x, y.x, z.x}, geometry::Vec3d{x.y, y.y, z.y},
           geometry::Vec3d{x.z, y.z, z.z}}};
}

/// The local frame at the end of an elbow (`angle`: its sweep) or at its start (0), z along the
/// pipe, x and y turned by `roll`.
[[nodiscard]] inline geometry::Mat3d pipe_frame(const geometry::Mat3d& elbow, double angle,
                                                double roll) {
  const geometry::Vec3d x = elbow * geometry::Vec3d{std::cos(angle), std::sin(angle), 0};
  const geometry::Vec3d y = elbow * geometry::Vec3d{0, 0, 1};
  const geometry::Vec3d z = elbow * geometry::Vec3d{-std::sin(angle), std::cos(angle), 0};
  return from_columns(x * std::cos(roll) + y * std::sin(roll),
                      y * std::cos(roll) - x * std::sin(roll), z);
}

}  // namespace strake::test
