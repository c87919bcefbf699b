// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hlr/convexity.hpp"
#include "hlr/frame.hpp"
#include "hlr/viewer.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// The vertices and planes of a part as a viewer sees them.
struct PartSight {
  const geometry::Part& part;
  const Viewer& viewer;
  std::vector<ViewPoint> points = {};      ///< of the vertices; orthographic
  std::vector<geometry::Vec3l> rays = {};  ///< from the eye to the vertices; in perspective
  std::vector<TrianglePlane> planes = {};  ///< for parts within 2^30
  bool find_edge_on = false;               ///< look for triangles that may be edge-on

  // Errors: cancelled.
  [[nodiscard]] Status project(const Frame& frame, const parallel::Context& context);
  [[nodiscard]] Status find_planes(const parallel::Context& context);

  /// The least product of a vertex, or its ray, with the direction.
  [[nodiscard]] std::int64_t farthest() const;
  /// The normal of a triangle's side that looks towards the viewer.
  [[nodiscard]] std::array<std::int64_t, 3> towards_viewer(std::uint32_t triangle) const;
};

/// Finds convex loops of vertices, counter-clockwise to the viewer.
class Loops {
 public:
  explicit Loops(const PartSight& seen) : seen_(seen) {}

  /// The outline of coplanar triangles that look the same way; false when it is not one convex
  /// loop.
  [[nodiscard]] bool find_outline(std::span<const std::uint32_t> triangles);
  /// The outline of a certified convex part from outside it.
  [[nodiscard]] bool find_contour();
  void take_triangle(std::uint32_t triangle);

  [[nodiscard]] const std::vector<std::uint32_t>& found() const { return loop_; }

 private:
  bool close_contour();
  bool outline_of_pair(std::uint32_t s, std::uint32_t t);
  bool outline(std::span<const std::uint32_t> triangles);
  bool is_convex_face(std::uint32_t triangle);
  template <class At>
  bool is_convex_loop(const At& at);
  bool is_convex_cone();
  template <class Turn>
  bool drop_straight_runs(const Turn& turn);

  const PartSight& seen_;
  std::vector<std::uint32_t> next_, loop_, corners_, touched_;
  std::vector<std::array<std::uint32_t, 2>> directed_;
};

}  // namespace strake::hlr
