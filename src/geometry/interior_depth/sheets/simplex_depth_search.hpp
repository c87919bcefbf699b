// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0006 says how simplices are searched; sheets still are.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh/parallel_traversal.hpp"
#include "geometry/interior_depth/local_depth_maximum.hpp"
#include "geometry/interior_depth/solid_depth_search.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::geometry {

/// Work limit: simplices per cell of the limit for two solids, since they are cheaper.
inline constexpr std::uint32_t kSimplicesPerCell = 2;
/// Brackets get as narrow as this, relative to the depth, whatever the goal allows: for two solids
/// that would take too long. With 0.02 depths came out 1 to 2 % short.
inline constexpr double kSheetRelative = 0.01;

/// Maximum number of steps from simplex to simplex of a climbing point, and the least relative gain
/// of one. In an engine whose parts are sheets such steps made a depth of 93.9 mm 101.3 in the same
/// time (decision 0037).
inline constexpr int kMaxDepthSteps = 8;
inline constexpr double kMinGain = 1e-3;

/// Finds the deepest point in a solid of triangles (N = 3) or segments (N = 2) in the coordinates
/// of the field. The branch and bound halves simplices at their longest edges; where the work limit
/// ends it, the deepest point found climbs to a local maximum.
template <std::size_t N>
class SimplexDepthSearch {
 public:
  using Shape = std::array<Vec3d, N>;

  /// Raises `depth` where the simplices are deeper; its upper bound is a ceiling. `whole`: the
  /// number of all simplices, if these are only those near the solid; the work limit depends on it,
  /// or on those in the goal's box.
  SimplexDepthSearch(std::span<const Shape> pieces, const DistanceField& solid,
                     const DepthOptions& goal, Depth& depth, double margin, QueryContext& work,
                     std::size_t whole = 0)
      : pieces_(pieces),
        solid_(solid),
        goal_(goal),
        depth_(depth),
        margin_(margin),
        slack_(1.0 / 1024 + margin),
        work_(work),
        whole_(std::max(whole, pieces.size())) {}

  void run() {
    const double ceiling = depth_.upper;
    evaluate_all(ceiling);
    if (goal_.within) whole_ = std::min<std::uint64_t>(whole_, depth_.cells);
    while (!open_.empty()) {
      depth_.upper = std::min(ceiling, std::max(open_.front().upper, depth_.value));
      if (suffices()) return;
      if (exhausted()) {
        climb();
        depth_.complete = suffices();
        return;
      }
      std::ranges::pop_heap(open_, LessPromising());
      const OpenSimplex piece = open_.back();
      open_.pop_back();
      halve(piece);
    }
    depth_.upper = std::min(ceiling, negligible_depth(depth_));
  }

 private:
  struct OpenSimplex {
    Shape corners;
    double upper = 0;
    std::uint32_t nearest = kNoIndex;
    std::uint32_t id = 0;
  };
  struct LessPromising {
    bool operator()(const OpenSimplex& x, const OpenSimplex& y) const {
      return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
    }
  };
  /// The result of a block of simplices.
  struct BlockResult {
    Depth depth;
    std::vector<OpenSimplex> open;  ///< what may be deeper, as they came
    QueryStats cost;
    std::uint32_t nearest = kNoIndex;  ///< to the last one: likely near to the next
  };

  void evaluate_all(double ceiling) {
    if (pieces_.size() < kParallelThreshold) {
      const Box3d room = solid_.box();
      std::uint32_t nearest = kNoIndex;
      for (const Shape& c : pieces_) {
        if (!box_of(c).meets(room)) continue;
        if (const auto piece = evaluate(c, nearest, ceiling, depth_, work_)) push(*piece);
      }
      return;
    }
    evaluate_in_blocks(ceiling);
  }

  /// Evaluates blocks that do not depend on the team, each independently.
  void evaluate_in_blocks(double ceiling) {
    const Box3d room = solid_.box();
    const auto found = parallel::reduce(
        work_.context(), {.name = "pieces of a skin", .n = pieces_.size(), .grain = kParallelGrain},
        BlockResult(),
        [&](BlockResult& block, std::size_t i) {
          if (!box_of(pieces_[i]).meets(room)) return;
          QueryContext work;
          if (auto piece = evaluate(pieces_[i], block.nearest, ceiling, block.depth, work))
            block.open.push_back(*piece);
          block.cost += work;
        },
        [](BlockResult& all, const BlockResult& block) {
          const std::uint64_t cells = all.depth.cells + block.depth.cells;
          if (block.depth.value > all.depth.value) all.depth = block.depth;
          all.depth.cells = cells;
          all.open.insert(all.open.end(), block.open.begin(), block.open.end());
          all.cost += block.cost;
        });
    if (!found) return;
    work_ += found->cost;
    depth_.cells += found->depth.cells;
    if (found->depth.value > depth_.value) {
      depth_.value = found->depth.value;
      depth_.lower = found->depth.lower;
      depth_.point = found->depth.point;
    }
    for (const OpenSimplex& piece : found->open)
      if (piece.upper > negligible_depth(depth_)) push(piece);
  }

  void push(OpenSimplex piece) {
    piece.id = next_id_++;
    open_.push_back(piece);
    std::ranges::push_heap(open_, LessPromising());
  }

