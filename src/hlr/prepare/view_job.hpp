// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/edges/intersection_lines.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line that is no edge of a part: an intersection, or what a section draws.
struct Line {
  geometry::Vec3l a, b;                  ///< grid units, rounded
  std::uint32_t body_a = 0, body_b = 0;  ///< two of an intersection, of object a <= b; else one
  EdgeKind kind = EdgeKind::intersection;
  bool cut_away = false;  ///< by a section plane: neither hidden nor seen
};

struct Lines {
  std::vector<Line> all;           ///< by object of body_a
  std::vector<std::size_t> first;  ///< by object, one more at the end; empty where there are none
  /// Least contact distance between these lines and any part. A line's ends are rounded to the
  /// grid: along each axis that takes it away from the faces that it lies on by half a unit at
  /// most, which is less than 1, and each section plane rounds lines and faces once more.
  std::int64_t contact = 1;

  /// Those that are drawn with an object.
  [[nodiscard]] std::span<const Line> of(std::uint32_t object) const {
    if (first.empty()) return {};
    return std::span(all).subspan(first[object], first[object + 1] - first[object]);
  }
};

struct ViewJob;

/// Crossings, cut by the planes, and the sections of the bodies of a job that is otherwise ready,
/// hatched. Errors: a hatch that makes no sense (usage), cancelled.
[[nodiscard]] Result<Lines> derive_lines(const ViewJob& job,
                                         std::span<const IntersectionLine> crossings,
                                         std::span<const SectionPlane> planes,
                                         const parallel::Context& context);

/// A drawing that was asked for, checked and made ready: what both solvers work on.
///
/// Coordinates are relative to `origin`, the middle of what is drawn or, in perspective, the eye,
/// and small enough that every value a solver forms (orientation, depth, limit) stays below 2^126:
/// see `prepare_view`.
struct ViewJob {
  const model::Scene* scene = nullptr;  ///< as the view sees it: `own`, or what was given
  std::unique_ptr<model::Scene> own;    ///< with contours of round primitives; null where none
  View view;
  Options options;
  Viewer viewer;  ///< direction in lowest terms; the eye is the origin
  double cos_sharp = 0;
  std::vector<HalfSpace> window;  ///< relative to origin
  geometry::Vec3l origin;
  std::optional<geometry::Box3l> limits;  ///< relative to origin, cut down to what is drawn
  std::vector<bool> drawn;                ///< per object
  std::vector<bool> opaque;               ///< per body: drawn, and hides what lies behind it
  std::vector<std::int64_t> contact;      ///< per body: contact distance in grid units
  double contact_distance_mm = 0;         ///< the largest of them
  SectionedShapes seen;
  Lines lines;
  Counters counters;  ///< of making it ready
  Diagnostics diagnostics;

  [[nodiscard]] const geometry::Vec3l& direction() const { return viewer.direction; }
  [[nodiscard]] geometry::Vec3l offset(const model::GridBody& body) const {
    return body.origin - origin;
  }
  /// Whether facets of a part of a body that is not asked about to the last digit hide none of the
  /// part's own edges where rounding to the grid alone has them do so: facets that may be edge-on,
  /// and edges that lie in the facet's plane (see kLyingInPlane and FeatureEdge::away).
  [[nodiscard]] bool forgives_rounding(std::uint32_t body) const {
    return may_forgive_rounding() && contact[body] > 0;
  }
  /// Whether that is so of any body.
  [[nodiscard]] bool may_forgive_rounding() const { return !viewer.eye && !options.keep_specks; }
  /// As a body's shape sees it.
  [[nodiscard]] FeatureOptions features_of(const model::GridBody& body) const {
    return {viewer.seen_at(offset(body)), cos_sharp, options.smooth};
  }
  /// The shape of a body, as sections leave it.
  [[nodiscard]] const SectionedShape& sectioned_shape_of(std::uint32_t body) const {
    return seen.all[seen.of[body]];
  }
};

/// Checks view and options, fixes contact distances, reduces the direction, finds the origin and
/// the intersections, and cuts what section planes cut.
[[nodiscard]] Result<ViewJob> prepare_view(const model::Scene& scene,
                                           const std::vector<bool>& drawn, const View& view,
                                           const Options& options,
                                           const parallel::Context& context);

/// Whether a piece in this state stays in the drawing.
[[nodiscard]] inline bool keeps(const Options& options, State state) {
  return options.hidden || (state != State::hidden_by_self && state != State::hidden_by_other);
}

/// The definition, taken literally: every edge against every triangle. `pieces` and the counters
/// of a drawing whose header is filled.
[[nodiscard]] Status solve_brute_force(const ViewJob& job, const parallel::Context& context,
                                       Drawing& drawing);

/// The baseline of the benchmarks: objects publish what they hide into those under them.
[[nodiscard]] Status solve_push(const ViewJob& job, const parallel::Context& context,
                                Drawing& drawing);

/// The engine.
[[nodiscard]] Status solve_gather(const ViewJob& job, const parallel::Context& context,
                                  Drawing& drawing);

}  // namespace strake::hlr
