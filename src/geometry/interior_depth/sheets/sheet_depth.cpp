// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/bvh/traversal.hpp"
#include "geometry/interior_depth/bounds/inscribed_ball.hpp"
#include "geometry/interior_depth/sheets/simplex_depth_search.hpp"
#include "geometry/interior_depth/solid_depth_search.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// Upper bound of a sheet in a solid: half-spaces of the solid for the ball, of both for its
/// centre.
double hull_bound(const DepthOperand& sheet, const DistanceField& fs, const DepthOperand& solid,
                  const DistanceField& fb, double extent) {
  std::vector<BallConstraint> rows;
  const Box3i& box = sheet.treed.placed.part->box;
  const Vec3d centre = (box.lo.as<double>() + box.hi.as<double>()) * 0.5;
  const auto add = [&](const DistanceField& f, const Vec3d& n, double support, double weight) {
    rows.push_back({n, weight, support - dot(n, f.local(centre)) + kFieldError * extent});
  };
  for (std::size_t i = 0; i < 4; ++i)
    add(fb, tetrahedral_directions()[i], solid.planes->tetrahedral[i], 1);
  for (const auto& p : solid.planes->planes) add(fb, p.normal, p.support, 1);
  for (const auto& p : sheet.planes->planes) {
    add(fs, p.normal, p.support, 0);
    add(fs, -p.normal, sheet.planes->vertices.support_along(-p.normal).value, 0);
  }
  return std::max(0.0, largest_inscribed_ball({rows, extent}).upper);
}

/// The triangles of a sheet that may reach into a box, in their order; all of a small one.
std::vector<Corners> pieces_near(const DistanceField& sheet, const Box3d& search_box) {
  std::vector<std::uint32_t> near;
  if (sheet.has_many_vertices()) {
    const Box3d own{sheet.local(search_box.lo), sheet.local(search_box.hi)};
    traverse_bvh(
        sheet.tree(),
        [&](const TriangleBvh::Node& node) { return node.box.as<double>().meets(own); },
        [&](std::uint32_t t) {
          near.push_back(t);
          return true;
        });
    std::ranges::sort(near);
  } else {
    near.resize(sheet.part().triangles.size());
    std::iota(near.begin(), near.end(), 0U);
  }
  std::vector<Corners> pieces;
  pieces.reserve(near.size());
  for (const std::uint32_t t : near) pieces.push_back(corners_of(sheet.part(), t));
  return pieces;
}

}  // namespace

Depth sheet_in_solid_depth(const DepthOperand& sheet, const DepthOperand& solid,
                           const DepthOptions& goal, QueryContext& work) {
  const DistanceField fs(sheet.treed, {}, sheet.planes);
  const DistanceField fb(solid.treed, sheet.treed.placed.origin - solid.treed.placed.origin,
                         solid.planes);
  double extent = 1;
  for (const Part* part : {&fs.part(), &fb.part()})
    for (int k = 0; k < 3; ++k)
      extent = std::max(extent, 2.0 * (static_cast<double>(part->box.hi[k]) -
                                       static_cast<double>(part->box.lo[k])));
  Depth depth;
  depth.upper = hull_bound(sheet, fs, solid, fb, extent);
  const std::vector<Corners> pieces = pieces_near(fs, fb.box());
  SimplexDepthSearch<3>(pieces, fb, goal, depth, kFieldError * extent, work,
                        fs.part().triangles.size())
      .run();
  depth.upper = std::max(depth.upper, depth.value);
  return depth;
}

}  // namespace strake::geometry
