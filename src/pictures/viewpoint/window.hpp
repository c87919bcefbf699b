// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "pictures/scenery/surroundings.hpp"
#include "pictures/viewpoint/camera.hpp"

namespace strake::pictures {

/// What is looked at: a window about the point that triangles are reckoned from.
struct Window {
  Axes axes;
  double half_width_mm = 1, half_height_mm = 1;
  std::uint32_t columns = 1, rows = 1;
  double eye_mm = 1e300;  ///< what lies nearer to the viewer than this is behind the eye
  /// What lies outside is not there.
  std::optional<geometry::Box3d> box = std::nullopt;
  std::vector<ClippingPlane> planes = {};  ///< mm from the same point
  /// Close what is cut open: a face of the clash that is seen from within covers all before it.
  bool closes_cuts = false;
};

/// A point in a window: columns from the left, rows from above, mm towards the viewer.
struct WindowPoint {
  double x = 0, y = 0, depth = 0;
};

/// What of a window something may be in.
struct WindowRange {
  double left = 0, right = 0, top = 0, bottom = 0;
  double farthest = 0, nearest = 0;  ///< mm towards the viewer
};

/// Returns the range that all of a box lies in.
[[nodiscard]] WindowRange range_of(const Window& window, const geometry::Box3d& box);

/// A number that goes straight over a window: at + x * along + y * down.
struct Slope {
  double at = 0, along = 0, down = 0;
  [[nodiscard]] double of(double x, double y) const { return at + x * along + y * down; }
};

/// A triangle as a window has it.
struct ProjectedTriangle {
  /// The shares of its three corners: in it none is negative.
  std::array<Slope, 3> shares;
  std::array<double, 3> per_along{};  ///< one over their `along`; 0 where that is 0
  Slope depth;                        ///< mm towards the viewer
  double left = 0, right = 0, farthest = 0, nearest = 0;
  std::uint32_t number = 0;          ///< among NearTriangles
  std::uint32_t first = 0, end = 0;  ///< the rows whose middles it has a part in
  bool own = false;                  ///< it is of the clash
  bool back = false;                 ///< its back is seen
  bool solid = false;                ///< as NearTriangle has it
  /// Not all of it lies in the window's box, behind its planes and before the eye.
  bool may_be_cut = false;
};

/// Returns the triangle where the window has the middle of a point in it that is before the eye.
[[nodiscard]] std::optional<ProjectedTriangle> project_triangle(const Window& window,
                                                                const NearTriangle& triangle,
                                                                std::uint32_t number);

/// Returns the triangles that a window may have something of: others, then the clash's own, each in
/// their order.
[[nodiscard]] std::vector<ProjectedTriangle> project_triangles(const Window& window,
                                                               const NearTriangles& triangles);

/// Whether a window may leave out some of a box.
[[nodiscard]] bool may_cut(const Window& window, const geometry::Box3d& box);

/// Faces nearer to each other than this are one: rounding must not distinguish them.
inline constexpr double kSameDepthMm = 0.02;

/// The columns of a row whose middles lie in a triangle and in what the window shows, and the depth
/// there.
class TriangleRow {
 public:
  TriangleRow(const Window& window, const ProjectedTriangle& triangle, std::uint32_t row);

  [[nodiscard]] std::uint32_t first() const { return first_; }
  [[nodiscard]] std::uint32_t end() const { return end_; }
  [[nodiscard]] double depth(std::uint32_t column) const {
    return std::clamp(depth_ + step_ * (column - first_), farthest_, nearest_);
  }

 private:
  void cut(const Window& window, std::uint32_t row);

  std::uint32_t first_ = 0, end_ = 0;
  double depth_ = 0, step_ = 0, farthest_ = 0, nearest_ = 0;
};

}  // namespace strake::pictures
