// SPDX-License-Identifier: Apache-2.0
#include "geometry/lower_dimensional/sheet_piercing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/interior_depth/sheets/sheet_boundary.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "strake/geometry/intersect.hpp"

namespace strake::geometry::lower_dimensional {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

class PiercingSearch {
 public:
  PiercingSearch(const LowerDimensionalBody& line, const PartWithBvh& sheet)
      : line_(line),
        sheet_(sheet, {}),
        shift_(line.origin - sheet.placed.origin),
        boundary_(boundary_edges(*sheet.placed.part)),
        neighbours_(line.vertices.size(), {kNone, kNone}),
        degree_(line.vertices.size(), 0) {
    for (const auto& [u, v] : line.segments) {
      add_neighbour(u, v);
      add_neighbour(v, u);
    }
    const Box3i& box = sheet.placed.part->box;
    size_ = length((box.hi - box.lo).as<double>());
  }

  SheetPiercing run() {
    for (const auto& [u, v] : line_.segments) walk(u, v);
    return best_;
  }

 private:
  void add_neighbour(std::uint32_t at, std::uint32_t other) {
    if (degree_[at] < 2) neighbours_[at][degree_[at]] = other;
    ++degree_[at];
  }

  [[nodiscard]] Vec3l place(std::uint32_t v) const {
    return line_.vertices[v].as<std::int64_t>() + shift_;
  }

  void walk(std::uint32_t u, std::uint32_t v) {
    Box3l box{place(u), place(u)};
    box.include(place(v));
    traverse_bvh(
        sheet_.tree(),
        [&](const TriangleBvh::Node& node) { return sheet_.box(node.box).meets(box); },
        [&](std::uint32_t triangle) {
          visit(u, v, sheet_.corners(triangle));
          return true;
        });
  }

  void visit(std::uint32_t u, std::uint32_t v, const TriangleCorners& t) {
    const GridLine segment{place(u), place(v), LineKind::segment};
    const LineInTriangle hit = intersect(segment, t);
    if (hit.at.touch != Touch::point || hit.coplanar) return;
    const bool through = hit.side_from * hit.side_to < 0 ||
                         (hit.side_to == 0 && goes_on(u, v, t, hit.side_from)) ||
                         (hit.side_from == 0 && goes_on(v, u, t, hit.side_to));
    if (through) offer(point_at(segment, hit.at.first).value());
  }

  /// Whether the line that comes to `at`, a point of the triangle, leaves it on the other side.
  [[nodiscard]] bool goes_on(std::uint32_t from, std::uint32_t at, const TriangleCorners& t,
                             int side) const {
    if (degree_[at] != 2) return false;
    const std::uint32_t to = neighbours_[at][0] == from ? neighbours_[at][1] : neighbours_[at][0];
    return orient3d(t[0], t[1], t[2], place(to)) * side < 0;
  }

  void offer(const Vec3d& p) {
    double depth = size_;
    for (const auto& [from, to] : boundary_)
      depth = std::min(depth, length(p - nearest_on_segment(p, from, to)));
    for (std::uint32_t v = 0; v < degree_.size() && depth > best_.depth; ++v)
      if (degree_[v] == 1) depth = std::min(depth, length(p - place(v).as<double>()));
    if (depth > best_.depth) best_ = {depth, p};
  }

  const LowerDimensionalBody& line_;
  PairLocalPart sheet_;
  Vec3l shift_;
  std::vector<std::array<Vec3d, 2>> boundary_;
  std::vector<std::array<std::uint32_t, 2>> neighbours_;
  std::vector<std::uint32_t> degree_;  ///< segments at each vertex
  double size_ = 0;                    ///< what a crossing without rims and ends counts as
  SheetPiercing best_;
};

}  // namespace

SheetPiercing deepest_piercing(const LowerDimensionalBody& line, const PartWithBvh& sheet) {
  return PiercingSearch(line, sheet).run();
}

}  // namespace strake::geometry::lower_dimensional
