// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangulation/delaunay.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace strake::geometry::triangulation {
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

  [[nodiscard]] std::vector<TriangulationFace> cells() const {
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
    std::vector<TriangulationFace> cells(triangles.size());
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

std::vector<TriangulationFace> delaunay(std::span<const Point2> points) {
  return Halves(points).cells();
}

namespace {

class Sweep {
 public:
  explicit Sweep(std::vector<Point2> points)
      : cells_(std::move(points)),
        next_(cells_.points().size(), kNone),
        previous_(cells_.points().size(), kNone),
        cell_(cells_.points().size(), kNone) {}

  TriangulationMesh run() {
    const std::size_t count = cells_.points().size();
    const std::uint32_t used = count < 3 ? 0 : start_fan();
    if (used == 0) return std::move(cells_);
    cells_.reserve(count * 2);
    for (std::uint32_t p = used; p < count; ++p) insert(p);
    return std::move(cells_);
  }

 private:
  std::uint32_t start_fan();
  void insert(std::uint32_t point);
  void note_hull(std::uint32_t cell);

  TriangulationMesh cells_;
  // The hull, by vertex.
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> cell_;  ///< the triangle at the hull edge that starts there
};

/// Of a triangle's edges.
void Sweep::note_hull(std::uint32_t cell) {
  const TriangulationFace& c = cells_[cell];
  for (std::uint32_t k = 0; k < 3; ++k)
    if (c.neighbour[k] == kNone) cell_[c.vertex[after(k)]] = cell;
}

/// Joins the first points, as long as they are collinear, with the first that is not; returns the
/// number of points used, or 0 when all are collinear.
std::uint32_t Sweep::start_fan() {
  const auto count = static_cast<std::uint32_t>(cells_.points().size());
  std::uint32_t apex = 2;
  while (apex < count && cells_.side(0, 1, apex) == 0) ++apex;
  if (apex >= count) return 0;
  const bool left = cells_.side(0, 1, apex) > 0;
  std::vector<std::uint32_t> hull;
  for (std::uint32_t i = 0; i < apex; ++i) hull.push_back(left ? i : apex - 1 - i);
  std::uint32_t previous = kNone;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const std::uint32_t cell = cells_.add(hull[i], hull[i + 1], apex);
    if (previous != kNone) cells_.join(previous, cell, hull[i], apex);
    previous = cell;
  }
  hull.push_back(apex);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::uint32_t a = hull[i], b = hull[i + 1 == hull.size() ? 0 : i + 1];
    next_[a] = b;
    previous_[b] = a;
  }
  for (std::uint32_t cell = 0; cell < cells_.all().size(); ++cell) note_hull(cell);
  return apex + 1;
}

/// Adds a point beyond all others: it sees the hull edges round the last one.
void Sweep::insert(std::uint32_t point) {
  const std::uint32_t last = point - 1;
  std::uint32_t ahead = last, behind = last, first_ahead = kNone, first_behind = kNone;
  std::uint32_t newest = kNone;
  while (cells_.side(ahead, next_[ahead], point) < 0) {
    const std::uint32_t next = next_[ahead];
    const std::uint32_t cell = cells_.add(next, ahead, point);
    cells_.join(cell, cell_[ahead], next, ahead);
    if (newest != kNone) cells_.join(newest, cell, point, ahead);
    if (first_ahead == kNone) first_ahead = cell;
    cells_.doubt({cell, 2});
    newest = cell;
    ahead = next;
  }
  std::uint32_t newest_behind = kNone;
  while (cells_.side(previous_[behind], behind, point) < 0) {
    const std::uint32_t next = previous_[behind];
    const std::uint32_t cell = cells_.add(behind, next, point);
    cells_.join(cell, cell_[next], behind, next);
    if (newest_behind != kNone) cells_.join(newest_behind, cell, behind, point);
    if (first_behind == kNone) first_behind = cell;
    cells_.doubt({cell, 2});
    newest_behind = cell;
    behind = next;
  }
  if (first_ahead != kNone && first_behind != kNone)
    cells_.join(first_ahead, first_behind, last, point);
  next_[behind] = point;
  previous_[point] = behind;
  next_[point] = ahead;
  previous_[ahead] = point;
  cell_[behind] = newest_behind != kNone ? newest_behind : first_ahead;
  cell_[point] = newest != kNone ? newest : first_behind;
  cells_.legalise([&](std::uint32_t cell) { note_hull(cell); });
}

}  // namespace

TriangulationMesh sweep_delaunay(std::vector<Point2> points) {
  return Sweep(std::move(points)).run();
}

}  // namespace strake::geometry::triangulation
