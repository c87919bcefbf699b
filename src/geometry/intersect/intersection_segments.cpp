// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/intersection_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/intersect/intersection_lines.hpp"
#include "geometry/intersect/radial_sort.hpp"
#include "geometry/numeric/parity_union_find.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/sweep_and_prune.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Pairs of coplanar, overlapping triangles, united to areas over the lines where one continues
/// into the next. In each pair b's triangle defines the outer side; two united pairs may define it
/// differently.
class CommonAreas {
 public:
  using Key = std::uint64_t;
  static Key key(const CoincidentTriangles& f) { return (Key{f.a} << 32U) | f.b; }

  void join(const CoincidentTriangles& x, const CoincidentTriangles& y) {
    joins_.push_back({key(x), key(y), x.step == y.step});
  }

  void leave(const CoincidentTriangles& f, const IntersectionSegment& piece) {
    if (f.outer || f.inner) leaves_.push_back({key(f), f.outer, f.inner, piece});
  }

  /// Adds the segments where one sheet leaves the other, for areas that it leaves on both sides.
  void cross(std::vector<IntersectionSegment>& pieces) {
    if (leaves_.empty()) return;
    number();
    ParityUnionFind sets(keys_.size());
    for (const Join& j : joins_) sets.join(index(j.x), index(j.y), j.swapped);
    std::vector<std::array<bool, 2>> sides(keys_.size(), {false, false});
    for (const Leave& l : leaves_) {
      const ParityUnionFind::Root r = sets.find(index(l.key));
      sides[r.root][r.swapped ? 1 : 0] |= l.outer;
      sides[r.root][r.swapped ? 0 : 1] |= l.inner;
    }
    for (const Leave& l : leaves_) {
      const auto& side = sides[sets.find(index(l.key)).root];
      if (side[0] && side[1]) pieces.push_back(l.piece);
    }
  }

 private:
  struct Join {
    Key x = 0, y = 0;
    bool swapped = false;
  };
  struct Leave {
    Key key = 0;
    bool outer = false, inner = false;
    IntersectionSegment piece;
  };
  void number() {
    for (const Join& j : joins_) keys_.insert(keys_.end(), {j.x, j.y});
    for (const Leave& l : leaves_) keys_.push_back(l.key);
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }
  [[nodiscard]] std::uint32_t index(Key key) const {
    return static_cast<std::uint32_t>(std::lower_bound(keys_.begin(), keys_.end(), key) -
                                      keys_.begin());
  }

  std::vector<Join> joins_;
  std::vector<Leave> leaves_;
  std::vector<Key> keys_;
};

class SegmentFinder {
 public:
  SegmentFinder(const PairLocalPart& a, const PairLocalPart& b, std::size_t limit = kAll,
                std::function<bool(const IntersectionSegment&)> is_last = {})
      : a_(a), b_(b), limit_(limit), is_last_(std::move(is_last)) {}

  /// Processes a pair of triangles; each pair that has more than a point in common must be passed
  /// once. Returns whether to go on.
  bool process_pair(std::uint32_t ta, const ExactTriangle& s, std::uint32_t tb,
                    const ExactTriangle& t) {
    ++triangle_pairs_;
    classify(ta, tb, contact(s, t));
    return !found_.truncated;
  }

  IntersectionSegments result(QueryContext& work) {
    work.triangle_pairs += triangle_pairs_;
    areas_.cross(found_.all);
    return std::move(found_);
  }

 private:
  void classify(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
    if (c.touch == Touch::none || c.touch == Touch::point) return;
    if (!c.coplanar) {
      if (c.edge_a < 0 && c.edge_b < 0)
        add({.a = ta, .b = tb});
      else if (c.edge_b < 0)
        edge_in_face(a_, ta, c.edge_a, b_, tb, false);
      else if (c.edge_a < 0)
        edge_in_face(b_, tb, c.edge_b, a_, ta, true);
      else
        edge_on_edge(ta, c.edge_a, tb, c.edge_b);
      return;
    }
    for (int i = 0; i < 3; ++i) {
      if ((c.edges_of_a_inside_b >> i) & 1U) edge_in_face(a_, ta, i, b_, tb, false);
      if ((c.edges_of_b_inside_a >> i) & 1U) edge_in_face(b_, tb, i, a_, ta, true);
      for (int j = 0; j < 3; ++j)
        if ((c.shared_edges >> (3 * i + j)) & 1U) edge_on_edge(ta, i, tb, j);
    }
  }

