// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/analytic/mesh_gap.hpp"
#include "geometry/depth/sheet_search.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/thin/crossing.hpp"
#include "geometry/thin/pieces.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/thin_pair.hpp"

namespace strake::geometry {
namespace {

using analytic::PairSide;
using analytic::Torus;
using thin::ExactLeast;
using thin::LeastGap;
using thin::Piece;
using thin::Pieces;

/// Grid units: farther from the skin than this, the grid point next to a point is on its side.
constexpr double kSnap = 2;
/// Chords of a quarter turn, at most.
constexpr int kMostChords = 1024;

/// The decisions are exact.
void add_piece(const Piece& piece, const TreedPart& mesh, double enough, ExactLeast& least) {
  const auto& nodes = mesh.tree->nodes();
  const PartView view(mesh, {});
  walk_nearer_first(
      *mesh.tree,
      [&](std::uint32_t i) { return squared_gap(piece.box, nodes[i].box.as<double>()); },
      [&](double squared) {
        return least.touching() || least.beyond(squared) ||
               std::sqrt(squared) * (1 - 1e-14) > enough;
      },
      [&](std::uint32_t t) { least.offer(piece.corners(), view.corners(t)); });
}

/// Chords of an arc, and how far it stands off them.
struct Chords {
  std::vector<std::array<Vec3d, 2>> segments;
  double sagitta = 0;

  explicit Chords(const Torus& arc) {
    const double radius = arc.profile().centre;
    for (const analytic::Arc& quarter : arc.arcs()) {
      const double angle = quarter.to - quarter.from;
      // A sagitta of half a unit: radius·step²/8.
      const double wanted = std::ceil(angle * std::sqrt(radius) / 2);
      const int count = std::max(1, static_cast<int>(std::min<double>(wanted, kMostChords)));
      const double step = angle / count;
      sagitta = std::max(sagitta, radius * step * step / 8);
      const auto at = [&](int i) {
        const SinCos s = sin_cos(quarter.from + step * i);
        return arc.centre() + arc.turned({radius * s.cos, radius * s.sin, 0});
      };
      for (int i = 0; i < count; ++i) segments.push_back({at(i), at(i + 1)});
    }
    sagitta += arc.error();
  }
};

/// What of a thin body may lie in a solid, measured by the search over pieces.
class DepthOfPieces {
 public:
  DepthOfPieces(const TreedPart& mesh, const DepthGoal& goal, PairWork& work)
      : mesh_(mesh), field_(mesh, {}), goal_(goal), work_(work) {
    const Box3i& box = mesh.placed.part->box;
    margin_ = kFieldError * 4 * (1 + length((box.hi - box.lo).as<double>()));
  }

  void add(const Piece& piece) {
    const auto at = [&](std::size_t i) {
      return piece.corner[std::min(i, piece.count - 1)].as<double>();
    };
    if (piece.count == 3) {
      const std::array<std::array<Vec3d, 3>, 1> triangle{{{at(0), at(1), at(2)}}};
      measure<3>(triangle, 0);
    } else {
      const std::array<std::array<Vec3d, 2>, 1> segment{{{at(0), at(1)}}};
      measure<2>(segment, 0);
    }
  }
  void add(const Torus& arc) {
    const Chords chords(arc);
    measure<2>(chords.segments, chords.sagitta);
  }
  [[nodiscard]] const Depth& result() const { return best_; }
  [[nodiscard]] bool holds(const Vec3l& p) const {
    return side_of(mesh_, p, 1, work_) != PointSide::outside;
  }

 private:
  template <std::size_t N>
  void measure(std::span<const std::array<Vec3d, N>> pieces, double off) {
    Depth depth;
    depth.upper = std::numeric_limits<double>::infinity();
    depth.value = depth.lower = best_.value;
    SheetSearch<N>(pieces, field_, goal_, depth, margin_, work_).run();
    best_.upper = std::max({best_.upper, depth.upper + off, depth.value});
    best_.cells += depth.cells;
    best_.complete = best_.complete && depth.complete;
    if (!(depth.value > best_.value)) return;
    best_.value = depth.value;
    best_.lower = std::max(best_.lower, depth.lower - off);
    best_.point = depth.point;
  }

