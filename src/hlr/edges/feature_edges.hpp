// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/view/projection.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line to draw, in the coordinates of its shape. `a` < `b` in lexicographic order, so that a
/// line does not depend on the order in which a file lists triangles.
struct FeatureEdge {
  geometry::Vec3i a{}, b{};
  std::uint32_t part = 0;
  std::uint32_t part_edge = 0;  ///< index into Part::edges; kNoPartEdge for a polyline's segment
  EdgeKind kind = EdgeKind::sharp;
  bool projecting = false;  ///< a point on paper
  bool away = false;        ///< an edge of a solid between two faces that look away from the viewer
  bool cut_away = false;    ///< cut away by a section plane: neither hidden nor seen
};

inline constexpr std::uint32_t kNoPartEdge = 0xffffffffU;

struct FeatureOptions {
  Viewer viewer;         ///< the viewer in the coordinates of the shape
  double cos_sharp = 0;  ///< an edge is sharp when the cosine between its faces is below this
  Smooth smooth = Smooth::off;  ///< which smooth edges to include
};

/// Returns the cosine of an angle in [0, 180] degrees from additions and multiplications alone, so
/// that it is the same on every machine.
[[nodiscard]] double cosine_of_degrees(double degrees);

/// Returns the edges of a part that are drawn in every view: sharp ones and those that do not have
/// two triangles.
[[nodiscard]] Result<std::vector<FeatureEdge>> view_independent_edges(const geometry::Part& part,
                                                                      double cos_sharp);

/// Returns the lines of a shape for one viewer, sorted by part, then by (a, b). Errors: cancelled.
[[nodiscard]] Result<std::vector<FeatureEdge>> feature_edges(const model::GridShape& shape,
                                                             const FeatureOptions& options,
                                                             const parallel::Context& context);

}  // namespace strake::hlr