  /// Whether a triangle represents an edge: each triangle at an edge meets what the edge meets, so
  /// one is enough.
  static bool represents_edge(const PairLocalPart& view, std::uint32_t triangle, int edge) {
    return edge_star(view.part(), triangle, edge).front() == triangle;
  }

  void edge_in_face(const PairLocalPart& x, std::uint32_t tx, int edge, const PairLocalPart& y,
                    std::uint32_t ty, bool edge_of_b) {
    if (!represents_edge(x, tx, edge)) return;
    set_axis(sectors_, x, tx, edge);
    add_edge_star(sectors_, x, tx, edge, edge_of_b);
    add_face(sectors_, y, ty, !edge_of_b);
    classify_edge(edge_of_b ? IntersectionSegment{.a = ty, .b = tx, .edge_b = edge}
                            : IntersectionSegment{.a = tx, .b = ty, .edge_a = edge});
  }

  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
    if (!represents_edge(a_, ta, edge_a) || !represents_edge(b_, tb, edge_b)) return;
    set_axis(sectors_, a_, ta, edge_a);
    add_edge_star(sectors_, a_, ta, edge_a, false);
    add_edge_star(sectors_, b_, tb, edge_b, true);
    classify_edge({.a = ta, .b = tb, .edge_a = edge_a, .edge_b = edge_b});
  }

  void classify_edge(const IntersectionSegment& piece) {
    Overlap overlap;
    sectors_.classify(false, false, overlap);
    if (overlap.interiors) {
      add(piece);
      return;
    }
    // With two directions the common area continues; with more it forks.
    const bool goes_on = sectors_.find_coincident(flush_) == 2;
    for (std::size_t i = 0; i < flush_.size(); ++i) {
      areas_.leave(flush_[i], piece);
      for (std::size_t j = 0; goes_on && j < i; ++j)
        if (flush_[i].direction != flush_[j].direction) areas_.join(flush_[i], flush_[j]);
    }
  }

  void add(const IntersectionSegment& piece) {
    found_.truncated = found_.truncated || found_.all.size() == limit_;
    if (found_.truncated) return;
    found_.all.push_back(piece);
    found_.truncated = is_last_ && is_last_(piece);
  }

  const PairLocalPart &a_, &b_;
  std::size_t limit_;
  std::function<bool(const IntersectionSegment&)> is_last_;
  std::uint64_t triangle_pairs_ = 0;
  IntersectionSegments found_;
  CommonAreas areas_;
  RadialSort sectors_;
  std::vector<CoincidentTriangles> flush_;
};

/// The triangles of a leaf, prepared as they are needed; kept until another leaf is loaded.
class LoadedLeaf {
 public:
  explicit LoadedLeaf(const PairLocalPart& view) : view_(view) {}

  void load(const TriangleBvh::Node& leaf) {
    if (node_ == &leaf) return;
    node_ = &leaf;
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      box_[i] = box_of(view_.corners(id(i)));
      triangle_[i].reset();
    }
  }
  [[nodiscard]] std::uint32_t count() const { return node_->count; }
  [[nodiscard]] std::uint32_t id(std::uint32_t i) const {
    return view_.tree().order()[node_->first + i];
  }
  [[nodiscard]] const Box3l& box(std::uint32_t i) const { return box_[i]; }
  [[nodiscard]] const ExactTriangle& triangle(std::uint32_t i) {
    if (!triangle_[i]) triangle_[i] = view_.triangle(id(i));
    return *triangle_[i];
  }

 private:
  const PairLocalPart& view_;
  const TriangleBvh::Node* node_ = nullptr;
  std::array<Box3l, TriangleBvh::kLeafSize> box_;
  std::array<std::optional<ExactTriangle>, TriangleBvh::kLeafSize> triangle_;
};

