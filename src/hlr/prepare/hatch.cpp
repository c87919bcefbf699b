// SPDX-License-Identifier: Apache-2.0
// The choice of hatches, and the hatch lines of caps.
#include "hlr/prepare/hatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "geometry/bvh/scene_bvh.hpp"
#include "geometry/numeric/trig.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/view/projection.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/wide_int.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::hlr {
namespace {

using geometry::BoxItem;

constexpr std::array<double, 6> kAngles{45, 135, 30, 120, 60, 150};
/// The spacings to choose from, in usual spacings.
constexpr std::array<double, 4> kSpacings{1, 1.5, 0.75, 2};

// Only shares the work out.
constexpr std::size_t kHatchedPerBlock = 1024;

/// Returns the segments of outlines that are hatched, as boxes with their object.
Result<std::vector<BoxItem>> outlines(const model::Scene& scene, const SectionedShapes& sectioned,
                                      const std::vector<std::int64_t>& contact,
                                      const parallel::Context& context) {
  return parallel::collect<BoxItem>(
      context, {.name = "hatch: outlines", .n = scene.bodies.size(), .grain = kHatchedPerBlock},
      [&](std::size_t b, std::vector<BoxItem>& items) {
        const ShapeCut* cut = sectioned.all[sectioned.of[b]].cut.get();
        if (cut == nullptr) return;
        const model::GridBody& body = scene.bodies[b];
        for (const auto& rim : cut->rims)
          for (const auto& [p, q] : rim) {
            geometry::Box3l box = geometry::empty_box<std::int64_t>();
            box.include(p + body.origin);
            box.include(q + body.origin);
            items.push_back({.box = box.inflated(contact[b]), .owner = model::index(body.object)});
          }
      });
}

/// An object that is cut, and the colour of its first body that is.
struct CutObject {
  std::uint32_t object = 0, colour = 0;
};

Result<std::vector<CutObject>> cut_objects(const model::Scene& scene,
                                           const SectionedShapes& sectioned,
                                           const parallel::Context& context) {
  return parallel::collect<CutObject>(
      context,
      {.name = "hatch: cut objects",
       .n = scene.first_body.empty() ? 0 : scene.first_body.size() - 1,
       .grain = kHatchedPerBlock},
      [&](std::size_t o, std::vector<CutObject>& out) {
        for (std::uint32_t b = scene.first_body[o]; b < scene.first_body[o + 1]; ++b) {
          if (sectioned.all[sectioned.of[b]].planes.empty()) continue;
          const model::Color& c = scene.model->bodies[scene.bodies[b].body].color;
          out.push_back({static_cast<std::uint32_t>(o),
                         (std::uint32_t{c.red} << 16U) | (std::uint32_t{c.green} << 8U) | c.blue});
          return;
        }
      });
}

/// Puts, in the place of each colour, its number among those of all.
void number_colours(std::vector<CutObject>& cut) {
  std::vector<std::uint32_t> known;
  for (const CutObject& object : cut) known.push_back(object.colour);
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (CutObject& object : cut)
    object.colour =
        static_cast<std::uint32_t>(std::ranges::lower_bound(known, object.colour) - known.begin());
}

/// An object, and one whose outlines are near its own.
using Neighbours = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Returns all neighbours by object, both ways, each once.
Result<Neighbours> neighbours_of(const std::vector<BoxItem>& items,
                                 const std::vector<geometry::IndexPair>& pairs,
                                 const parallel::Context& context) {
  const auto owners = [&](std::size_t i) {
    return std::pair(items[pairs[i].first].owner, items[pairs[i].second].owner);
  };
  // Two outlines are near each other with many of their segments.
  const auto kinds = parallel::distinct(
      context, "hatch: neighbours", pairs.size(),
      [&](std::size_t i) {
        return parallel::mixed(parallel::mixed(0, owners(i).first), owners(i).second);
      },
      [&](std::size_t i, std::size_t j) { return owners(i) == owners(j); });
  if (!kinds) return kinds.error();
  Neighbours both;
  both.reserve(2 * kinds->first.size());
  for (const std::uint32_t i : kinds->first) {
    const auto [x, y] = owners(i);
    both.emplace_back(x, y);
    both.emplace_back(y, x);
  }
  std::ranges::sort(both);
  const auto repeated = std::ranges::unique(both);
  both.erase(repeated.begin(), repeated.end());
  return both;
}

/// Returns the first of the usual angles that the fewest neighbours have.
double rarest_angle(std::span<const Neighbours::value_type> neighbours,
                    const std::vector<Hatch>& hatches) {
  std::array<std::size_t, kAngles.size()> had{};
  for (const auto& [object, other] : neighbours)
    for (std::size_t i = 0; i < kAngles.size(); ++i)
      if (hatches[other].angle_deg == kAngles[i]) ++had[i];
  return kAngles[static_cast<std::size_t>(std::ranges::min_element(had) - had.begin())];
}

}  // namespace

