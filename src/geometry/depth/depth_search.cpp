// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/depth_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/depth/blocks.hpp"
#include "geometry/depth/search_frame.hpp"
#include "geometry/depth/simplex.hpp"
#include "geometry/depth/uphill.hpp"
#include "geometry/range.hpp"

namespace strake::geometry {
namespace {

struct Cell {
  Simplex simplex;
  Vec3d promise;           ///< the point that `upper` stems from,
  bool in_a = true;        ///< as a depth in this part
  bool bent_last = false;  ///< it was not its parent's longest edge that was cut
  double upper = 0;        ///< no point of the cell that is in both is deeper
  std::uint32_t id = 0;
};

struct LessPromising {
  bool operator()(const Cell& x, const Cell& y) const {
    return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
  }
};

struct Edge {
  std::size_t from = 0, to = 1;
  double squared = 0;
};

Edge longest_edge(const Simplex& s) {
  Edge longest;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Vec3d e = s.corner[j].at - s.corner[i].at;
      if (dot(e, e) > longest.squared) longest = {i, j, dot(e, e)};
    }
  return longest;
}

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// A cell no longer than this, grid units, is not cut further.
constexpr double kSmallest = 0.25;

/// The edge to cut is chosen once a cell's bound is within this factor of the depth known; farther
/// off, where bounds say little, the longest is best.
constexpr double kNearlyThere = 1.5;
/// An edge shorter than the longest by more than this factor is not cut.
constexpr double kAspect = 16;
/// Cells, the most promising first, that are climbed from; later ones only now and then.
constexpr std::uint32_t kFirstClimbs = 16;
/// What the cut of an edge other than the longest must gain at least, relative to the bound.
constexpr double kLeastGain = 1e-3;

class Search {
 public:
  Search(const DepthField& a, const DepthField& b, const DepthGoal& goal, Depth& depth,
         PairWork& work)
      : a_(a),
        b_(b),
        goal_(goal),
        depth_(depth),
        work_(work),
        axes_(search_frame(a.part(), goal.triangle_a, b.part())) {}

  void run(std::span<const Vec3d> seeds) {
    const double ceiling = depth_.upper;
    const auto room = common_box();
    if (!room) return;
    for (const Vec3d& seed : seeds) climb(seed);
    plant(*room);
    double kept = 0;  // the greatest bound of a cell that is too small to cut
    while (!open_.empty() || !blocks_.empty()) {
      const double cells = open_.empty() ? 0 : open_.top().upper;
      const double blocks = blocks_.empty() ? 0 : blocks_.back().most();
      const double highest = std::max({cells, blocks, kept, depth_.value});
      depth_.upper = std::min(ceiling, highest);
      if (bracket_suffices(depth_, goal_)) return;
      if (exhausted()) {
        depth_.complete = false;
        return;
      }
      if (blocks > cells) {
        open_block();
        continue;
      }
      const Cell cell = open_.top();
      open_.pop();
      if (wants_climb()) climb_from_inside(cell.promise);
      const Edge longest = longest_edge(cell.simplex);
      if (longest.squared <= kSmallest * kSmallest)
        kept = std::max(kept, cell.upper);
      else
        cut(cell, bent_edge(cell, longest));
    }
    depth_.upper = std::min(ceiling, std::max(depth_.value + margin_, kept));
  }

 private:
  [[nodiscard]] bool exhausted() const {
    const bool decided = depth_.lower > goal_.threshold || depth_.upper <= goal_.threshold;
    return depth_.cells >= (decided ? goal_.cells_decided : goal_.cells_undecided);
  }

  /// The common box of the two in the frame; nothing where there is none.
  std::optional<Box3d> common_box() {
    Vec3d lo, size;
    double extent = 0;
    for (int k = 0; k < 3; ++k) {
      const Range x = a_.range_along(axes_[at(k)]), y = b_.range_along(axes_[at(k)]);
      const Range room = goal_.within ? range_along(*goal_.within, axes_[at(k)]) : x;
      lo[k] = std::max({x.lo, y.lo, room.lo}) - kStandOff;
      size[k] = std::min({x.hi, y.hi, room.hi}) + kStandOff - lo[k];
      if (!(size[k] > 0)) return std::nullopt;
      extent = std::max({extent, x.hi - x.lo, y.hi - y.lo});
    }
    margin_ = kFieldError * extent;
    slack_ = 1.0 / 1024 + margin_;
    return Box3d{lo, lo + size};
  }