/// Passes a finder the pairs that the trees of two parts do not separate, until it has enough.
void traverse_trees(const PairLocalPart& a, const PairLocalPart& b, SegmentFinder& finder,
                    QueryContext& work) {
  if (!a.has_bvh() || !b.has_bvh()) return;
  LoadedLeaf leaf_a(a), leaf_b(b);
  traverse_both(
      a.tree(), b.tree(),
      [&](const TriangleBvh::Node& x, const TriangleBvh::Node& y) {
        ++work.node_pairs;
        return a.box(x.box).meets(b.box(y.box));
      },
      [&](const TriangleBvh::Node& x, const TriangleBvh::Node& y) {
        leaf_a.load(x);
        leaf_b.load(y);
        for (std::uint32_t i = 0; i < x.count; ++i)
          for (std::uint32_t j = 0; j < y.count; ++j)
            if (leaf_a.box(i).meets(leaf_b.box(j)) &&
                !finder.process_pair(leaf_a.id(i), leaf_a.triangle(i), leaf_b.id(j),
                                     leaf_b.triangle(j)))
              return false;
        return true;
      });
}

/// Whether axes are the coordinate axes in some order, but for rounding.
bool along_coordinates(const Axes& axes) {
  return std::ranges::all_of(axes, [](const Vec3d& axis) {
    return std::max({std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)}) > 1 - 1e-12;
  });
}

/// Returns a sweep along the coordinate axes, or along the faces of the part of more triangles, or
/// of the other, where that makes far fewer pairs.
SweepAndPrune sweep_of(const PairLocalPart& a, const OrientedBox& frame_a, const PairLocalPart& b,
                       const OrientedBox& frame_b) {
  const std::size_t limit = a.part().triangles.size() + b.part().triangles.size();
  SweepAndPrune sweep(a, b, nullptr);
  std::size_t pairs = 0;
  if (sweep.run([&](std::uint32_t, std::uint32_t) { return ++pairs <= limit; })) return sweep;
  const bool a_first = a.part().triangles.size() >= b.part().triangles.size();
  for (const OrientedBox* frame : {a_first ? &frame_a : &frame_b, a_first ? &frame_b : &frame_a}) {
    const Axes axes = orthonormal_axes(*frame);
    if (!along_coordinates(axes)) return {a, b, &axes};
  }
  return sweep;
}

}  // namespace

IntersectionSegments find_intersection_segments(
    const PartWithBvh& a, const PartWithBvh& b, std::size_t limit, QueryContext& work,
    const std::function<bool(const IntersectionSegment&)>& is_last) {
  const PairLocalPart x(a, {}), y(b, b.placed.origin - a.placed.origin);
  SegmentFinder finder(x, y, limit, is_last);
  traverse_trees(x, y, finder, work);
  return finder.result(work);
}

IntersectionSegments find_intersection_segments(const PartWithObb& a, const PartWithObb& b,
                                                std::size_t limit, QueryContext& work) {
  const PairLocalPart x({a.placed, a.tree}, {});
  const PairLocalPart y({b.placed, b.tree}, b.placed.origin - a.placed.origin);
  SegmentFinder finder(x, y, limit);
  if (needs_bvhs(x.part(), y.part())) {
    traverse_trees(x, y, finder, work);
  } else {
    sweep_of(x, *a.frame, y, *b.frame).run([&](std::uint32_t ta, std::uint32_t tb) {
      return finder.process_pair(ta, x.triangle(ta), tb, y.triangle(tb));
    });
  }
  return finder.result(work);
}

