// SPDX-License-Identifier: Apache-2.0
// The lines of a view that are no edges of parts, and its preparation.
#include "hlr/prepare/view_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "hlr/prepare/drawn_objects.hpp"
#include "hlr/prepare/hatch.hpp"
#include "hlr/prepare/uncut_lines.hpp"
#include "hlr/prepare/view_diagnostics.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/sections/uncut_objects.hpp"
#include "hlr/view/projection.hpp"
#include "hlr/view/view_frustum.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/deal.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::CutPlane;
using geometry::Segment;
using geometry::Vec3l;

void add_crossing(std::vector<Line>& lines, const model::Scene& scene,
                  const IntersectionLine& crossing, std::span<const SectionPlane> planes) {
  const auto push = [&](const Vec3l& a, const Vec3l& b, bool cut_away) {
    if (a != b)
      lines.push_back({a, b, crossing.body_a, crossing.body_b, EdgeKind::intersection, cut_away});
  };
  if (planes.empty()) return push(crossing.a, crossing.b, false);
  const Vec3l origin = scene.bodies[crossing.body_a].origin;
  std::vector<CutPlane> local;
  for (const SectionPlane& plane : planes) local.push_back(plane.at(origin));
  const auto left = geometry::left_of({crossing.a - origin, crossing.b - origin}, local);
  if (!left) return push(crossing.a, crossing.b, true);
  const Vec3l a = (*left)[0] + origin, b = (*left)[1] + origin;
  push(crossing.a, a, true);
  push(a, b, false);
  push(b, crossing.b, true);
}

/// Returns the lines of crossings. Those of a part that is cut with one that is not follow from
/// what is left of them.
Result<std::vector<Line>> lines_of_crossings(const ViewJob& job,
                                             std::span<const IntersectionLine> crossings,
                                             std::span<const SectionPlane> planes,
                                             const parallel::Context& context) {
  constexpr std::size_t kGrain = 4096;
  return parallel::collect<Line>(
      context, {.name = "lines of crossings", .n = crossings.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<Line>& out) {
        const IntersectionLine& crossing = crossings[i];
        const bool whole = job.is_uncut(crossing.body_a), other = job.is_uncut(crossing.body_b);
        if (whole == other)
          add_crossing(out, *job.scene, crossing, whole ? std::span<const SectionPlane>() : planes);
      });
}

/// Returns the outlines of cuts.
Result<std::vector<Line>> lines_of_sections(const ViewJob& job,
                                            std::span<const SectionPlane> planes,
                                            const parallel::Context& context) {
  if (planes.empty()) return std::vector<Line>{};
  constexpr std::size_t kGrain = 256;
  return parallel::collect<Line>(
      context, {.name = "lines of sections", .n = job.scene->bodies.size(), .grain = kGrain},
      [&](std::size_t index, std::vector<Line>& out) {
        const auto b = static_cast<std::uint32_t>(index);
        const ShapeCut* const cut = job.sectioned_shape_of(b).cut.get();
        if (cut == nullptr) return;
        const Vec3l origin = job.scene->bodies[b].origin;
        for (const geometry::SectionLine& line : cut->lines)
          out.push_back({line.at[0] + origin, line.at[1] + origin, b, b, EdgeKind::section, false});
      });
}

/// Lines of several lists, one after the other.
class ListedLines {
 public:
  explicit ListedLines(std::span<const std::span<const Line>> lists) : lists_(lists) {
    for (const std::span<const Line> list : lists) size_ += list.size();
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Line& operator[](std::size_t i) const {
    for (const std::span<const Line> list : lists_) {
      if (i < list.size()) return list[i];
      i -= list.size();
    }
    return lists_.back().back();
  }

 private:
  std::span<const std::span<const Line>> lists_;
  std::size_t size_ = 0;
};

/// Sorts lines by object, stably.
Status put_in_order(const ListedLines& given, const model::Scene& scene, Lines& lines,
                    const parallel::Context& context) {
  if (given.size() == 0) return {};
  auto by_object = parallel::items_by_key(
      context, "lines by object", given.size(), scene.model->objects.size(), [&](std::size_t i) {
        return std::size_t{model::index(scene.bodies[given[i].body_a].object)};
      });
  if (!by_object) return by_object.error();
  constexpr std::size_t kGrain = 4096;
  auto all =
      parallel::transform(context, {.name = "lines in order", .n = given.size(), .grain = kGrain},
                          [&](std::size_t i) { return given[by_object->values[i]]; });
  if (!all) return all.error();
  lines.all = std::move(*all);
  lines.first = std::move(by_object->offsets);
  return {};
}

}  // namespace

