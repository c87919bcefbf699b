// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/section/fill.hpp"
#include "strake/geometry/plane_cut.hpp"

namespace strake::geometry::section {

/// The rim that a cut leaves of one triangle, in the triangle's sense.
struct Stretch {
  Directed ends{};
  std::uint32_t triangle = 0;
};

struct Outline {
  std::vector<Segment> lines;   ///< each once, ascending ends, in no order
  std::uint32_t open_ends = 0;  ///< vertices where an odd number of stretches meet
};

/// The lines of a cut: stretches that follow each other in one plane are one. Of stretches that
/// lie on each other one is kept. `coplanar(s, t)` says whether two triangles lie in one plane and
/// face one way.
[[nodiscard]] Outline outline_of(std::vector<Stretch> stretches, std::span<const Vec3l> vertices,
                                 const std::function<bool(std::uint32_t, std::uint32_t)>& coplanar);

}  // namespace strake::geometry::section
