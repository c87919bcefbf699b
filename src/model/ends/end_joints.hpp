// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "strake/model/scene.hpp"

namespace strake::model {

/// An end of an object in the scene.
struct ObjectEnd {
  geometry::Vec3l at;       ///< the centre of the end, on the grid
  geometry::Vec3d outward;  ///< a unit vector along the axis there, out of the object
  std::uint32_t object = 0;
  /// How far the body extends behind the end along the axis, in grid units.
  double reach = std::numeric_limits<double>::infinity();
};

/// Returns the ends of the objects for which `among` holds, by object and body: of physical bodies
/// as placed, primitives by their measures, meshes as ends_of() finds them. A flat body has none.
[[nodiscard]] std::vector<ObjectEnd> ends_of(const Scene& scene, const std::vector<bool>& among);

/// Returns the pairs of objects, ascending, each once and its lower number first, of which an end
/// of the one meets an end of the other. Two ends meet if
/// - the centres are no farther apart than `within` grid units, at most 2^30, which is compared
///   exactly; ends are looked up by cells of that size;
/// - the axes point at each other to within 30 degrees;
/// - the bodies lie on opposite sides: neither end is farther behind the plane of the other than
///   half the reach of the shorter of the two.
/// They join their objects unless each object goes on beyond its own end as far as the other does:
/// then both have both sides, and the ends are a seam of either. So an object is never joined to an
/// exact copy of itself. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> joints_of(
    std::vector<ObjectEnd> ends, std::int64_t within, const parallel::Context& context);

}  // namespace strake::model
