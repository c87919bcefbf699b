// SPDX-License-Identifier: Apache-2.0
// The scene that the solvers query: projected shapes, bodies, their hierarchy and occlusion buffer,
// and the edges to solve.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/occluders/occlusion_buffer.hpp"
#include "hlr/occluders/projected_shape.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/precomputed.hpp"

namespace strake::hlr {

/// A run of edges of one body, or of the lines that are drawn with its object: a work item.
struct EdgeRange {
  std::uint32_t body = 0, first = 0, last = 0;
  std::uint32_t number = 0;  ///< number of its first edge within the object
  bool lines = false;
  bool whole = false;  ///< all edges of its object, which has no lines
};

/// The most bodies of an object that are searched one by one for each of its edges: more are found
/// faster by the tree.
inline constexpr std::uint32_t kFewBodies = 16;

/// The intervals that a shape's own faces hide of its edges: the same for all bodies that place it
/// whole.
struct SelfOcclusion {
  std::vector<std::uint32_t> first;  ///< first interval per edge, and the end
  std::vector<OcclusionInterval> intervals;

  [[nodiscard]] std::span<const OcclusionInterval> of(std::uint32_t edge) const {
    return std::span(intervals).subspan(first[edge], first[edge + 1] - first[edge]);
  }
};

/// Bodies of one shape and one contact distance that stand behind each other in the line of sight:
/// all of them hide the same of what lies deep under them (decision 0074). In perspective, and
/// where limits cut it, a body stands alone.
struct BodyColumns {
  std::vector<std::uint32_t> first;   ///< first body per column, and the end
  std::vector<std::uint32_t> bodies;  ///< by column, the nearest to the viewer first

  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t column) const {
    return std::span(bodies).subspan(first[column], first[column + 1] - first[column]);
  }
};

/// A job with everything that the solvers query.
struct VisibilityScene {
  explicit VisibilityScene(const ViewJob& view_job)
      : job(view_job), projection(view_job.direction()) {}
  VisibilityScene(const VisibilityScene&) = delete;  // `placed` points into `shapes`
  VisibilityScene& operator=(const VisibilityScene&) = delete;
  VisibilityScene(VisibilityScene&&) = default;
  VisibilityScene& operator=(VisibilityScene&&) = delete;
  ~VisibilityScene() = default;

  const ViewJob& job;
  ViewProjection projection;
  std::optional<PerspectiveMap> perspective_map;  ///< in perspective
  parallel::Precomputed<ProjectedShape>
      shapes;  ///< shapes of drawn bodies, by sectioned shape or, in perspective, by body
  std::vector<SelfOcclusion>
      self_occlusion;  ///< per sectioned shape; empty where no two bodies share it
  std::vector<std::uint32_t> first_sharing;  ///< the first body of each such shape, ascending
  std::uint64_t sharing = 0;                 ///< bodies that share it
  std::vector<BodyInstance> placed;          ///< per body
  /// The bodies that may hide. Of equal bodies at one place a few are enough, of objects of up to
  /// kFewBodies: what one hides the others hide.
  BodyColumns columns;
  ViewBvh tree;                      ///< over the columns
  OcclusionBuffer occlusion_buffer;  ///< covers those bodies; empty without culling
  std::vector<EdgeRange> items;
  /// By object: the edges of its bodies that are clipped wholly, which are in no item. Empty where
  /// clipped edges are requested.
  std::vector<std::uint32_t> outside;

  /// Returns whether the edges of a body are in no item.
  [[nodiscard]] bool leaves_out(const BodyInstance& body) const {
    return body.outside && !job.options.clipped;
  }
  /// Returns the number of a body's projected shape.
  [[nodiscard]] std::uint32_t shape_number(std::uint32_t body) const {
    return perspective_map ? body : job.sectioned.of[body];
  }
};

/// Projects the shapes, places the bodies and divides the edges into work items. The job must
/// outlive the result. Errors: cancelled.
[[nodiscard]] Result<VisibilityScene> make_visibility_scene(const ViewJob& job,
                                                            const parallel::Context& context);

/// Returns the edges of one body of each shape whose bodies share its self-occlusion.
[[nodiscard]] std::vector<EdgeRange> self_occlusion_ranges(const VisibilityScene& visibility);

/// An edge to solve: a feature edge of a body, or a line that is no edge of one, in the coordinates
/// of the job.
struct EdgeQuery {
  std::uint32_t body = 0;
  const BodyInstance* own = nullptr;
  const BodyInstance* other = nullptr;     ///< the second body of an intersection, otherwise `own`
  const ProjectedEdge* feature = nullptr;  ///< null for a line that is no edge
  EdgeKind kind = EdgeKind::sharp;
  bool projecting = false;
  bool cut_away = false;
  std::int64_t contact = 0;
  geometry::Vec3l a, b;
  ViewPoint va, vb;  ///< orthographic

  EdgeQuery() = default;
  EdgeQuery(const VisibilityScene& visibility, std::uint32_t body_index, const ProjectedEdge& e);
  EdgeQuery(const VisibilityScene& visibility, const Line& line);

  /// Returns the point at a parameter in the model, rounded to the grid.
  [[nodiscard]] geometry::Vec3l at(const RationalParam& t, const geometry::Vec3l& origin) const;

  /// Clips [lo, hi] to the limits, or the frustum; false when nothing of any length is left.
  [[nodiscard]] bool clip(const geometry::Box3l& limits, RationalParam& lo,
                          RationalParam& hi) const;
  [[nodiscard]] bool clip(std::span<const HalfSpace> window, RationalParam& lo,
                          RationalParam& hi) const;
};

}  // namespace strake::hlr