  /// Returns the depth up to which nothing deeper than the known point is gained.
  [[nodiscard]] double negligible_depth(const Depth& known) const {
    return std::max(known.value + margin_, goal_.negligible_depth);
  }

  [[nodiscard]] bool suffices() const {
    return is_decided(depth_, goal_) &&
           is_tight(depth_, goal_, std::min(goal_.relative, kSheetRelative));
  }

  [[nodiscard]] bool exhausted() const {
    const std::uint32_t cells =
        is_decided(depth_, goal_) ? goal_.cells_decided : goal_.cells_undecided;
    return depth_.cells >= std::uint64_t{kSimplicesPerCell} * cells + whole_;
  }

  /// Climbs from the deepest point found, along the simplices that contain it, to a local maximum,
  /// and on from there.
  void climb() {
    if (goal_.negligible_depth > 0) return;  // nobody needs the deepest point
    const Shape* climbed = nullptr;
    for (int step = 0; step < kMaxDepthSteps && depth_.value > 0; ++step) {
      const double known = depth_.value;
      const Vec3d from = depth_.point;
      const Shape* const last = climbed;
      for (const Shape& c : pieces_) {
        if (&c == last || !box_of(c).inflated(2 * slack_).contains({from, from})) continue;
        const Vec3d at = on_field_grid(local_depth_maximum_on(solid_, c, from, goal_.within));
        const double distance = solid_.nearest(at).distance;
        if (distance - slack_ <= depth_.value || !goal_.counts(at)) continue;
        if (!solid_.contains(at, work_)) continue;
        raise(depth_, distance, at);
        climbed = &c;
      }
      if (!(depth_.value > known * (1 + kMinGain))) return;
    }
  }

  void raise(Depth& best, double distance, const Vec3d& at) const {
    best.value = distance;
    best.lower = distance - slack_;
    best.point = at;
  }

  void halve(const OpenSimplex& piece) {
    std::size_t longest = 0;
    double largest = -1;
    for (std::size_t i = 0; i < N; ++i) {
      const double d = length(piece.corners[(i + 1) % N] - piece.corners[i]);
      if (d > largest) {
        largest = d;
        longest = i;
      }
    }
    const std::size_t j = (longest + 1) % N;
    const Vec3d middle = (piece.corners[longest] + piece.corners[j]) * 0.5;
    Shape left = piece.corners, right = piece.corners;
    left[j] = middle;
    right[longest] = middle;
    for (const Shape& half : {left, right}) {
      std::uint32_t nearest = piece.nearest;
      if (const auto open = evaluate(half, nearest, piece.upper, depth_, work_)) push(*open);
    }
  }

  /// Raises `best` if the simplex's middle is deeper. Returns the simplex if some of it may be
  /// deeper still. `nearest`: a hint for the nearest face, then the nearest one.
  std::optional<OpenSimplex> evaluate(const Shape& c, std::uint32_t& nearest, double ceiling,
                                      Depth& best, QueryContext& work) const {
    if (goal_.within && !box_of(c).meets(*goal_.within)) return std::nullopt;
    ++best.cells;
    // A point of the field grid, within slack_ of the sheet: its side is exact, and it represents
    // the point of the sheet next to it.
    Vec3d sum;
    for (const Vec3d& v : c) sum = sum + v;
    const Vec3d at = on_field_grid(sum * (1.0 / static_cast<double>(N)));
    double radius = 0;
    for (const Vec3d& v : c) radius = std::max(radius, length(v - at));
    radius += slack_;
    const NearestTriangle near = solid_.nearest(at, nearest);
    nearest = near.triangle;
    // This bound holds on either side: locating the point takes longest.
    double upper = std::min({ceiling, near.distance + radius, by_face(c, near.triangle) + slack_});
    if (upper <= negligible_depth(best)) return std::nullopt;
    const bool inside = solid_.contains(at, work);
    const bool one_side = near.distance > radius;  // no surface within that radius
    if (one_side && !inside) return std::nullopt;
    if (one_side && goal_.belongs && !goal_.belongs(at)) return std::nullopt;
    if (inside && near.distance - slack_ > best.value && goal_.counts(at))
      raise(best, near.distance, at);
    if (!inside) upper = std::min(upper, radius - near.distance);
    if (upper <= negligible_depth(best)) return std::nullopt;
    return OpenSimplex{c, upper, near.triangle};
  }

  /// Returns the greatest distance of a corner from a face of the solid: no point is farther from
  /// its surface.
  [[nodiscard]] double by_face(const Shape& c, std::uint32_t triangle) const {
    const Corners face = corners_of(solid_.part(), triangle);
    double largest = 0;
    for (const Vec3d& v : c) {
      const Vec3d p = solid_.local(v);
      largest = std::max(largest, length(p - nearest_on_triangle(p, face)));
    }
    return largest;
  }

  std::span<const Shape> pieces_;
  const DistanceField& solid_;
  const DepthOptions& goal_;
  Depth& depth_;
  double margin_;
  double slack_;  ///< how far a point of the field grid may be off the sheet
  QueryContext& work_;
  std::uint64_t whole_;
  std::vector<OpenSimplex> open_;  ///< a heap, the most promising first
  std::uint32_t next_id_ = 0;
};

}  // namespace strake::geometry
