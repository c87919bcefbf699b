// SPDX-License-Identifier: Apache-2.0
// A view that is ready to be solved: ViewJob, its preparation, its lines that are no edges of
// parts, and the solvers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hlr/edges/feature_edges.hpp"
#include "hlr/edges/intersection_lines.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "model/scene/view_tessellation.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line that is no edge of a part: an intersection, or a line of a section.
struct Line {
  geometry::Vec3l a, b;                  ///< grid units, rounded
  std::uint32_t body_a = 0, body_b = 0;  ///< the two of an intersection, by object; else equal
  EdgeKind kind = EdgeKind::intersection;
  bool cut_away = false;  ///< cut away by a section plane: neither hidden nor seen
};

struct Lines {
  std::vector<Line> all;           ///< sorted by object of body_a
  std::vector<std::size_t> first;  ///< by object, and the end; empty where there are none
  /// The least contact distance between these lines and any part. Rounding a line's ends to the
  /// grid takes it away from the faces that it lies on by half a unit at most along each axis,
  /// which is less than 1; each section plane rounds lines and faces once more.
  std::int64_t contact = 1;

  /// Returns the lines that are drawn with an object.
  [[nodiscard]] std::span<const Line> of(std::uint32_t object) const {
    if (first.empty()) return {};
    return std::span(all).subspan(first[object], first[object + 1] - first[object]);
  }
};

struct ViewJob;

/// Returns the intersection lines, cut by the planes, and the section and hatch lines of the bodies
/// of a job that is otherwise ready. Errors: a hatch that makes no sense (usage), cancelled.
[[nodiscard]] Result<Lines> derive_lines(const ViewJob& job,
                                         std::span<const IntersectionLine> crossings,
                                         std::span<const SectionPlane> planes,
                                         const parallel::Context& context);

/// The prepared input of all solvers: a scene and a view, checked and reduced.
///
/// Coordinates are relative to `origin`, the middle of what is drawn or, in perspective, the eye.
/// They are so small that every value a solver forms (orientation, depth, limit) stays below 2^126:
/// see prepare_view().
struct ViewJob {
  const model::Scene* scene = nullptr;  ///< the scene of this view: `own`, or the given one
  std::unique_ptr<model::Scene> own;  ///< re-tessellated with contours of round primitives; or null
  View view;
  Options options;
  Viewer viewer;  ///< its direction is in lowest terms; its eye is the origin
  double cos_sharp = 0;
  std::vector<HalfSpace> window;  ///< relative to origin
  geometry::Vec3l origin;
  std::optional<geometry::Box3l> limits;  ///< relative to origin, clipped to what is drawn
  std::vector<bool> drawn;                ///< per object
  std::vector<bool> to_solve;             ///< as WholeView::asked; or empty
  /// As IntersectionRule::shows: clipped lines are looked for only where they are kept (decision
  /// 0127).
  std::function<bool(const geometry::Box3l& box)> shows_lines;
  std::vector<bool> opaque;           ///< per body: is drawn, and hides what lies behind it
  std::vector<std::int64_t> contact;  ///< per body: contact distance in grid units
  double contact_distance_mm = 0;     ///< the largest contact distance
  std::vector<bool> uncut;            ///< per object: sections leave it whole; or empty
  SectionedShapes sectioned;
  std::vector<Hatch> hatches;  ///< per object; empty: nothing is hatched
  Lines lines;
  Counters counters;  ///< counters of the preparation
  Diagnostics diagnostics;

  [[nodiscard]] const geometry::Vec3l& direction() const { return viewer.direction; }
  [[nodiscard]] geometry::Vec3l offset(const model::GridBody& body) const {
    return body.origin - origin;
  }
  /// Returns whether the lines of a drawn object are wanted.
  [[nodiscard]] bool solves(std::uint32_t object) const {
    return to_solve.empty() || to_solve[object];
  }
  /// Returns whether the object of an edge of this kind hides nothing of it, see
  /// Options::own_polylines.
  [[nodiscard]] bool spares_own(EdgeKind kind) const {
    return kind == EdgeKind::polyline && options.own_polylines == OwnPolylines::visible;
  }
  /// Returns whether facets of a part of a body hide none of the part's own edges where rounding to
  /// the grid alone has them do so: facets that may be edge-on, and edges that lie in the facet's
  /// plane (see kLyingInPlane and FeatureEdge::away). Not where exact states are requested.
  [[nodiscard]] bool forgives_rounding(std::uint32_t body) const {
    return may_forgive_rounding() && contact[body] > 0;
  }
  /// Returns whether forgives_rounding() may be true of any body.
  [[nodiscard]] bool may_forgive_rounding() const { return !viewer.eye && !options.keep_specks; }
  /// Returns the feature options in the coordinates of a body's shape.
  [[nodiscard]] FeatureOptions features_of(const model::GridBody& body) const {
    return {viewer.at_offset(offset(body)), cos_sharp, options.smooth};
  }
  /// Returns whether sections leave the object of a body whole.
  [[nodiscard]] bool is_uncut(std::uint32_t body) const {
    return !uncut.empty() && uncut[model::index(scene->bodies[body].object)];
  }
  /// Returns the shape of a body, as sections leave it.
  [[nodiscard]] const SectionedShape& sectioned_shape_of(std::uint32_t body) const {
    return sectioned.all[sectioned.of[body]];
  }
};