Result<std::vector<Hatch>> choose_hatches(const model::Scene& scene,
                                          const SectionedShapes& sectioned,
                                          const std::vector<std::int64_t>& contact,
                                          const std::vector<Hatch>& given, double usual_mm,
                                          const parallel::Context& context) {
  std::vector<Hatch> hatches = given;
  hatches.resize(scene.model->objects.size());
  const auto items = outlines(scene, sectioned, contact, context);
  if (!items) return items.error();
  const auto tree = geometry::SceneBvh::build(*items, context);
  if (!tree) return tree.error();
  const auto pairs = geometry::overlapping_box_pairs(*tree, context);
  if (!pairs) return pairs.error();
  const auto neighbours = neighbours_of(*items, *pairs, context);
  if (!neighbours) return neighbours.error();
  auto cut = cut_objects(scene, sectioned, context);
  if (!cut) return cut.error();
  number_colours(*cut);
  for (const auto& [o, colour] : *cut) {
    const auto own = std::ranges::equal_range(*neighbours, o, {}, &Neighbours::value_type::first);
    if (hatches[o].angle_deg < 0)
      hatches[o].angle_deg = rarest_angle({own.begin(), own.end()}, hatches);
    if (hatches[o].spacing_mm < 0)
      hatches[o].spacing_mm = usual_mm * kSpacings[colour % kSpacings.size()];
  }
  return hatches;
}

namespace {

using geometry::Int128;
using geometry::Segment;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kFinest = 1048576;  // 20 bits of direction

/// Where a hatch line meets a rim: (u, v) = num / den, and whether it enters or leaves.
struct Meeting {
  std::int64_t line = 0;
  Int128 u = 0, v = 0, den = 1;
  int turn = 0;
};

std::int64_t floor_quotient(Int128 a, std::int64_t b) {
  return static_cast<std::int64_t>(a / b - (a % b != 0 && a < 0 ? 1 : 0));
}

}  // namespace

HatchGrid::HatchGrid(const Vec3l& normal, const View& view, double angle_deg, double spacing)
    : axes_(normal) {
  const Vec3d n = geometry::unit(normal.as<double>());
  const ViewAxes paper = axes_of(view);
  const auto in_plane = [&](const Vec3d& v) { return v - n * dot(v, n); };
  // A plane that is seen from an eye may still be square to the paper's horizontal.
  constexpr double kNone = 1e-12;
  const Vec3d right = in_plane(paper.right);
  const Vec3d level = geometry::unit(dot(right, right) > kNone ? right : in_plane(paper.up));
  const geometry::SinCos turn = geometry::sin_cos(angle_deg / 180 * geometry::kPi);
  const Vec3d along = level * turn.cos + cross(n, level) * turn.sin;
  // Across the lines, in the plane; the third coordinate is one of the plane's own.
  const Vec3d m = cross(n, along);
  const double u = m[axes_.u] - m[axes_.w] * n[axes_.u] / n[axes_.w];
  const double v = m[axes_.v] - m[axes_.w] * n[axes_.v] / n[axes_.w];
  const double scale = kFinest / std::max(std::abs(u), std::abs(v));
  along_u_ = std::llround(u * scale);
  along_v_ = std::llround(v * scale);
  step_ = std::max<std::int64_t>(1, std::llround(spacing * scale));
}