  /// The common box in blocks.
  void plant(const Box3d& room) {
    const std::vector<Block> blocks = cut_into_blocks(a_, b_, axes_, room, slack_, work_);
    if (blocks.size() > 1) depth_.cells += blocks.size();
    for (const Block& block : blocks) {
      for (std::size_t i = 0; i < 2; ++i)
        if (block.upper[i] < kUnbounded && block.upper[i] > depth_.value + margin_)
          try_point(block.promise[i]);
      if (block.most() > depth_.value + margin_) blocks_.push_back(block);
    }
    const auto rank = [](const Block& x) {
      return std::tuple(x.most(), x.box.lo.x, x.box.lo.y, x.box.lo.z);
    };
    std::sort(blocks_.begin(), blocks_.end(),
              [&](const Block& x, const Block& y) { return rank(x) < rank(y); });
  }

  /// Takes up the block that promises most, as the six simplices round one of its diagonals.
  void open_block() {
    const Block block = blocks_.back();
    blocks_.pop_back();
    std::array<SimplexCorner, 8> corners;
    for (unsigned i = 0; i < 8; ++i) {
      Vec3d p;
      for (int k = 0; k < 3; ++k)
        p = p + axes_[at(k)] *
                    ((i >> static_cast<unsigned>(k) & 1U) != 0 ? block.box.hi[k] : block.box.lo[k]);
      corners[i] = look(p, nullptr);
    }
    constexpr std::array<std::array<unsigned, 2>, 6> kPaths{
        {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
    for (const auto& path : kPaths)
      bound({.simplex = {{corners[0], corners[path[0]], corners[path[1]], corners[7]}},
             .promise = {},
             .upper = block.most()});
  }

  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  /// A new corner; the side of a known one holds when no surface lies between the two.
  SimplexCorner look(const Vec3d& p, const SimplexCorner* known) {
    SimplexCorner corner{p, on_field_grid(p), {}, {}};
    corner.a = sample(a_, corner.sampled, known, known != nullptr ? &known->a : nullptr);
    corner.b = sample(b_, corner.sampled, known, known != nullptr ? &known->b : nullptr);
    if (corner.a.inside && corner.b.inside)
      improve(std::max(corner.a.distance, corner.b.distance), corner.sampled);
    return corner;
  }

  FieldSample sample(const DepthField& f, const Vec3d& p, const SimplexCorner* known,
                     const FieldSample* there) {
    FieldSample s;
    const NearestTriangle near = f.nearest(p, there != nullptr ? there->triangle : kNoFace);
    s.distance = near.distance;
    s.triangle = near.triangle;
    const bool same_side = there != nullptr && length(p - known->sampled) + margin_ <
                                                   std::max(there->distance, s.distance);
    s.inside = same_side ? there->inside : f.contains(p, work_);
    return s;
  }

  /// The edge whose cut takes most from the bound, every other time: where the bound suffers from
  /// something else, cells must get smaller still. The linear function
  /// above the distance to the triangle nearest to the promising point is off by as much as that
  /// distance bends.
  Edge bent_edge(const Cell& cell, const Edge& longest) const {
    if (cell.bent_last || !(cell.upper < kNearlyThere * depth_.value)) return longest;
    const DepthField& f = cell.in_a ? a_ : b_;
    const FieldSample SimplexCorner::* const sample =
        cell.in_a ? &SimplexCorner::a : &SimplexCorner::b;
    const auto& corner = cell.simplex.corner;
    const std::uint32_t t = f.nearest(cell.promise, (corner[0].*sample).triangle).triangle;
    const Corners triangle = f.corners(t);
    const auto distance = [&](const Vec3d& p) {
      return length(f.local(p) - nearest_on_triangle(f.local(p), triangle));
    };
    const std::array<double, 4> weight = weights(cell);
    Edge best = longest;
    double most = kLeastGain * cell.upper;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Vec3d e = corner[j].at - corner[i].at;
        if (dot(e, e) * kAspect * kAspect < longest.squared) continue;
        const double bend = distance(corner[i].at) + distance(corner[j].at) -
                            2 * distance((corner[i].at + corner[j].at) * 0.5);
        const double gain = bend * weight[i] * weight[j];
        if (gain > most) {
          most = gain;
          best = {i, j, dot(e, e)};
        }
      }
    return best;
  }

  /// Barycentric coordinates of the promising point, roughly.
  static std::array<double, 4> weights(const Cell& cell) {
    const auto& c = cell.simplex.corner;
    std::array<double, 4> w{};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d &p = c[(i + 1) % 4].at, &q = c[(i + 2) % 4].at, &r = c[(i + 3) % 4].at;
      w[i] = std::fabs(dot(cross(q - p, r - p), cell.promise - p));
      sum += w[i];
    }
    for (double& x : w) x = sum > 0 ? x / sum : 0.25;
    return w;
  }

