// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "strake/model/scene.hpp"

namespace strake::model {

/// An end of an object in the scene.
struct ObjectEnd {
  geometry::Vec3l at;       ///< the centre of the end, on the grid
  geometry::Vec3d outward;  ///< a unit vector along the axis there, out of the object
  std::uint32_t object = 0;
};

/// Returns the ends of the objects for which `among` holds, by object and body: of physical bodies
/// as placed, primitives by their measures, meshes as ends_of() finds them.
[[nodiscard]] std::vector<ObjectEnd> ends_of(const Scene& scene, const std::vector<bool>& among);

/// Returns the pairs of objects, ascending, each once and its lower number first, of which an end
/// of the one meets an end of the other: the centres are no farther apart than `within` grid units,
/// at most 2^30, and the axes point at each other to within 30 degrees. The places are compared
/// exactly; ends are looked up by cells of that size. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> joints_of(
    std::vector<ObjectEnd> ends, std::int64_t within, const parallel::Context& context);

}  // namespace strake::model