std::vector<Segment> HatchGrid::within(std::span<const Segment> rim,
                                       const geometry::CutPlane& plane, const Vec3l& origin) const {
  // Line k of the body lies where value = k·step - shift.
  const Int128 at_origin = static_cast<Int128>(along_u_) * origin[axes_.u] +
                           static_cast<Int128>(along_v_) * origin[axes_.v];
  const auto shift = static_cast<std::int64_t>(
      at_origin - static_cast<Int128>(floor_quotient(at_origin, step_)) * step_);
  std::vector<Meeting> meetings;
  for (const auto& [p, q] : rim) {
    const std::int64_t fp = value(p) + shift, fq = value(q) + shift;
    // The lines k with min < k·step <= max: a line through a corner meets one of two sides.
    const std::int64_t first = floor_quotient(std::min(fp, fq), step_) + 1;
    const std::int64_t last = floor_quotient(std::max(fp, fq), step_);
    for (std::int64_t k = first; k <= last; ++k) {
      Meeting m{.line = k, .den = std::abs(fq - fp), .turn = fq > fp ? 1 : -1};
      const Int128 share = fq > fp ? k * step_ - fp : fp - k * step_;
      m.u = p[axes_.u] * m.den + (q[axes_.u] - p[axes_.u]) * share;
      m.v = p[axes_.v] * m.den + (q[axes_.v] - p[axes_.v]) * share;
      meetings.push_back(m);
    }
  }
  const bool by_u = std::abs(along_v_) >= std::abs(along_u_);
  const auto place = [&](const Meeting& m) { return by_u ? m.u : m.v; };
  const auto order = [&](const Meeting& a, const Meeting& b) {
    return geometry::compare_fractions(place(a), a.den, place(b), b.den);
  };
  std::ranges::sort(meetings, [&](const Meeting& a, const Meeting& b) {
    return a.line != b.line ? a.line < b.line : order(a, b) < 0;
  });
  const auto point = [&](const Meeting& m) {
    Vec3l p;
    p[axes_.u] = geometry::round_div(m.u, m.den);
    p[axes_.v] = geometry::round_div(m.v, m.den);
    const std::int64_t n = plane.normal[axes_.w];
    const Int128 rest =
        plane.offset * m.den - plane.normal[axes_.u] * m.u - plane.normal[axes_.v] * m.v;
    p[axes_.w] = geometry::round_div(n < 0 ? -rest : rest, m.den * std::abs(n));
    return p;
  };
  std::vector<Segment> lines;
  const Meeting* entered = nullptr;
  int winding = 0;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    winding += meetings[i].turn;
    // Meetings at one place count together.
    if (i + 1 < meetings.size() && meetings[i + 1].line == meetings[i].line &&
        order(meetings[i], meetings[i + 1]) == 0)
      continue;
    if (winding != 0 && entered == nullptr) entered = &meetings[i];
    if (winding != 0 || entered == nullptr) continue;
    Segment line{point(*entered), point(meetings[i])};
    if (line[1] < line[0]) std::swap(line[0], line[1]);
    if (line[0] != line[1]) lines.push_back(line);
    entered = nullptr;
  }
  std::ranges::sort(lines);
  return lines;
}