std::vector<IntersectionSegment> find_intersection_segments_brute_force(const PlacedPart& a,
                                                                        const PlacedPart& b,
                                                                        QueryContext& work) {
  const PairLocalPart x({a, nullptr}, {}), y({b, nullptr}, b.origin - a.origin);
  SegmentFinder finder(x, y);
  for (std::uint32_t ta = 0; ta < a.part->triangles.size(); ++ta)
    for (std::uint32_t tb = 0; tb < b.part->triangles.size(); ++tb)
      finder.process_pair(ta, x.triangle(ta), tb, y.triangle(tb));
  return finder.result(work).all;
}

namespace {

/// Returns where segment p-q pierces a triangle or ends on it.
std::optional<Vec3d> pierce(const Vec3d& p, const Vec3d& q, const Corners& t) {
  const Vec3d n = normal_of(t);
  const double sp = dot(n, p - t[0]), sq = dot(n, q - t[0]);
  if ((sp > 0) == (sq > 0) || sp == sq) return std::nullopt;
  const Vec3d x = p + (q - p) * (sp / (sp - sq));
  const double slack = -1e-9 * dot(n, n);
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(t[(i + 1) % 3] - t[i], x - t[i]), n) < slack) return std::nullopt;
  return x;
}

/// Returns the common segment of two triangles that cross.
std::optional<DoubleSegment> common_segment(const Corners& x, const Corners& y) {
  std::array<Vec3d, 6> points;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto p = pierce(x[i], x[(i + 1) % 3], y)) points[count++] = *p;
    if (const auto p = pierce(y[i], y[(i + 1) % 3], x)) points[count++] = *p;
  }
  if (count == 0) return std::nullopt;
  DoubleSegment best{points[0], points[0]};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (length(points[j] - points[i]) > length(best[1] - best[0])) best = {points[i], points[j]};
  return best;
}

/// Returns the part of a segment from `low` to `high` of its length.
std::optional<DoubleSegment> part_of(const DoubleSegment& s, double low, double high) {
  if (!(low < high)) return std::nullopt;
  const Vec3d along = s[1] - s[0];
  return DoubleSegment{s[0] + along * low, s[0] + along * high};
}

/// Returns the part of a segment in a triangle's plane that lies in the triangle.
std::optional<DoubleSegment> clipped(const DoubleSegment& s, const Corners& t) {
  const Vec3d n = normal_of(t);
  double low = 0, high = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d inward = cross(n, t[(i + 1) % 3] - t[i]);
    const double from = dot(inward, s[0] - t[i]), to = dot(inward, s[1] - t[i]);
    if (from < 0 && to <= 0) return std::nullopt;
    if (from < 0) low = std::max(low, from / (from - to));
    if (to < 0) high = std::min(high, from / (from - to));
  }
  return part_of(s, low, high);
}

/// Returns the common part of two collinear segments.
std::optional<DoubleSegment> common_interval(const DoubleSegment& s, const DoubleSegment& t) {
  const Vec3d along = s[1] - s[0];
  const double scale = 1 / dot(along, along);
  const double from = dot(along, t[0] - s[0]) * scale, to = dot(along, t[1] - s[0]) * scale;
  return part_of(s, std::max(0.0, std::min(from, to)), std::min(1.0, std::max(from, to)));
}

Corners corners(const PairLocalPart& view, std::uint32_t triangle) {
  return as_doubles(view.corners(triangle));
}

DoubleSegment edge_of(const PairLocalPart& view, std::uint32_t triangle, int edge) {
  const Corners t = corners(view, triangle);
  return {t[at(edge)], t[at(next_corner(edge))]};
}

}  // namespace

std::optional<DoubleSegment> segment_geometry(const PairLocalPart& a, const PairLocalPart& b,
                                              const IntersectionSegment& p) {
  if (p.edge_a < 0 && p.edge_b < 0) return common_segment(corners(a, p.a), corners(b, p.b));
  if (p.edge_b < 0) return clipped(edge_of(a, p.a, p.edge_a), corners(b, p.b));
  if (p.edge_a < 0) return clipped(edge_of(b, p.b, p.edge_b), corners(a, p.a));
  return common_interval(edge_of(a, p.a, p.edge_a), edge_of(b, p.b, p.edge_b));
}

}  // namespace strake::geometry
