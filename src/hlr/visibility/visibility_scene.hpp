// SPDX-License-Identifier: Apache-2.0
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

/// A run of edges of one body, or of the lines that are drawn with its object: the item of work.
struct EdgeRange {
  std::uint32_t body = 0, first = 0, last = 0;
  std::uint32_t number = 0;  ///< of its first edge within the object
  bool lines = false;
};

/// Bodies up to which those of an object are looked through for each of its edges: more are found
/// faster by the tree.
inline constexpr std::uint32_t kFewBodies = 16;

/// What a shape's own faces hide of its edges: the same for all bodies that place it whole.
struct SelfOcclusion {
  std::vector<std::uint32_t> first;  ///< per edge, and the end
  std::vector<OcclusionInterval> intervals;

  [[nodiscard]] std::span<const OcclusionInterval> of(std::uint32_t edge) const {
    return std::span(intervals).subspan(first[edge], first[edge + 1] - first[edge]);
  }
};

/// What the gathering works on.
struct VisibilityScene {
  explicit VisibilityScene(const ViewJob& asked) : job(asked), projection(asked.direction()) {}
  VisibilityScene(const VisibilityScene&) = delete;  // `placed` points into `views`
  VisibilityScene& operator=(const VisibilityScene&) = delete;
  VisibilityScene(VisibilityScene&&) = default;
  VisibilityScene& operator=(VisibilityScene&&) = delete;
  ~VisibilityScene() = default;

  const ViewJob& job;
  ViewProjection projection;
  std::optional<PerspectiveMap> perspective_map;  ///< in perspective
  parallel::Precomputed<ProjectedShape>
      views;  ///< by seen shape or, in perspective, body; of what is drawn
  std::vector<SelfOcclusion>
      self_occlusion;                ///< per seen shape; empty where no two bodies share it
  std::vector<BodyInstance> placed;  ///< per body
  /// Over the bodies that may hide. Of equal ones at one place a few are enough, of objects of up
  /// to kFewBodies: what one hides the others hide.
  ViewBvh tree;
  OcclusionBuffer occlusion_buffer;  ///< by them; of nothing where there is no culling
  std::vector<EdgeRange> items;

  /// The number of a body's view.
  [[nodiscard]] std::uint32_t view_of(std::uint32_t body) const {
    return perspective_map ? body : job.seen.of[body];
  }
};

/// Sees the shapes, places the bodies and cuts the edges into work. The job must outlive the
/// result. Errors: cancelled.
[[nodiscard]] Result<VisibilityScene> make_visibility_scene(const ViewJob& job,
                                                            const parallel::Context& context);

/// The edges of one body of each shape whose bodies share what it hides of itself.
[[nodiscard]] std::vector<EdgeRange> self_occlusion_ranges(const VisibilityScene& visibility);

/// A feature edge of a body, or a line that is no edge of one, in the coordinates of the job.
struct EdgeQuery {
  std::uint32_t body = 0;
  const BodyInstance* own = nullptr;
  const BodyInstance* other = nullptr;     ///< of an intersection the second body, otherwise `own`
  const ProjectedEdge* feature = nullptr;  ///< null: a line that is no edge
  EdgeKind kind = EdgeKind::sharp;
  bool projecting = false;
  bool cut_away = false;
  std::int64_t contact = 0;
  geometry::Vec3l a, b;
  ViewPoint va, vb;  ///< orthographic

  EdgeQuery() = default;
  EdgeQuery(const VisibilityScene& visibility, std::uint32_t body_index, const ProjectedEdge& e);
  EdgeQuery(const VisibilityScene& visibility, const Line& line);

  /// In the model, rounded to the grid.
  [[nodiscard]] geometry::Vec3l at(const RationalParam& t, const geometry::Vec3l& origin) const;

  /// Cuts [lo, hi] down to what lies within the limits, or the window; false when nothing of any
  /// length does.
  [[nodiscard]] bool clip(const geometry::Box3l& limits, RationalParam& lo,
                          RationalParam& hi) const;
  [[nodiscard]] bool clip(std::span<const HalfSpace> window, RationalParam& lo,
                          RationalParam& hi) const;
};

}  // namespace strake::hlr
