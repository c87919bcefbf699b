// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/tessellate/build.hpp"

namespace strake::geometry::tessellation {

/// A point of a profile: distance from the axis and height along it.
struct ProfilePoint {
  double radius = 0, z = 0;
};

/// How a profile is swept about the local Z axis.
struct Sweep {
  std::vector<SinCos> directions;  ///< one more than there are steps, unless full
  bool full = false;               ///< the last direction is followed by the first again
};

/// Sweeps a profile, counter-clockwise in (radius, z), whose points at radius 0 stay on the axis.
/// An open profile with both ends on the axis, or a loop, gives a closed surface; a partial sweep
/// gets planar caps, which must be convex.
///
/// at(i, j) is point i of the profile at direction j; points at radius 0 must be so for every j.
template <class At>
std::vector<std::vector<std::uint32_t>> revolve(Builder& builder, const Sweep& sweep,
                                                std::size_t points, bool loop, At&& at) {
  const std::size_t count = sweep.directions.size();
  std::vector<std::vector<std::uint32_t>> grid(points, std::vector<std::uint32_t>(count));
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const ProfilePoint p = at(i, j);
      const SinCos& d = sweep.directions[j];
      grid[i][j] = p.radius == 0 && j > 0
                       ? grid[i][0]
                       : builder.vertex({p.radius * d.cos, p.radius * d.sin, p.z});
    }
  const std::size_t bands = loop ? points : points - 1;
  for (std::size_t i = 0; i < bands; ++i) {
    const auto &low = grid[i], &high = grid[i + 1 == points ? 0 : i + 1];
    const bool flat = at(i, 0).z == at(i + 1 == points ? 0 : i + 1, 0).z && loop && points == 4;
    const std::uint32_t annulus = flat ? builder.face() : 0;
    for (std::size_t j = 0; j + (sweep.full ? 0 : 1) < count; ++j) {
      const std::size_t k = j + 1 == count ? 0 : j + 1;
      if (flat)
        builder.quad_of(annulus, low[j], low[k], high[k], high[j]);
      else
        builder.quad(low[j], low[k], high[k], high[j]);
    }
  }
  if (sweep.full) return grid;
  std::vector<std::uint32_t> first, last;
  for (const auto& row : grid) {
    first.push_back(row.front());
    last.push_back(row.back());
  }
  builder.polygon(first);
  builder.polygon(last, true);
  return grid;
}

}  // namespace strake::geometry::tessellation