/// Takes the shapes of a job down by all workers, once nobody requests them any more: in
/// perspective each body has one of its own.
void take_down(ViewJob& job, const parallel::Context& context);

/// What the preparation of a part of what is drawn takes from the whole, so that what it says of
/// the part is what the whole would say. Sections are reported for the whole alone.
struct WholeView {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();  ///< of all that is drawn
  double longest_side = 0;                                    ///< of the boxes of its bodies
  model::ViewTessellation tessellation;                       ///< for the shapes of the part
  std::span<const Hatch> hatches;                             ///< by object; as ViewJob::hatches
  /// By object: its lines are wanted. What else is drawn of the part only hides.
  std::vector<bool> to_solve;
};

/// What is to be drawn, and how; all outlives the job.
struct ViewInput {
  const model::Scene& scene;
  const std::vector<bool>& drawn;  ///< by object; empty: all
  const View& view;
  const Options& options;
  const WholeView* whole = nullptr;  ///< null: the scene is all there is
};

/// Prepares a job: checks view and options, fixes contact distances, reduces the direction, finds
/// the origin and the intersection lines, and cuts shapes by the section planes.
[[nodiscard]] Result<ViewJob> prepare_view(const ViewInput& input,
                                           const parallel::Context& context);

/// What sections make of all that is drawn, where it takes the whole to tell.
struct WholeSections {
  std::vector<Hatch> hatches;      ///< as ViewJob::hatches
  double contact_distance_mm = 0;  ///< as ViewJob::contact_distance_mm
  std::uint64_t uncut_objects = 0;
  Diagnostics diagnostics;  ///< reports on sections
};

/// Cuts all that is drawn, without looking for lines. Errors: those of prepare_view().
[[nodiscard]] Result<WholeSections> prepare_sections(const ViewInput& input,
                                                     const parallel::Context& context);

/// Returns how a view has the primitives of a scene tessellated. Errors: those of section_planes().
[[nodiscard]] Result<model::ViewTessellationOptions> tessellation_of(const View& view,
                                                                     const Options& options);

/// Returns the contact distance of a body, grid units, before sections widen it.
[[nodiscard]] std::int64_t contact_of(const model::Body& body, const Options& options);

/// Returns whether a piece in this state stays in the drawing.
[[nodiscard]] inline bool keeps(const Options& options, State state) {
  return options.hidden || (state != State::hidden_by_self && state != State::hidden_by_other);
}

/// By object, 1 where some of its visible pieces are specks (specks.hpp).
using SpeckedObjects = std::vector<std::uint8_t>;

/// The definition, taken literally: tests every edge against every triangle. Fills `pieces` and the
/// counters of a drawing whose header is filled, and returns which objects have specks, as do the
/// other solvers.
[[nodiscard]] Result<SpeckedObjects> solve_brute_force(const ViewJob& job,
                                                       const parallel::Context& context,
                                                       Drawing& drawing);

/// Counts what solve_brute_force() has to do.
[[nodiscard]] Result<BruteForceWork> count_brute_force_work(const ViewJob& job,
                                                            const parallel::Context& context);

/// The baseline of the benchmarks (scatter): objects publish what they hide into those under them.
[[nodiscard]] Result<SpeckedObjects> solve_push(const ViewJob& job,
                                                const parallel::Context& context, Drawing& drawing);

/// The engine: each edge gathers the occluders that hide it.
[[nodiscard]] Result<SpeckedObjects> solve_gather(const ViewJob& job,
                                                  const parallel::Context& context,
                                                  Drawing& drawing);

}  // namespace strake::hlr
