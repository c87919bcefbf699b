// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The fixed absolute grid on which every exact decision is taken: one unit is one micrometre. It
/// is fixed so that no object's position depends on the other objects of the model.
inline constexpr double kGridPerMm = 1000.0;
inline constexpr double kMmPerGrid = 1.0 / kGridPerMm;

/// Largest absolute coordinate that can be placed: 2^50 units, about 1.1 million kilometres.
inline constexpr double kMaxGridMm = 1125899906842624.0 / kGridPerMm;

/// Returns the grid value nearest to a coordinate in millimetres, ties away from zero; nothing when
/// the coordinate is not finite or lies beyond kMaxGridMm.
[[nodiscard]] inline std::optional<std::int64_t> snap(double mm) {
  if (!(std::fabs(mm) <= kMaxGridMm)) return std::nullopt;
  const double scaled = mm * kGridPerMm;
  const auto whole = static_cast<std::int64_t>(scaled);
  const double rest = scaled - static_cast<double>(whole);  // exact: |scaled| <= 2^50
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

[[nodiscard]] inline std::optional<Vec3l> snap(const Vec3d& mm) {
  const auto x = snap(mm.x), y = snap(mm.y), z = snap(mm.z);
  if (!x || !y || !z) return std::nullopt;
  return Vec3l{*x, *y, *z};
}

/// The point nearest to p, in grid units, of a grid that is `steps` times finer.
[[nodiscard]] inline Vec3d in_steps(const Vec3d& p, double steps) {
  return {std::nearbyint(p.x * steps) / steps, std::nearbyint(p.y * steps) / steps,
          std::nearbyint(p.z * steps) / steps};
}

/// Converts back to millimetres (for output only, never for a decision).
[[nodiscard]] constexpr Vec3d to_mm(const Vec3d& grid) {
  return {grid.x / kGridPerMm, grid.y / kGridPerMm, grid.z / kGridPerMm};
}
[[nodiscard]] constexpr Vec3d to_mm(const Vec3l& grid) { return to_mm(grid.as<double>()); }

}  // namespace strake::geometry
