// SPDX-License-Identifier: Apache-2.0
#include "geometry/polygon/delaunay.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace strake::geometry::polygon {
namespace {

/// A directed edge; the same edge the other way round is its number with the last bit turned.
using Edge = std::uint32_t;

constexpr Edge reversed(Edge e) { return e ^ 1U; }

/// The edges of a plane graph: round each origin they form a ring, counter-clockwise.
class Rings {
 public:
  explicit Rings(std::size_t points) {
    // A planar graph of n points has fewer than 3n edges; those deleted are used again.
    rings_.reserve(points * 6);
  }

  [[nodiscard]] std::uint32_t from(Edge e) const { return rings_[e].origin; }
  [[nodiscard]] std::uint32_t to(Edge e) const { return rings_[reversed(e)].origin; }
  [[nodiscard]] Edge turn_left(Edge e) const { return rings_[e].next; }
  [[nodiscard]] Edge turn_right(Edge e) const { return rings_[e].previous; }
  /// The next edge of the face to the left of e.
  [[nodiscard]] Edge along(Edge e) const { return rings_[reversed(e)].previous; }
  [[nodiscard]] Edge count() const { return static_cast<Edge>(rings_.size()); }
  [[nodiscard]] bool alive(Edge e) const { return rings_[e].origin != kNone; }

  Edge make(std::uint32_t a, std::uint32_t b) {
    Edge e = static_cast<Edge>(rings_.size());
    if (free_.empty()) {
      rings_.resize(rings_.size() + 2);
    } else {
      e = free_.back();
      free_.pop_back();
    }
    rings_[e] = {a, e, e};
    rings_[reversed(e)] = {b, reversed(e), reversed(e)};
    return e;
  }

  /// Joins two rings, or parts one.
  void splice(Edge a, Edge b) {
    const Edge after_a = rings_[a].next, after_b = rings_[b].next;
    rings_[a].next = after_b;
    rings_[after_b].previous = a;
    rings_[b].next = after_a;
    rings_[after_a].previous = b;
  }

  /// A new edge from the end of a to the origin of b, with the same face to the left of all three.
  Edge connect(Edge a, Edge b) {
    const Edge e = make(to(a), from(b));
    splice(e, along(a));
    splice(reversed(e), b);
    return e;
  }

  void remove(Edge e) {
    splice(e, turn_right(e));
    splice(reversed(e), turn_right(reversed(e)));
    rings_[e].origin = rings_[reversed(e)].origin = kNone;
    free_.push_back(e & ~Edge{1});
  }

 private:
  struct Ring {
    std::uint32_t origin = kNone;
    Edge next = 0, previous = 0;
  };
  std::vector<Ring> rings_;
  std::vector<Edge> free_;
};

class Halves {
 public:
  explicit Halves(std::span<const Point2> points) : points_(points), rings_(points.size()) {
    if (points.size() >= 2) (void)build(0, static_cast<std::uint32_t>(points.size()));
  }

  [[nodiscard]] std::vector<Cell> cells() const {
    std::vector<std::uint32_t> face(rings_.count(), kNone);
    std::vector<std::array<Edge, 3>> triangles;
    for (Edge e = 0; e < rings_.count(); ++e) {
      if (!rings_.alive(e) || face[e] != kNone) continue;
      const Edge second = rings_.along(e), third = rings_.along(second);
      // The outside may have three edges too, but clockwise.
      if (rings_.along(third) != e || !left_of(rings_.from(third), e)) continue;
      for (const Edge k : {e, second, third})
        face[k] = static_cast<std::uint32_t>(triangles.size());
      triangles.push_back({e, second, third});
    }
    std::vector<Cell> cells(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        cells[t].vertex[k] = rings_.from(triangles[t][k]);
        // Edge k runs from corner k to the next, opposite the one before.
        cells[t].neighbour[(k + 2) % 3] = face[reversed(triangles[t][k])];
      }
    return cells;
  }

 private:
  /// The hull of a part: from its leftmost point counter-clockwise, from its rightmost clockwise.
  struct Hull {
    Edge left, right;
  };

  [[nodiscard]] bool turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return side_of(points_[a], points_[b], points_[c]) > 0;
  }
  [[nodiscard]] bool left_of(std::uint32_t p, Edge e) const {
    return turns_left(p, rings_.from(e), rings_.to(e));
  }
  [[nodiscard]] bool right_of(std::uint32_t p, Edge e) const {
    return turns_left(p, rings_.to(e), rings_.from(e));
  }
  [[nodiscard]] bool in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                               std::uint32_t d) const {
    return inside_circle(points_[a], points_[b], points_[c], points_[d]);
  }

  Hull build(std::uint32_t first, std::uint32_t last) {
    if (last - first == 2) {
      const Edge e = rings_.make(first, first + 1);
      return {e, reversed(e)};
    }
    if (last - first == 3) return build_three(first);
    const std::uint32_t middle = first + (last - first) / 2;
    const Hull left = build(first, middle), right = build(middle, last);
    return merge(left, right);
  }

  Hull build_three(std::uint32_t first) {
    const Edge a = rings_.make(first, first + 1), b = rings_.make(first + 1, first + 2);
    rings_.splice(reversed(a), b);
    if (turns_left(first, first + 1, first + 2)) {
      (void)rings_.connect(b, a);
      return {a, reversed(b)};
    }
    if (!turns_left(first, first + 2, first + 1)) return {a, reversed(b)};
    const Edge c = rings_.connect(b, a);
    return {reversed(c), c};
  }

  Hull merge(Hull left, Hull right) {
    Edge l = left.right, r = right.left;
    for (;;) {  // the lower common tangent
      if (left_of(rings_.from(r), l))
        l = rings_.along(l);
      else if (right_of(rings_.from(l), r))
        r = rings_.turn_left(reversed(r));
      else
        break;
    }
    Edge base = rings_.connect(reversed(r), l);
    if (rings_.from(l) == rings_.from(left.left)) left.left = reversed(base);
    if (rings_.from(r) == rings_.from(right.right)) right.right = base;
    while (climb(base)) {
    }
    return {left.left, right.right};
  }

  /// The next edge across, above `base`; false at the upper tangent.
  bool climb(Edge& base) {
    const auto above = [&](Edge e) { return right_of(rings_.to(e), base); };
    const auto spoiled_by = [&](Edge e, Edge next) {
      return in_circle(rings_.to(base), rings_.from(base), rings_.to(e), rings_.to(next));
    };
    Edge l = rings_.turn_left(reversed(base));
    if (above(l))
      while (spoiled_by(l, rings_.turn_left(l)))
        rings_.remove(std::exchange(l, rings_.turn_left(l)));
    Edge r = rings_.turn_right(base);
    if (above(r))
      while (spoiled_by(r, rings_.turn_right(r)))
        rings_.remove(std::exchange(r, rings_.turn_right(r)));
    const bool has_left = above(l), has_right = above(r);
    if (!has_left && !has_right) return false;
    const bool take_right = !has_left || (has_right && in_circle(rings_.to(l), rings_.from(l),
                                                                 rings_.from(r), rings_.to(r)));
    base = take_right ? rings_.connect(r, reversed(base))
                      : rings_.connect(reversed(base), reversed(l));
    return true;
  }

  std::span<const Point2> points_;
  Rings rings_;
};

}  // namespace

std::vector<Cell> delaunay(std::span<const Point2> points) { return Halves(points).cells(); }

}  // namespace strake::geometry::polygon