  void cut(const Cell& cell, const Edge& edge) {
    const SimplexCorner &from = cell.simplex.corner[edge.from], &to = cell.simplex.corner[edge.to];
    const SimplexCorner middle = look((from.at + to.at) * 0.5, &from);
    for (const std::size_t replaced : {edge.from, edge.to}) {
      Cell child = cell;
      child.simplex.corner[replaced] = middle;
      child.bent_last = edge.squared < longest_edge(cell.simplex).squared;
      bound(child);
    }
  }

  /// Keeps the cell if something in it may be deeper than what is known; `upper` comes from its
  /// parent.
  void bound(Cell cell) {
    ++depth_.cells;
    if (lies_elsewhere(cell.simplex)) return;
    const auto bounds = bound_depth(a_, b_, cell.simplex, slack_, depth_.value + margin_, work_);
    if (!bounds) return;
    double most = 0;
    for (const SimplexBound& b : *bounds) {
      if (b.upper > most) {
        most = b.upper;
        cell.promise = b.point;
        cell.in_a = &b == bounds->data();
      }
      if (b.upper > depth_.value + margin_) try_point(b.point);
    }
    cell.upper = std::min(cell.upper, most);
    if (cell.upper <= depth_.value + margin_) return;
    cell.id = next_id_++;
    open_.push(cell);
  }

  /// Whether all of a simplex lies in one part of what is common, and that does not count.
  [[nodiscard]] bool lies_elsewhere(const Simplex& s) const {
    if (!goal_.belongs) return false;
    for (const SimplexCorner& c : s.corner) {
      if (!c.a.inside || !c.b.inside) continue;
      double radius = 0;
      for (const SimplexCorner& other : s.corner)
        radius = std::max(radius, length(other.at - c.sampled));
      // No skin within that radius.
      if (std::min(c.a.distance, c.b.distance) > radius + slack_) return !goal_.belongs(c.sampled);
    }
    return false;
  }

  void try_point(const Vec3d& p) {
    if (deepens(p)) climb(depth_.point);
  }

  /// Whether a point is deeper than what is known, which it then is.
  bool deepens(const Vec3d& p) {
    const Vec3d q = on_field_grid(p);
    const double depth = greater_distance(a_, b_, q), before = depth_.value;
    if (depth > before && a_.contains(q, work_) && b_.contains(q, work_)) improve(depth, q);
    return depth_.value > before;
  }

  /// What promises most is seldom deeper than what is known, but a deeper point may lie uphill.
  bool wants_climb() {
    ++taken_;
    return taken_ <= kFirstClimbs || std::has_single_bit(taken_);
  }
  void climb_from_inside(const Vec3d& p) {
    const Vec3d q = on_field_grid(p);
    if (a_.contains(q, work_) && b_.contains(q, work_)) climb(q);
  }

  void climb(const Vec3d& from) {
    deepens(uphill(a_, b_, from, goal_.within));
    deepens(uphill(b_, a_, from, goal_.within));
  }

  void improve(double depth, const Vec3d& at) {
    if (!(depth > depth_.value)) return;
    if (!goal_.counts(at)) return;
    depth_.value = depth;
    depth_.lower = std::max(0.0, depth - margin_);
    depth_.point = at;
  }

  const DepthField &a_, &b_;
  const DepthGoal& goal_;
  Depth& depth_;
  PairWork& work_;
  Axes axes_;
  double margin_ = 0, slack_ = 0;
  std::vector<Block> blocks_;  ///< not yet taken up, the most promising last
  std::priority_queue<Cell, std::vector<Cell>, LessPromising> open_;
  std::uint32_t next_id_ = 0;
  std::uint32_t taken_ = 0;  ///< cells that were the most promising
};

}  // namespace

void search_solid_depth(const DepthField& a, const DepthField& b, const DepthGoal& goal,
                        std::span<const Vec3d> seeds, Depth& depth, PairWork& work) {
  DepthField ready_a = a, ready_b = b;
  ready_a.prepare();
  ready_b.prepare();
  Search(ready_a, ready_b, goal, depth, work).run(seeds);
}

}  // namespace strake::geometry