  const TreedPart& mesh_;
  DepthField field_;
  const DepthGoal& goal_;
  PairWork& work_;
  double margin_ = 0;
  Depth best_;
};

/// The answer about a solid, from the distance to its skin and the depth.
ThinSeparation in_solid(const LeastGap& gap, const Depth& depth, const TreedPart& mesh) {
  ThinSeparation s;
  s.depth_complete = depth.complete;
  if (depth.lower > 0) {
    s.d = -depth.value;
    s.lower = -depth.upper;
    s.upper = -depth.lower;
    s.inside = true;
    s.on_thin = depth.point;
    s.on_other = nearest_on_skin(mesh, depth.point).point;
    return s;
  }
  s.lower = -depth.upper;
  s.upper = gap.upper;
  s.on_thin = gap.on_a;
  s.on_other = gap.on_b;
  return s;
}

ThinSeparation through_sheet(const thin::Crossing& crossing) {
  // Roundings of a point and of a distance to a segment.
  const double error = kFieldError * crossing.depth + 1e-6;
  ThinSeparation s;
  s.d = -crossing.depth;
  s.lower = s.d - error;
  s.upper = std::min(0.0, s.d + error);
  s.inside = s.upper < 0;
  s.on_thin = s.on_other = crossing.point;
  return s;
}

}  // namespace

ThinSeparation thin_separation(const ThinBody& thin, const TreedPart& mesh, const DepthGoal& goal,
                               PairWork& work, double enough) {
  const Pieces pieces(thin, mesh.placed.origin);
  const bool solid = mesh.placed.part->kind == PartKind::solid;
  const Vec3d back = (mesh.placed.origin - thin.origin).as<double>();
  ExactLeast exact;
  LeastGap least;
  DepthOfPieces depth(mesh, goal, work);
  bool meets = false, all_within = true;
  for (const Piece& piece : pieces.simplices) {
    ExactLeast own;
    add_piece(piece, mesh, enough, solid ? own : exact);
    if (!solid) continue;
    least.add(own);
    const bool within = !own.touching() && depth.holds(piece.corner[0]);
    all_within = all_within && within;
    if (!own.touching() && !within) continue;
    meets = true;
    depth.add(piece);
  }
  least.add(exact);
  for (const PairSide& arc : pieces.arcs) {
    const AnalyticGap gap = analytic::mesh_gap(arc, mesh, std::min(enough, least.upper));
    least.add(gap.lower, gap.upper, gap.on_primitive, gap.on_mesh);
    if (!solid) continue;
    const Vec3d start = arc.torus->nearest(arc.torus->centre());
    const Vec3l near{std::llround(start.x), std::llround(start.y), std::llround(start.z)};
    const bool within = gap.lower > kSnap && depth.holds(near);
    all_within = all_within && within;
    if (gap.lower > kSnap && !within) continue;
    meets = true;
    depth.add(*arc.torus);
  }
  const thin::Crossing crossing =
      exact.touching() && !solid ? thin::deepest_crossing(thin, mesh) : thin::Crossing{};
  ThinSeparation s;
  if (crossing.depth > 0) {
    s = through_sheet(crossing);
  } else if (meets) {
    s = in_solid(least, depth.result(), mesh);
    // What lies farther from the skin than anybody asked is no less inside.
    if (s.inside && all_within) s.wholly_inside = std::min(least.lower, -s.d);
  } else {
    s.lower = std::max(0.0, std::min(least.lower, enough));
    s.upper = std::min(least.upper, s.lower < enough ? least.upper : s.lower);
    s.on_thin = least.on_a;
    s.on_other = least.on_b;
    s.d = (s.lower + s.upper) / 2;
  }
  s.on_thin = s.on_thin + back;
  s.on_other = s.on_other + back;
  return s;
}

}  // namespace strake::geometry
