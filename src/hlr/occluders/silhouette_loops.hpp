// SPDX-License-Identifier: Apache-2.0
// Outlines of coplanar triangles, silhouettes of convex parts, and the certificate of convexity.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/view/projection.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// The normal of a triangle, and its product with the direction of a view.
struct TrianglePlane {
  std::array<std::int64_t, 3> n{};
  Int128 facing = 0;
  bool edge_on = false;  ///< see may_be_edge_on(); only where it is requested
};

/// Returns whether a locally convex closed surface of one shell bounds a convex body: it does when
/// some point lies strictly inside all its planes and a ray from there meets it once (Mehlhorn et
/// al., Checking geometric programs, 1996). False where there is doubt.
[[nodiscard]] bool bounds_convex_body(const geometry::Part& part,
                                      std::span<const TrianglePlane> planes);

/// The vertices and planes of a part as a viewer sees them.
struct ProjectedPart {
  const geometry::Part& part;
  const Viewer& viewer;
  std::vector<ViewPoint> points = {};      ///< projected vertices; orthographic
  std::vector<geometry::Vec3l> rays = {};  ///< from the eye to the vertices; perspective
  std::vector<TrianglePlane> planes = {};  ///< only for parts within 2^30
  bool find_edge_on = false;               ///< look for triangles that may be edge-on

  // Errors: cancelled.
  [[nodiscard]] Status project(const ViewProjection& projection, const parallel::Context& context);
  [[nodiscard]] Status find_planes(const parallel::Context& context);

  /// Returns the least product of a vertex, or its ray, with the direction.
  [[nodiscard]] std::int64_t farthest() const;
  /// Returns the normal of the side of a triangle that looks towards the viewer.
  [[nodiscard]] std::array<std::int64_t, 3> towards_viewer(std::uint32_t triangle) const;
};

/// Finds convex loops of vertices, counter-clockwise to the viewer.
class SilhouetteLoops {
 public:
  explicit SilhouetteLoops(const ProjectedPart& projected) : projected_(projected) {}

  /// Finds the outline of coplanar triangles that look the same way; false when it is not one
  /// convex loop.
  [[nodiscard]] bool find_outline(std::span<const std::uint32_t> triangles);
  /// Finds the silhouette of a certified convex part from outside it.
  [[nodiscard]] bool find_silhouette();
  void take_triangle(std::uint32_t triangle);

  [[nodiscard]] const std::vector<std::uint32_t>& found() const { return loop_; }

 private:
  bool close_silhouette();
  bool outline_of_pair(std::uint32_t s, std::uint32_t t);
  bool outline(std::span<const std::uint32_t> triangles);
  bool is_convex_face(std::uint32_t triangle);
  template <class At>
  bool is_convex_loop(const At& at);
  bool is_convex_cone();
  template <class Orientation>
  bool drop_straight_runs(const Orientation& orientation);

  const ProjectedPart& projected_;
  std::vector<std::uint32_t> next_, loop_, corners_, touched_;
  std::vector<std::array<std::uint32_t, 2>> directed_;
};

}  // namespace strake::hlr
