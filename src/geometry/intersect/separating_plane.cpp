// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/separating_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/bvh/traversal.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// Parts with fewer vertices are tested vertex by vertex: cheaper than traversing the tree. Between
/// 12 and 192 ships show no difference (decision 0073).
constexpr std::size_t kFewPlaneVertices = 48;

Vec3d absolute(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
double largest_component(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

class SideTraversal {
 public:
  /// side: -1 or 1; strict: points of the plane count as on the wrong side.
  SideTraversal(const ExactTriangle& t, int side, bool strict)
      : plane_(t.plane), side_(side), least_(strict ? 1 : 0) {
    anchor_ = t.corner[0].as<double>();
    // Rounding of the normal and of a product with it: below 64 roundings of |u||v| a component.
    slack_ = 0x1p-47 * largest_component(absolute((t.corner[1] - t.corner[0]).as<double>())) *
             largest_component(absolute((t.corner[2] - t.corner[0]).as<double>()));
  }

  /// Whether all vertices are on the wanted side; stops at the first that is not.
  [[nodiscard]] bool all_on_side(const PairLocalPart& view);
  [[nodiscard]] bool leaves_plane() const { return leaves_plane_; }

 private:
  [[nodiscard]] bool accept(const Vec3l& p) {
    const int side = plane_.side(p) * side_;
    leaves_plane_ |= side > 0;
    return side >= least_;
  }
  /// Whether all of the box certainly lies strictly on the wanted side.
  [[nodiscard]] bool clear(const Box3l& box) const {
    const Vec3d centre = (box.lo + box.hi).as<double>() * 0.5 - anchor_;
    const Vec3d half = (box.hi - box.lo).as<double>() * 0.5;
    const Vec3d& n = plane_.normal();
    const double reach =
        dot(absolute(n), half) + slack_ * largest_component(absolute(centre) + half);
    return dot(n, centre) * side_ > reach;
  }
  [[nodiscard]] bool traverse(const PairLocalPart& view);

  const ExactPlane& plane_;
  Vec3d anchor_;
  double slack_ = 0;
  int side_, least_;
  bool leaves_plane_ = false;
};

bool SideTraversal::all_on_side(const PairLocalPart& view) {
  const std::vector<Vec3i>& vertices = view.part().vertices;
  if (vertices.size() > kFewPlaneVertices) return traverse(view);
  return std::ranges::all_of(
      vertices, [&](const Vec3i& v) { return accept(v.as<std::int64_t>() + view.shift()); });
}

bool SideTraversal::traverse(const PairLocalPart& view) {
  return traverse_bvh(
      view.tree(),
      [&](const TriangleBvh::Node& node) {
        const bool all_beyond = clear(view.box(node.box));
        leaves_plane_ |= all_beyond;
        return !all_beyond;
      },
      [&](std::uint32_t triangle) {
        return std::ranges::all_of(view.corners(triangle),
                                   [&](const Vec3l& p) { return accept(p); });
      });
}

bool keeps_to(const ExactTriangle& triangle, int side, const PairLocalPart& view) {
  SideTraversal traversal(triangle, side, false);
  return traversal.all_on_side(view) && (view.solid() || traversal.leaves_plane());
}

}  // namespace

bool is_separating_plane(const ExactTriangle& triangle, const PairLocalPart& below,
                         const PairLocalPart& above) {
  return keeps_to(triangle, -1, below) && keeps_to(triangle, 1, above);
}

bool is_strictly_separating_plane(const ExactTriangle& triangle, const PairLocalPart& below,
                                  const PairLocalPart& above) {
  return SideTraversal(triangle, 1, true).all_on_side(above) &&
         SideTraversal(triangle, -1, false).all_on_side(below);
}

namespace {

/// Most vertices of a times triangles of b. Two tubes of 192 triangles, one in the other, take
/// 25 µs; a pair that crosses fails at the first few planes (decision 0030).
constexpr std::size_t kMaxSides = std::size_t{1} << 16U;

/// The planes last found to have a on one side: files often alternate between faces.
class RecentPlanes {
 public:
  /// Whether a triangle lies in one of them, which then becomes the latest.
  bool holds(const ExactTriangle& t) {
    for (std::size_t i = 0; i < planes_.size() && planes_[i]; ++i) {
      const ExactPlane& plane = *planes_[i];
      if (std::ranges::any_of(t.corner, [&](const Vec3l& p) { return plane.side(p) != 0; }))
        continue;
      std::rotate(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(i),
                  planes_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      return true;
    }
    return false;
  }
  void add(const ExactPlane& plane) {
    std::ranges::rotate(planes_, planes_.end() - 1);
    planes_.front() = plane;
  }

 private:
  std::array<std::optional<ExactPlane>, 4> planes_;
};

}  // namespace

bool lies_on_one_side(const PairLocalPart& a, const PairLocalPart& b) {
  const auto vertices = static_cast<std::uint32_t>(a.part().vertices.size());
  const auto triangles = static_cast<std::uint32_t>(b.part().triangles.size());
  if (std::size_t{vertices} * triangles > kMaxSides) return false;
  RecentPlanes known;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const ExactTriangle face = b.triangle(t);
    if (known.holds(face)) continue;
    int side = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const int other = face.plane.side(a.vertex(v));
      if (side * other < 0) return false;
      if (other != 0) side = other;
    }
    if (side == 0) return false;
    known.add(face.plane);
  }
  return true;
}

}  // namespace strake::geometry
