// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/point_location.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry {

/// Points to be located lie on this fraction of the grid, so that the location is exact.
inline constexpr std::int64_t kFieldDenominator = 4096;

/// Relative error bound of a distance in double arithmetic: far above the rounding of
/// nearest_triangle, far below a grid unit for a kilometre.
inline constexpr double kFieldError = 1e-12;

[[nodiscard]] inline Vec3d on_field_grid(const Vec3d& p) {
  return in_steps(p, static_cast<double>(kFieldDenominator));
}

/// The distance to a part's surface, and the side, of points relative to a common origin.
class DistanceField {
 public:
  /// `shift` = common origin minus the part's origin, grid units. `planes`: the part's, for callers
  /// of planes() and vertices().
  DistanceField(const PartWithBvh& part, const Vec3l& shift, const FaceKdop* planes = nullptr)
      : part_(&part), shift_(shift), planes_(planes) {}

  /// Prepares a small part for many queries: its triangles and, where these are rotated slivers,
  /// whose boxes along the axes are useless, a frame along them. Results stay the same.
  void prepare();

  /// In the part's own coordinates.
  [[nodiscard]] PreparedTriangle triangle(std::uint32_t t) const {
    return prepared_.empty() ? PreparedTriangle(corners_of(part(), t)) : prepared_[t];
  }
  [[nodiscard]] Corners corners(std::uint32_t t) const {
    return prepared_.empty() ? corners_of(part(), t) : prepared_[t].corners;
  }
  /// Returns the corners relative to the common origin. They are not copied before the shift:
  /// reading back in other widths what was just written would take most of the time.
  [[nodiscard]] Corners placed(std::uint32_t t) const {
    const auto moved = [this](const Corners& c) {
      return Corners{common(c[0]), common(c[1]), common(c[2])};
    };
    return prepared_.empty() ? moved(corners_of(part(), t)) : moved(prepared_[t].corners);
  }

  [[nodiscard]] PreparedTriangle placed_triangle(std::uint32_t t) const {
    return prepared_.empty() ? PreparedTriangle(placed(t))
                             : prepared_[t].moved(-shift_.as<double>());
  }

  /// Returns the location of a point; exact for points of on_field_grid().
  [[nodiscard]] PointSide side(const Vec3d& p, QueryContext& work) const {
    constexpr double kSteps = static_cast<double>(kFieldDenominator);
    const Vec3l numerator{std::llround(p.x * kSteps) + shift_.x * kFieldDenominator,
                          std::llround(p.y * kSteps) + shift_.y * kFieldDenominator,
                          std::llround(p.z * kSteps) + shift_.z * kFieldDenominator};
    return side_of(*part_, numerator, kFieldDenominator, work, frame_.get());
  }

  /// Whether the closed solid contains a point, on its boundary too.
  [[nodiscard]] bool contains(const Vec3d& p, QueryContext& work) const {
    return side(p, work) != PointSide::outside;
  }

  [[nodiscard]] NearestTriangle nearest(
      const Vec3d& p, std::uint32_t hint = kNoIndex,
      double limit = std::numeric_limits<double>::infinity()) const {
    return nearest_triangle({part(), *part_->tree, frame_.get(), prepared_}, local(p), hint, limit);
  }

  /// Returns an upper bound of nearest().distance.
  [[nodiscard]] double distance_upper_bound(const Vec3d& p) const {
    return geometry::distance_upper_bound({part(), *part_->tree, frame_.get(), prepared_},
                                          local(p));
  }

  /// Calls visit(triangle) for the triangles whose boxes may be within `slack` of the box of some
  /// points, until it returns false. Returns whether it never did.
  template <class Visit>
  bool for_each_near(std::span<const Vec3d> points, double slack, const Visit& visit) const {
    Box3d box = empty_box<double>();
    for (const Vec3d& p : points) box.include(in_tree(p));
    box = box.inflated(slack + tree_margin());
    return walk([&](const Box3d& other) { return other.meets(box); }, visit);
  }
  /// Does the same for the triangles whose boxes may be within `distance` of a point.
  template <class Visit>
  bool for_each_near(const Vec3d& p, double distance, const Visit& visit) const {
    const Vec3d at = in_tree(p);
    const double reach = distance + tree_margin();
    return walk([&](const Box3d& box) { return squared_gap(at, box) <= reach * reach; }, visit);
  }

  [[nodiscard]] Vec3d local(const Vec3d& p) const { return p + shift_.as<double>(); }
  [[nodiscard]] Vec3d common(const Vec3d& p) const { return p - shift_.as<double>(); }
  [[nodiscard]] PairLocalPart view() const { return {*part_, Vec3l{} - shift_}; }
  [[nodiscard]] const Part& part() const { return *part_->placed.part; }
  [[nodiscard]] Box3d box() const { return part().box.as<double>().moved(-shift_.as<double>()); }
  /// Returns the tree in the part's own frame.
  [[nodiscard]] const TriangleBvh& tree() const { return *part_->tree; }
  /// In the part's own coordinates.
  [[nodiscard]] const SupportTree& vertices() const { return planes_->vertices; }
  /// In the part's own coordinates; may be null.
  [[nodiscard]] const FaceKdop* planes() const { return planes_; }
  [[nodiscard]] ProjectionInterval range_along(const Vec3d& axis) const {
    if (has_many_vertices()) {
      const double at = dot(axis, common({}));
      return {at - vertices().support_along(-axis).value,
              at + vertices().support_along(axis).value};
    }
    ProjectionInterval r;
    for (const Vec3i& v : part().vertices) r.include(dot(axis, common(v.as<double>())));
    return r;
  }
  [[nodiscard]] bool has_many_vertices() const { return part().vertices.size() >= kManyVertices; }

 private:
  [[nodiscard]] Vec3d in_tree(const Vec3d& p) const {
    return frame_ ? turned(frame_->axes, local(p)) : local(p);
  }
  /// Returns the error bound of boxes.
  [[nodiscard]] double tree_margin() const {
    return frame_ ? kRotationRounding + kFrameRounding : 0;
  }

  /// Calls visit(triangle) for the triangles whose boxes are near.
  template <class Near, class Visit>
  bool walk(const Near& near, const Visit& visit) const {
    const auto of_node = [&](const TriangleBvh::Node& node) { return near(node.box.as<double>()); };
    if (!frame_) return traverse_bvh(tree(), of_node, visit);
    const Part& rotated_part = frame_->part.part;
    return traverse_bvh(frame_->part.tree, of_node, [&](std::uint32_t t) {
      return !near(box_of(corners_of(rotated_part, t))) || visit(t);
    });
  }

  const PartWithBvh* part_;
  Vec3l shift_;
  const FaceKdop* planes_;
  std::vector<PreparedTriangle> prepared_;
  std::shared_ptr<const RotatedFrame> frame_;
};

/// Returns the distance of a point to the farther of two surfaces. In the middle of a round body
/// its whole surface is about equally near: the nearer one is searched only where it could be the
/// farther.
[[nodiscard]] inline double greater_distance(const DistanceField& a, const DistanceField& b,
                                             const Vec3d& p) {
  const double some_a = a.distance_upper_bound(p), some_b = b.distance_upper_bound(p);
  const DistanceField &far = some_a >= some_b ? a : b, &near = some_a >= some_b ? b : a;
  const double greater = far.nearest(p).distance;
  return std::min(some_a, some_b) <= greater ? greater
                                             : std::max(greater, near.nearest(p).distance);
}

}  // namespace strake::geometry
