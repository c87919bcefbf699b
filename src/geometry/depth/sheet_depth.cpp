// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <vector>

#include "geometry/depth/boundary_curve.hpp"
#include "geometry/depth/depth_field.hpp"
#include "geometry/depth/depth_search.hpp"
#include "geometry/depth/radius_lp.hpp"
#include "geometry/depth/sheet_search.hpp"
#include "geometry/sheet_curve.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// Work limit of the search over common segments.
constexpr std::size_t kMaxSegments = 20000;

/// Upper bound of a sheet in a solid: half-spaces of the solid for the ball, of both for its
/// centre.
double hull_bound(const DepthPart& sheet, const DepthField& fs, const DepthPart& solid,
                  const DepthField& fb, double extent) {
  std::vector<RadiusConstraint> rows;
  const Box3i& box = sheet.treed.placed.part->box;
  const Vec3d centre = (box.lo.as<double>() + box.hi.as<double>()) * 0.5;
  const auto add = [&](const DepthField& f, const Vec3d& n, double support, double weight) {
    rows.push_back({n, weight, support - dot(n, f.local(centre)) + kFieldError * extent});
  };
  for (std::size_t i = 0; i < 4; ++i)
    add(fb, tetrahedral_directions()[i], solid.planes->tetrahedral[i], 1);
  for (const auto& p : solid.planes->planes) add(fb, p.normal, p.support, 1);
  for (const auto& p : sheet.planes->planes) {
    add(fs, p.normal, p.support, 0);
    add(fs, -p.normal, sheet.planes->vertices.greatest_along(-p.normal).value, 0);
  }
  return std::max(0.0, maximise_radius({rows, extent}).upper);
}

struct Segment {
  std::array<Vec3d, 2> end;
  double upper = 0;
  std::uint32_t id = 0;
};

struct LessPromisingSegment {
  bool operator()(const Segment& x, const Segment& y) const {
    return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
  }
};

class CurveSearch {
 public:
  CurveSearch(const TreedPart& a, const TreedPart& b, const DepthGoal& goal, PairWork& work)
      : a_(*a.placed.part),
        b_(*b.placed.part),
        goal_(goal),
        crossing_(crossing_curve(a, b, goal.apart_within, kMaxSegments, work)),
        shift_((b.placed.origin - a.placed.origin).as<double>()),
        curve_a_(boundary_curve(a_)),
        curve_b_(boundary_curve(b_)) {}

  Depth run() {
    if (!crossing_.crosses) return depth_;
    for (const auto& segment : crossing_.segments) evaluate(segment);
    // Beyond the limit on segments nothing is known but the size of the smaller sheet.
    const double ceiling = std::min(size(a_), size(b_));
    if (crossing_.truncated) depth_.upper = ceiling;
    while (!open_.empty()) {
      const Segment s = open_.top();
      depth_.upper = std::max(crossing_.truncated ? ceiling : s.upper, depth_.value);
      if (bracket_suffices(depth_, goal_) || depth_.cells >= limit()) return depth_;
      open_.pop();
      const Vec3d middle = (s.end[0] + s.end[1]) * 0.5;
      evaluate({s.end[0], middle});
      evaluate({middle, s.end[1]});
    }
    if (!crossing_.truncated) depth_.upper = depth_.value + kSlack;
    return depth_;
  }

 private:
  static constexpr double kSlack = 1.0 / 256;

  [[nodiscard]] std::uint64_t limit() const {
    const bool decided = depth_.lower > goal_.threshold || depth_.upper <= goal_.threshold;
    return crossing_.segments.size() + (decided ? goal_.cells_decided : goal_.cells_undecided);
  }
  static double size(const Part& p) {
    return length(p.box.hi.as<double>() - p.box.lo.as<double>());
  }

  [[nodiscard]] double depth_at(const Vec3d& p) const {
    double d = std::min(size(a_), size(b_));
    for (const auto& e : curve_a_) d = std::min(d, length(p - nearest_on_segment(p, e[0], e[1])));
    const Vec3d q = p - shift_;
    for (const auto& e : curve_b_) d = std::min(d, length(q - nearest_on_segment(q, e[0], e[1])));
    return d;
  }

  void evaluate(const std::array<Vec3d, 2>& end) {
    if (goal_.within && !box_of(end).meets(*goal_.within)) return;
    ++depth_.cells;
    const Vec3d middle = (end[0] + end[1]) * 0.5;
    const double d = depth_at(middle), radius = length(end[1] - end[0]) / 2;
    if (d > depth_.value && goal_.counts(middle)) {
      depth_.value = d;
      depth_.lower = std::max(0.0, d - kSlack);
      depth_.point = middle;
    }
    const double upper = d + radius + kSlack;
    if (upper > depth_.value + 2 * kSlack) open_.push({end, upper, next_id_++});
  }

  const Part &a_, &b_;
  const DepthGoal& goal_;
  CrossingCurve crossing_;
  Vec3d shift_;
  std::vector<std::array<Vec3d, 2>> curve_a_, curve_b_;
  std::priority_queue<Segment, std::vector<Segment>, LessPromisingSegment> open_;
  Depth depth_;
  std::uint32_t next_id_ = 0;
};

/// The triangles of a sheet that may reach into a box, in their order; all of a small one.
std::vector<Corners> pieces_near(const DepthField& sheet, const Box3d& room) {
  std::vector<std::uint32_t> near;
  if (sheet.has_many_vertices()) {
    const Box3d own{sheet.local(room.lo), sheet.local(room.hi)};
    walk_tree(
        sheet.tree(), [&](const PartTree::Node& node) { return node.box.as<double>().meets(own); },
        [&](std::uint32_t t) {
          near.push_back(t);
          return true;
        });
    std::ranges::sort(near);
  } else {
    near.resize(sheet.part().triangles.size());
    std::iota(near.begin(), near.end(), 0U);
  }
  std::vector<Corners> pieces;
  pieces.reserve(near.size());
  for (const std::uint32_t t : near) pieces.push_back(corners_of(sheet.part(), t));
  return pieces;
}

}  // namespace

Depth sheet_in_solid_depth(const DepthPart& sheet, const DepthPart& solid, const DepthGoal& goal,
                           PairWork& work) {
  const DepthField fs(sheet.treed, {}, &sheet.planes->vertices);
  const DepthField fb(solid.treed, sheet.treed.placed.origin - solid.treed.placed.origin,
                      &solid.planes->vertices);
  double extent = 1;
  for (const Part* part : {&fs.part(), &fb.part()})
    for (int k = 0; k < 3; ++k)
      extent = std::max(extent, 2.0 * (static_cast<double>(part->box.hi[k]) -
                                       static_cast<double>(part->box.lo[k])));
  Depth depth;
  depth.upper = hull_bound(sheet, fs, solid, fb, extent);
  const std::vector<Corners> pieces = pieces_near(fs, fb.box());
  SheetSearch<3>(pieces, fb, goal, depth, kFieldError * extent, work, fs.part().triangles.size())
      .run();
  depth.upper = std::max(depth.upper, depth.value);
  return depth;
}

Depth sheet_crossing_depth(const TreedPart& a, const TreedPart& b, const DepthGoal& goal,
                           PairWork& work) {
  Depth depth = CurveSearch(a, b, goal, work).run();
  work.triangle_pairs += depth.cells;
  depth.upper = std::max(depth.upper, depth.value);
  return depth;
}

}  // namespace strake::geometry
