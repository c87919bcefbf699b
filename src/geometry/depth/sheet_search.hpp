// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/depth/depth_field.hpp"
#include "geometry/depth/depth_search.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {

/// Work limit: pieces are cheaper than the cells of two solids.
inline constexpr std::uint32_t kPiecesPerCell = 2;

/// The deepest point in a solid of what has no thickness: triangles (N = 3) or segments (N = 2) in
/// the coordinates of the field. Branch and bound, halved at the longest edges.
template <std::size_t N>
class SheetSearch {
 public:
  using Shape = std::array<Vec3d, N>;

  /// Raises `depth` where the pieces are deeper; its upper bound is a ceiling.
  SheetSearch(std::span<const Shape> pieces, const DepthField& solid, const DepthGoal& goal,
              Depth& depth, double margin, PairWork& work)
      : pieces_(pieces), solid_(solid), goal_(goal), depth_(depth), margin_(margin), work_(work) {}

  void run() {
    const double ceiling = depth_.upper;
    const Box3d room = solid_.box();
    for (const Shape& c : pieces_)
      if (box_of(c).meets(room)) evaluate(c, kNoFace, ceiling);
    while (!open_.empty()) {
      depth_.upper = std::min(ceiling, std::max(open_.top().upper, depth_.value));
      if (bracket_suffices(depth_, goal_) || exhausted()) return;
      const Piece piece = open_.top();
      open_.pop();
      halve(piece);
    }
    depth_.upper = std::min(ceiling, depth_.value + margin_);
  }

 private:
  struct Piece {
    Shape corners;
    double upper = 0;
    std::uint32_t nearest = kNoFace;
    std::uint32_t id = 0;
  };
  struct LessPromising {
    bool operator()(const Piece& x, const Piece& y) const {
      return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
    }
  };

  [[nodiscard]] bool exhausted() const {
    const bool decided = depth_.lower > goal_.threshold || depth_.upper <= goal_.threshold;
    const std::uint32_t cells = decided ? goal_.cells_decided : goal_.cells_undecided;
    return depth_.cells >= std::uint64_t{kPiecesPerCell} * cells + pieces_.size();
  }

  void halve(const Piece& piece) {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t i = 0; i < N; ++i) {
      const double d = length(piece.corners[(i + 1) % N] - piece.corners[i]);
      if (d > most) {
        most = d;
        longest = i;
      }
    }
    const std::size_t j = (longest + 1) % N;
    const Vec3d middle = (piece.corners[longest] + piece.corners[j]) * 0.5;
    Shape left = piece.corners, right = piece.corners;
    left[j] = middle;
    right[longest] = middle;
    evaluate(left, piece.nearest, piece.upper);
    evaluate(right, piece.nearest, piece.upper);
  }

  void evaluate(const Shape& c, std::uint32_t hint, double ceiling) {
    if (goal_.within && !box_of(c).meets(*goal_.within)) return;
    ++depth_.cells;
    // A point of the field grid, within slack of the sheet: its side is exact, and it speaks for
    // the point of the sheet next to it.
    const double slack = 1.0 / 1024 + margin_;
    Vec3d sum;
    for (const Vec3d& v : c) sum = sum + v;
    const Vec3d at = on_field_grid(sum * (1.0 / static_cast<double>(N)));
    double radius = 0;
    for (const Vec3d& v : c) radius = std::max(radius, length(v - at));
    radius += slack;
    const NearestTriangle near = solid_.nearest(at, hint);
    const bool inside = solid_.contains(at, work_);
    if (!inside && near.distance > radius) return;
    if (inside && near.distance - slack > depth_.value && goal_.counts(at)) {
      depth_.value = near.distance;
      depth_.lower = near.distance - slack;
      depth_.point = at;
    }
    const Corners face = corners_of(solid_.part(), near.triangle);
    double upper = 0;
    for (const Vec3d& v : c) {
      const Vec3d p = solid_.local(v);
      upper = std::max(upper, length(p - nearest_on_triangle(p, face)));
    }
    upper = std::min(
        {ceiling, upper + slack, inside ? near.distance + radius : radius - near.distance});
    if (upper > depth_.value + margin_) open_.push({c, upper, near.triangle, next_id_++});
  }

  std::span<const Shape> pieces_;
  const DepthField& solid_;
  const DepthGoal& goal_;
  Depth& depth_;
  double margin_;
  PairWork& work_;
  std::priority_queue<Piece, std::vector<Piece>, LessPromising> open_;
  std::uint32_t next_id_ = 0;
};

}  // namespace strake::geometry