Result<Lines> derive_lines(const ViewJob& job, std::span<const IntersectionLine> crossings,
                           std::span<const SectionPlane> planes, const parallel::Context& context) {
  Lines lines;
  lines.contact = 1 + static_cast<std::int64_t>(planes.size());
  const auto crossed = lines_of_crossings(job, crossings, planes, context);
  if (!crossed) return crossed.error();
  const auto with_uncut = lines_with_uncut(job, context);
  if (!with_uncut) return with_uncut.error();
  std::vector<Line> of_uncut;
  for (const IntersectionLine& crossing : *with_uncut)
    add_crossing(of_uncut, *job.scene, crossing, {});
  const auto cuts = lines_of_sections(job, planes, context);
  if (!cuts) return cuts.error();
  const auto hatch = hatch_lines(job, planes, context);
  if (!hatch) return hatch.error();
  const std::array<std::span<const Line>, 4> lists{*crossed, of_uncut, *cuts, *hatch};
  if (const Status ordered = put_in_order(ListedLines(lists), *job.scene, lines, context); !ordered)
    return ordered.error();
  return lines;
}

namespace {

using geometry::Box3l;

constexpr std::int64_t kMaxDirection = std::int64_t{1} << 20;
constexpr double kMaxContactMm = 1e6;
// Largest |coordinate| · |direction component|: with part coordinates within ±2^30 the largest
// value formed, a hiding point against a limit, then stays below 2^124.
constexpr double kMaxReach = 72057594037927936.0;  // 2^56
// In perspective, with r the largest |coordinate| from the eye and s the longest side of a shape:
// orientations are 3x3 determinants of coordinates, below 12·r^3 with their differences; depths are
// 3·s^2·2·r at most, s being below 2^32, and hiding points against limits 24·s^2·r^2.
constexpr double kMaxFromEye = 1099511627776.0;            // 2^40: 1,100 km
constexpr double kMaxSideFromEye = 1152921504606846976.0;  // 2^60, s·r where there are limits

Status check(const View& view, const Options& options) {
  const Vec3l& d = view.direction;
  if (d == Vec3l{0, 0, 0})
    return view_error("the view direction is zero", "give a direction that points to the viewer");
  for (int k = 0; k < 3; ++k)
    if (d[k] > kMaxDirection || d[k] < -kMaxDirection)
      return view_error("a component of the view direction exceeds 1048576",
                        "round the direction to 20 bits");
  if (!(options.sharp_angle_deg >= 0 && options.sharp_angle_deg <= 180))
    return view_error("the sharp angle is not between 0 and 180 degrees", "20 is the usual angle");
  if (options.bucketing < Options::kBucketsByData || options.bucketing > Options::kMaxBuckets)
    return view_error("the number of buckets is not between 0 and 4096",
                      "leave it out to have it chosen from the faces");
  if (!(options.contact_distance_mm <= kMaxContactMm))
    return view_error("the contact distance is not a number below a kilometre",
                      "leave it out to have it derived from the sources");
  if (view.limits && view.limits->empty())
    return view_error("the limits are empty", "give lowest coordinates first");
  return check_perspective(view);
}

// Only shares the work out. Blocks of bodies have whole words of bits to themselves.
constexpr std::size_t kBodiesPerBlock = 4096;

Status fill_bodies(ViewJob& job, const parallel::Context& context) {
  const model::Scene& scene = *job.scene;
  job.opaque.resize(scene.bodies.size());
  auto contact = parallel::unset_slots<std::int64_t>(scene.bodies.size());
  if (!contact) return contact.error();
  job.contact = std::move(*contact);
  return parallel::for_each(
      context, {.name = "view: bodies", .n = scene.bodies.size(), .grain = kBodiesPerBlock},
      [&](std::size_t b) {
        const model::GridBody& body = scene.bodies[b];
        job.contact[b] = 0;
        if (!job.drawn[model::index(body.object)]) return;
        const model::Body& placed = scene.model->bodies[body.body];
        job.opaque[b] = placed.color.alpha == 255;
        job.contact[b] = contact_of(placed, job.options);
      });
}

// Adds the rounding of sections to the contact distances.
Status widen_contact(ViewJob& job, const parallel::Context& context) {
  const auto largest = parallel::reduce(
      context, {.name = "view: contacts", .n = job.contact.size(), .grain = kBodiesPerBlock},
      std::int64_t{0},
      [&](std::int64_t& largest_contact, std::size_t index) {
        const auto b = static_cast<std::uint32_t>(index);
        if (!job.drawn[model::index(job.scene->bodies[b].object)]) return;
        job.contact[b] = std::max(job.contact[b], job.sectioned_shape_of(b).within);
        largest_contact = std::max(largest_contact, job.contact[b]);
      },
      [](std::int64_t& into, std::int64_t largest_contact) {
        into = std::max(into, largest_contact);
      });
  if (!largest) return largest.error();
  job.contact_distance_mm = static_cast<double>(*largest) * geometry::kMmPerGrid;
  return {};
}

/// What is drawn: its box, and the longest side of a shape.
struct DrawnExtent {
  Box3l box = geometry::empty_box<std::int64_t>();
  std::int64_t longest_side = 0;
};

Result<DrawnExtent> drawn_extent(const ViewJob& job, const parallel::Context& context) {
  return parallel::reduce(
      context, {.name = "view: extent", .n = job.scene->bodies.size(), .grain = kBodiesPerBlock},
      DrawnExtent{},
      [&](DrawnExtent& extent, std::size_t b) {
        const model::GridBody& body = job.scene->bodies[b];
        const model::GridShape& shape = job.scene->shapes[body.grid_shape];
        const geometry::Box3i& box = shape.box;
        if (!job.drawn[model::index(body.object)] || box.empty()) return;
        extent.box.include(body.box(shape));
        for (int k = 0; k < 3; ++k)
          extent.longest_side =
              std::max(extent.longest_side, std::int64_t{box.hi[k]} - std::int64_t{box.lo[k]});
      },
      [](DrawnExtent& into, const DrawnExtent& extent) {
        into.box.include(extent.box);
        into.longest_side = std::max(into.longest_side, extent.longest_side);
      });
}

// Clips the limits to one unit beyond what is drawn, which keeps the numbers small and changes no
// result.
void place_limits(ViewJob& job, const Box3l& box) {
  if (!job.view.limits) return;
  Box3l limits = *job.view.limits;
  for (int k = 0; k < 3; ++k) {
    limits.lo[k] = std::clamp(limits.lo[k], box.lo[k] - 1, box.hi[k] + 1) - job.origin[k];
    limits.hi[k] = std::clamp(limits.hi[k], box.lo[k] - 1, box.hi[k] + 1) - job.origin[k];
  }
  job.limits = limits;
}

Status place_eye(ViewJob& job, const Box3l& box, double longest_side) {
  job.origin = job.view.perspective->eye;
  double reach = 0;
  for (int k = 0; k < 3; ++k)
    reach = std::max({reach, std::fabs(static_cast<double>(box.lo[k] - job.origin[k])),
                      std::fabs(static_cast<double>(box.hi[k] - job.origin[k]))});
  if (reach > kMaxFromEye)
    return Error{ErrorCode::input, "the eye is more than 1,000 km away from what is drawn", "view",
                 "move the eye nearer, draw fewer objects, or use an orthographic view"};
  if (job.view.limits && reach * longest_side > kMaxSideFromEye)
    return Error{ErrorCode::input, "the eye is too far away from objects of this size for limits",
                 "view", "move the eye nearer, draw fewer objects, or leave out the limits"};
  return {};
}

Status place_middle(ViewJob& job, const Box3l& box) {
  double reach = 0;
  const Vec3l& d = job.direction();
  const auto largest = static_cast<double>(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
  for (int k = 0; k < 3; ++k) {
    job.origin[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
    reach = std::max(reach, static_cast<double>(box.hi[k] - box.lo[k]) * largest);
  }
  if (reach > kMaxReach)
    return Error{ErrorCode::input, "the drawn objects are too far apart for this direction", "view",
                 "draw fewer objects, or use a direction with smaller numbers"};
  return {};
}

Status place(ViewJob& job, const WholeView* whole, const parallel::Context& context) {
  Box3l box;
  double longest_side = 0;
  if (whole != nullptr) {
    box = whole->box;
    longest_side = whole->longest_side;
  } else {
    const auto extent = drawn_extent(job, context);
    if (!extent) return extent.error();
    box = extent->box;
    longest_side = static_cast<double>(extent->longest_side);
  }
  if (box.empty()) return {};
  const Status placed =
      job.view.perspective ? place_eye(job, box, longest_side) : place_middle(job, box);
  if (placed) place_limits(job, box);
  return placed;
}

/// Returns the space that a view may show.
ViewVolume shown_volume(const View& view, const Options& options,
                        std::span<const SectionPlane> planes) {
  // What is left whole may reach beyond the planes.
  return {view, options.uncut.empty() ? planes : std::span<const SectionPlane>()};
}

}  // namespace

std::int64_t contact_of(const model::Body& body, const Options& options) {
  if (options.contact_distance_mm >= 0)
    return std::llround(options.contact_distance_mm * geometry::kGridPerMm);
  return static_cast<std::int64_t>(std::ceil(
      std::min(model::contact_distance(body.precision_um), kMaxContactMm * geometry::kGridPerMm)));
}

Result<model::ViewTessellationOptions> tessellation_of(const View& view, const Options& options) {
  const auto planes = section_planes(view.sections);
  if (!planes) return planes.error();
  model::ViewTessellationOptions tessellation_options{.sag_mm = options.sag_mm};
  if (view.perspective)
    tessellation_options.eye = view.perspective->eye;
  else
    tessellation_options.towards = in_lowest_terms(view.direction);
  // A margin for tessellation and the grid.
  constexpr std::int64_t kRoom = 2000;
  const ViewVolume shown = shown_volume(view, options, *planes);
  tessellation_options.shows = [shown](const Box3l& box) {
    return shown.meets(box.inflated(kRoom));
  };
  return tessellation_options;
}

namespace {

/// Checks what is requested, and places the bodies.
Result<ViewJob> begin_job(const ViewInput& input, const parallel::Context& context) {
  const auto& [scene, drawn, view, options, whole] = input;
  if (const Status status = check(view, options); !status) return status.error();
  if (const Status status = check_drawn(scene, drawn); !status) return status.error();
  if (const Status status = check_drawn(scene, options.uncut); !status) return status.error();

  ViewJob job;
  job.view = view;
  job.options = options;
  job.viewer.direction = in_lowest_terms(view.direction);
  if (view.perspective) job.viewer.eye = Vec3l{};
  job.cos_sharp = cosine_of_degrees(options.sharp_angle_deg);
  job.window = window(view);
  job.drawn = drawn.empty() ? std::vector<bool>(scene.model->objects.size(), true) : drawn;
  if (whole != nullptr) job.to_solve = whole->to_solve;
  const auto tessellation_options = tessellation_of(view, options);
  if (!tessellation_options) return tessellation_options.error();
  auto own = whole != nullptr
                 ? model::tessellate_for_view(scene, job.drawn, *tessellation_options,
                                              whole->tessellation, context)
                 : model::tessellate_for_view(scene, job.drawn, *tessellation_options, context);
  if (!own) return own.error();
  if (*own) job.own = std::make_unique<model::Scene>(std::move(**own));
  job.scene = job.own ? job.own.get() : &scene;
  if (const Status status = fill_bodies(job, context); !status) return status.error();
  if (const Status status = place(job, whole, context); !status) return status.error();
  return job;
}

/// Cuts the bodies by the section planes, and chooses hatches where the whole did not.
Status cut_bodies(ViewJob& job, std::span<const SectionPlane> planes, const WholeView* whole,
                  const parallel::Context& context) {
  job.uncut = find_uncut(*job.scene, job.drawn, job.options.uncut, planes);
  job.counters.uncut_objects = static_cast<std::uint64_t>(std::ranges::count(job.uncut, true));
  auto sectioned = make_sectioned_shapes(*job.scene, job.drawn, job.uncut, planes, context);
  if (!sectioned) return sectioned.error();
  job.sectioned = std::move(*sectioned);
  if (const Status status = widen_contact(job, context); !status) return status;
  if (whole != nullptr) {
    job.hatches.assign(whole->hatches.begin(), whole->hatches.end());
    return {};
  }
  auto hatches = choose_hatches(job, planes, context);
  if (!hatches) return hatches.error();
  job.hatches = std::move(*hatches);
  return {};
}

/// Returns ViewJob::shows_lines.
std::function<bool(const Box3l&)> where_lines_are_shown(const ViewJob& job,
                                                        std::span<const SectionPlane> planes) {
  const ViewVolume shown = shown_volume(job.view, job.options, planes);
  if (job.options.clipped || !shown.is_bounded()) return {};
  // A line along the border of what is shown is kept, too.
  return [shown](const Box3l& box) { return shown.meets(box.inflated(1)); };
}

}  // namespace

Result<ViewJob> prepare_view(const ViewInput& input, const parallel::Context& context) {
  const auto planes = section_planes(input.view.sections);
  if (!planes) return planes.error();
  auto begun = begin_job(input, context);
  if (!begun) return begun.error();
  ViewJob job = std::move(*begun);
  job.shows_lines = where_lines_are_shown(job, *planes);
  const auto crossings = find_intersection_lines(
      *job.scene, job.drawn, job.contact,
      {job.options.intersections, job.cos_sharp, job.to_solve, job.shows_lines}, context);
  if (!crossings) return crossings.error();
  job.counters.crossing_pairs = crossings->pairs;
  job.counters.crossing_tests = crossings->tests;
  if (const Status status = cut_bodies(job, *planes, input.whole, context); !status)
    return status.error();
  auto lines = derive_lines(job, crossings->all, *planes, context);
  if (!lines) return lines.error();
  job.lines = std::move(*lines);
  if (input.whole == nullptr) {
    auto of_sections = report_sections(*job.scene, job.drawn, job.sectioned, *planes, context);
    if (!of_sections) return of_sections.error();
    job.diagnostics = std::move(*of_sections);
  }
  const Result<Diagnostics> of_eye = report_eye(job, context);
  if (!of_eye) return of_eye.error();
  job.diagnostics.append(*of_eye);
  return job;
}

void take_down(ViewJob& job, const parallel::Context& context) {
  parallel::clear(job.sectioned.all, context);
  if (job.own) parallel::clear(job.own->shapes, context);
}

Result<WholeSections> prepare_sections(const ViewInput& input, const parallel::Context& context) {
  const auto planes = section_planes(input.view.sections);
  if (!planes) return planes.error();
  auto job = begin_job(input, context);
  if (!job) return job.error();
  if (const Status status = cut_bodies(*job, *planes, nullptr, context); !status)
    return status.error();
  auto diagnostics = report_sections(*job->scene, job->drawn, job->sectioned, *planes, context);
  if (!diagnostics) return diagnostics.error();
  return WholeSections{std::move(job->hatches), job->contact_distance_mm,
                       job->counters.uncut_objects, std::move(*diagnostics)};
}

}  // namespace strake::hlr