namespace {

using geometry::Box3l;

/// The usual spacing is this fraction of the drawing's largest side: 2.5 mm or so of paper.
constexpr double kUsualShare = 150;
/// A hatch finer than this fraction of the drawing is a black face, of more lines than anybody
/// wants.
constexpr double kFinestShare = 20000;
constexpr double kFinestMm = 0.01;

/// Returns the largest side of what the sections leave, mm.
Result<double> largest_side(const ViewJob& job, const parallel::Context& context) {
  const model::Scene& scene = *job.scene;
  const auto left = parallel::reduce(
      context, {.name = "hatch: extent", .n = scene.bodies.size(), .grain = kHatchedPerBlock},
      geometry::empty_box<std::int64_t>(),
      [&](Box3l& box, std::size_t index) {
        const auto b = static_cast<std::uint32_t>(index);
        const model::GridShape& shape = scene.shapes[scene.bodies[b].grid_shape];
        if (!job.drawn[model::index(scene.bodies[b].object)] || job.sectioned_shape_of(b).away)
          return;
        if (!shape.box.empty()) box.include(scene.bodies[b].box(shape));
      },
      [](Box3l& into, const Box3l& box) { into.include(box); });
  if (!left) return left.error();
  Box3l box = *left;
  if (job.view.limits) box = box.common(*job.view.limits);
  if (box.empty()) return 0.0;
  const Vec3l size = box.hi - box.lo;
  return static_cast<double>(std::max({size.x, size.y, size.z})) * geometry::kMmPerGrid;
}

/// Returns the first of 1, 2, 5, 10 … that is no less.
double usual_number(double least) {
  double decade = kFinestMm;
  for (;; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (decade * step >= least) return decade * step;
}

Status check(const ViewJob& job, double usual_mm, double side_mm) {
  const auto fault = [](const char* what, const char* mend) {
    return Error{ErrorCode::usage, what, "hatch", mend};
  };
  const double finest = std::max(side_mm / kFinestShare, kFinestMm);
  const auto makes_sense = [&](double spacing) { return spacing >= finest && spacing < 1e9; };
  if (!makes_sense(usual_mm))
    return fault("the distance of hatch lines is too small for the drawing, or too large",
                 "leave it out to have it chosen");
  for (const Hatch& hatch : job.options.hatches) {
    if (!(hatch.spacing_mm <= 0) && !makes_sense(hatch.spacing_mm))
      return fault("the distance of hatch lines is too small for the drawing, or too large",
                   "leave it out to have it chosen");
    if (!(hatch.angle_deg <= 180))
      return fault("the angle of hatch lines is not between 0 and 180 degrees",
                   "45 is the usual angle");
  }
  if (!job.options.hatches.empty() && job.options.hatches.size() != job.drawn.size())
    return Error{ErrorCode::usage, "the hatches and the model differ in size", "hatch",
                 "give one entry per object of the scene"};
  return {};
}

bool is_towards(const ViewJob& job, const SectionPlane& plane) {
  if (job.view.perspective) return plane.height(job.view.perspective->eye) > 0;
  return along({plane.normal.x, plane.normal.y, plane.normal.z}, job.direction()) > 0;
}

/// Appends the hatch of one body.
void add_body(const ViewJob& job, std::span<const SectionPlane> planes, std::uint32_t b,
              const Hatch& hatch, std::vector<Line>& out) {
  const SectionedShape& sectioned = job.sectioned_shape_of(b);
  if (!sectioned.cut || hatch.spacing_mm == 0) return;
  const Vec3l origin = job.scene->bodies[b].origin;
  for (std::size_t p = 0; p < sectioned.planes.size(); ++p) {
    const SectionPlane& plane = planes[sectioned.numbers[p]];
    if (!is_towards(job, plane) || sectioned.cut->rims[p].empty()) continue;
    const HatchGrid grid(plane.normal, job.view, hatch.angle_deg,
                         hatch.spacing_mm * geometry::kGridPerMm);
    for (const geometry::Segment& line :
         grid.within(sectioned.cut->rims[p], sectioned.planes[p], origin))
      out.push_back({line[0] + origin, line[1] + origin, b, b, EdgeKind::hatch, false});
  }
}

}  // namespace

Result<std::vector<Hatch>> choose_hatches(const ViewJob& job, std::span<const SectionPlane> planes,
                                          const parallel::Context& context) {
  if (planes.empty() || job.options.hatch_spacing_mm == 0) return std::vector<Hatch>{};
  const Result<double> side = largest_side(job, context);
  if (!side) return side.error();
  const double side_mm = *side;
  if (side_mm == 0) return std::vector<Hatch>{};
  const double usual_mm = job.options.hatch_spacing_mm < 0 ? usual_number(side_mm / kUsualShare)
                                                           : job.options.hatch_spacing_mm;
  if (const Status status = check(job, usual_mm, side_mm); !status) return status.error();
  return choose_hatches(*job.scene, job.sectioned, job.contact, job.options.hatches, usual_mm,
                        context);
}

Result<std::vector<Line>> hatch_lines(const ViewJob& job, std::span<const SectionPlane> planes,
                                      const parallel::Context& context) {
  if (job.hatches.empty()) return std::vector<Line>{};
  return parallel::collect<Line>(
      context, {.name = "sections: hatch", .n = job.scene->bodies.size(), .grain = 16},
      [&](std::size_t b, std::vector<Line>& out) {
        const model::ObjectId object = job.scene->bodies[b].object;
        add_body(job, planes, static_cast<std::uint32_t>(b), job.hatches[model::index(object)],
                 out);
      });
}

}  // namespace strake::hlr
