// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/single_region.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/contact_regions/edge_hits.hpp"
#include "geometry/contact_regions/near_triangles.hpp"
#include "geometry/contact_regions/overlap_extent.hpp"
#include "geometry/contact_regions/slab_candidates.hpp"
#include "geometry/distance/triangle_distance.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {
namespace {

/// Maximum number of pairs of triangles per triangle of the two: each takes some nanoseconds.
/// Between 128 and 2048 ships show no difference (decision 0073).
constexpr std::size_t kPairsPerTriangle = 512;

using Word = std::uint64_t;
constexpr std::size_t kWordBits = 64;
constexpr std::uint32_t kNoComponent = 0xffffffffU;

bool test(std::span<const Word> bits, std::uint32_t i) {
  return (bits[i / kWordBits] >> (i % kWordBits) & 1U) != 0;
}
/// The number of the first bit that is set in a word of a row.
std::uint32_t first_bit(std::size_t word, Word bits) {
  return static_cast<std::uint32_t>(word * kWordBits +
                                    static_cast<std::size_t>(std::countr_zero(bits)));
}
bool test_any(std::span<const Word> bits, const Triangle& t) {
  return test(bits, t[0]) || test(bits, t[1]) || test(bits, t[2]);
}

/// Rows of bits.
class BitRows {
 public:
  BitRows(std::size_t rows, std::size_t bits)
      : words_((bits + kWordBits - 1) / kWordBits), all_(rows * words_) {}

  [[nodiscard]] std::span<const Word> row(std::uint32_t i) const {
    return std::span(all_).subspan(words_ * i, words_);
  }
  [[nodiscard]] std::span<Word> row(std::uint32_t i) {
    return std::span(all_).subspan(words_ * i, words_);
  }

 private:
  std::size_t words_;
  std::vector<Word> all_;
};

/// The vertices of a part by coordinate.
class NearVertices {
 public:
  explicit NearVertices(const PairLocalPart& view) {
    for (std::uint32_t v = 0; v < view.part().vertices.size(); ++v) {
      const Vec3d p = view.vertex(v).as<double>();
      x_.push_back(p.x);
      y_.push_back(p.y);
      z_.push_back(p.z);
    }
  }

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] Vec3d at(std::uint32_t v) const { return {x_[v], y_[v], z_[v]}; }

  /// Sets the bits of those within reach of a point.
  void near(const Vec3d& p, double squared, std::span<Word> row) const {
    for (std::size_t u = 0; u < x_.size(); ++u) {
      const double dx = x_[u] - p.x, dy = y_[u] - p.y, dz = z_[u] - p.z;
      const bool near = dx * dx + dy * dy + dz * dz <= squared;
      row[u / kWordBits] |= Word{near ? 1U : 0U} << (u % kWordBits);
    }
  }

 private:
  std::vector<double> x_, y_, z_;
};

/// Of the second part and of the first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

double squared_distance(const Vec3d& p, const Vec3d& q) { return dot(p - q, p - q); }

/// The vertices of the first part within reach of each triangle of the second, and their connected
/// pieces: the points of an edge within reach of a triangle form an interval.
class NearCorners {
 public:
  NearCorners(const PairLocalPart& a, const PairLocalPart& b, const SlabCandidates& facing,
              std::span<const DoubleTriangle> triangles, double squared)
      : a_(a),
        b_(b),
        facing_(facing),
        squared_(squared),
        boxes_(a, b, facing, std::sqrt(squared)),
        first_edge_(first_edges(a, facing)),
        vertices_(a),
        near_vertex_(b.part().vertices.size(), vertices_.size()),
        rows_(triangles.size(), vertices_.size()),
        pieces_(triangles.size()) {
    std::vector<bool> searched(b.part().vertices.size(), false);
    for (const std::uint32_t t : facing.triangles_b)
      for (const std::uint32_t v : b.part().triangles[t]) {
        if (!searched[v]) vertices_.near(b.vertex(v).as<double>(), squared, near_vertex_.row(v));
        searched[v] = true;
      }
    first_.reserve(triangles.size() + 1);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < facing.triangles_b.size(); ++i) {
      const std::uint32_t t = facing.triangles_b[i];
      first_.resize(t + 1, count);
      const std::size_t near = fill(i, triangles[t]);
      if (near < vertices_.size()) list_between(i);
      count += find_pieces(t, near);
    }
    first_.resize(triangles.size() + 1, count);
  }

  /// By triangle of the second part.
  [[nodiscard]] std::span<const Word> row(std::uint32_t t) const { return rows_.row(t); }
  /// Of all rows.
  [[nodiscard]] std::uint32_t pieces() const { return first_.back(); }
  /// The pairs of triangles that may be near, but not at a corner of the first; ascending.
  [[nodiscard]] const std::vector<TrianglePair>& between() const { return between_; }
  /// The number of the piece that a corner near a triangle is in.
  [[nodiscard]] std::uint32_t piece(std::uint32_t u, std::uint32_t t) const {
    return first_[t] + (pieces_[t].empty() ? 0 : pieces_[t][u]);
  }

  /// Joins the pieces of the triangles round an edge of the second part that have a corner within
  /// reach of the edge in common.
  void join_round(std::uint32_t edge, UnionFind& sets) const {
    const PartEdge& e = b_.part().edges[edge];
    const Vec3d from = b_.vertex(e.v0).as<double>(), to = b_.vertex(e.v1).as<double>();
    const auto at_from = near_vertex_.row(e.v0), at_to = near_vertex_.row(e.v1);
    const auto near = [&](std::uint32_t u) {
      if (test(at_from, u) || test(at_to, u)) return true;
      const Vec3d p = vertices_.at(u);
      return squared_distance(p, nearest_on_segment(p, from, to)) <= squared_;
    };
    const auto round = incident_triangles(b_.part(), edge);
    for (std::size_t i = 0; i + 1 < round.size(); ++i) join(round[i], round[i + 1], near, sets);
  }

 private:
  [[nodiscard]] bool in_one_piece(std::uint32_t t) const { return first_[t + 1] == first_[t] + 1; }

  /// The row of a triangle by its place in facing.triangles_b; returns how many corners are near.
  std::size_t fill(std::size_t place, const DoubleTriangle& triangle) {
    const std::uint32_t t = facing_.triangles_b[place];
    const std::span<Word> row = rows_.row(t);
    for (const std::uint32_t v : b_.part().triangles[t]) {
      const std::span<const Word> near = std::as_const(near_vertex_).row(v);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] |= near[i];
    }
    boxes_.vertices_near(place, [&](std::uint32_t u) {
      if (test(row, u)) return;
      const Vec3d p = vertices_.at(u);
      if (squared_distance(p, nearest_on_triangle(p, triangle.corner)) <= squared_)
        row[u / kWordBits] |= Word{1} << (u % kWordBits);
    });
    std::size_t count = 0;
    for (const Word word : row) count += static_cast<std::size_t>(std::popcount(word));
    return count;
  }

  void list_between(std::size_t place) {
    const std::uint32_t t = facing_.triangles_b[place];
    const auto& triangles = a_.part().triangles;
    const auto row = std::as_const(rows_).row(t);
    const auto listed = static_cast<std::ptrdiff_t>(between_.size());
    boxes_.triangles_near(place, [&](std::uint32_t s) {
      if (!test_any(row, triangles[s])) between_.emplace_back(t, s);
    });
    std::sort(between_.begin() + listed, between_.end());
  }

  /// The edges that face the second part, to a higher vertex of the first.
  [[nodiscard]] std::span<const std::uint32_t> edges_from(std::uint32_t u) const {
    return std::span(facing_.edges_a).subspan(first_edge_[u], first_edge_[u + 1] - first_edge_[u]);
  }

  /// By vertex: the place of the first of its edges_from(); one more at the end.
  static std::vector<std::uint32_t> first_edges(const PairLocalPart& view,
                                                const SlabCandidates& facing) {
    std::vector<std::uint32_t> first(view.part().vertices.size() + 1, 0);
    for (const std::uint32_t e : facing.edges_a) ++first[view.part().edges[e].v0 + 1];
    std::inclusive_scan(first.begin(), first.end(), first.begin());
    return first;
  }

  template <class Near>
  void join(std::uint32_t t, std::uint32_t next, const Near& near, UnionFind& sets) const {
    const auto x = row(t), y = row(next);
    const bool once = in_one_piece(t) && in_one_piece(next);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (Word both = x[i] & y[i]; both != 0; both &= both - 1) {
        const std::uint32_t u = first_bit(i, both);
        if (sets.joined(piece(u, t), piece(u, next)) || !near(u)) continue;
        sets.join(piece(u, t), piece(u, next));
        if (once) return;
      }
  }

  /// Of a row with so many corners; returns how many pieces there are.
  std::uint32_t find_pieces(std::uint32_t t, std::size_t set) {
    const auto bits = row(t);
    const auto& edges = a_.part().edges;
    const std::size_t all = vertices_.size();
    if (set <= 1) return static_cast<std::uint32_t>(set);
    if (set == all && whole_is_one_) return 1;
    sets_.reset(all);
    const std::size_t in_one = all - set + 1;
    for (std::size_t i = 0; i < bits.size() && sets_.count() > in_one; ++i)
      for (Word left = bits[i]; left != 0; left &= left - 1) {
        const std::uint32_t u = first_bit(i, left);
        for (const std::uint32_t e : edges_from(u))
          if (test(bits, edges[e].v1)) sets_.join(u, edges[e].v1);
      }
    const auto count = static_cast<std::uint32_t>(sets_.count() - (all - set));
    if (set == all && count == 1) whole_is_one_ = true;
    if (count > 1) number(t);
    return count;
  }

  void number(std::uint32_t t) {
    std::vector<std::uint32_t>& of = pieces_[t];
    of.resize(vertices_.size(), kNoComponent);
    std::uint32_t next = 0;
    for (std::uint32_t u = 0; u < of.size(); ++u) {
      if (!test(row(t), u)) continue;
      const std::uint32_t root = sets_.root(u);  // the lowest: met before the others
      of[u] = root == u ? next++ : of[root];
    }
  }

  const PairLocalPart &a_, &b_;
  const SlabCandidates& facing_;
  double squared_;
  ProximityBoxes boxes_;
  std::vector<std::uint32_t> first_edge_;  ///< see first_edges()
  NearVertices vertices_;
  BitRows near_vertex_;  ///< by vertex of the second part: of the first part
  BitRows rows_;         ///< by triangle of the second part: likewise
  std::vector<std::vector<std::uint32_t>> pieces_;  ///< by row with several, by corner
  std::vector<std::uint32_t> first_;                ///< piece, by row; one more at the end
  std::vector<TrianglePair> between_;
  UnionFind sets_;
  bool whole_is_one_ = false;  ///< whether all corners are known to hang together
};

std::vector<DoubleTriangle> prepared(const PairLocalPart& view) {
  std::vector<DoubleTriangle> all;
  all.reserve(view.part().triangles.size());
  for (std::uint32_t t = 0; t < view.part().triangles.size(); ++t)
    all.emplace_back(view.corners(t));
  return all;
}

class SingleRegionFinder {
 public:
  SingleRegionFinder(const PairLocalPart& a, const PairLocalPart& b, double reach,
                     QueryContext& work)
      : a_(a),
        b_(b),
        reach_(reach),
        squared_(reach * reach),
        of_a_(prepared(a)),
        of_b_(prepared(b)),
        facing_(facing(a, b, reach)),
        corners_(a, b, facing_, of_b_, squared_),
        work_(work) {}

  [[nodiscard]] bool certain() {
    find_between();
    sets_.reset(std::size_t{corners_.pieces()} + between_.size());
    for (std::uint32_t e = 0; e + 1 < b_.part().edges.size(); ++e) corners_.join_round(e, sets_);
    // With all corners in one set it is enough to reach these.
    const bool in_one = sets_.count() == between_.size() + 1;
    for (std::uint32_t i = 0; i < between_.size(); ++i) join_between(i, in_one);
    return sets_.count() == 1;
  }

  [[nodiscard]] Box3d extent() const {
    Box3d extent = empty_box<double>();
    const double margin = reach_ + kCutMargin;
    const Box3d all_a = a_.box(a_.part().box).as<double>().inflated(margin);
    const auto include = [&](std::uint32_t s, std::uint32_t t, const Box3d& room) {
      if (!extent.contains(of_a_[s].box.inflated(margin).common(room)))
        include_overlap(a_.corners(s), b_.corners(t), reach_, extent);
    };
    const auto& triangles = a_.part().triangles;
    for (const std::uint32_t t : facing_.triangles_b) {
      const Box3d room = of_b_[t].box.inflated(margin);
      if (extent.contains(room.common(all_a))) continue;
      for (const std::uint32_t s : facing_.triangles_a)
        if (test_any(corners_.row(t), triangles[s])) include(s, t, room);
    }
    for (const auto& [t, s] : between_) include(s, t, of_b_[t].box.inflated(margin));
    return extent;
  }

 private:
  void find_between() {
    for (const TrianglePair& pair : corners_.between()) {
      const auto [t, s] = pair;
      if (squared_gap(of_a_[s].box, of_b_[t].box) <= squared_ && near(s, t))
        between_.push_back(pair);
    }
  }

  [[nodiscard]] bool near(std::uint32_t s, std::uint32_t t) {
    ++work_.triangle_pairs;
    return triangles_within(a_, b_, of_a_[s], of_b_[t], {s, t}, squared_, work_);
  }

  /// The number of the set that a pair of triangles is in; kNoComponent where they are not near.
  [[nodiscard]] std::uint32_t member(std::uint32_t s, std::uint32_t t) const {
    for (const std::uint32_t u : a_.part().triangles[s])
      if (test(corners_.row(t), u)) return corners_.piece(u, t);
    const auto it = std::ranges::lower_bound(between_, std::pair(t, s));
    if (it == between_.end() || *it != std::pair(t, s)) return kNoComponent;
    return corners_.pieces() + static_cast<std::uint32_t>(it - between_.begin());
  }

  /// Joins a pair over those edges of either triangle that are within reach of the other.
  void join_between(std::uint32_t i, bool one_is_enough) {
    const auto [t, s] = between_[i];
    const std::uint32_t own = corners_.pieces() + i;
    const auto done = [&] { return one_is_enough && sets_.root(own) < corners_.pieces(); };
    const auto join_with = [&](const PairLocalPart& view, std::uint32_t triangle,
                               const Corners& other, const auto& member_beside) {
      const Triangle& c = view.part().triangles[triangle];
      for (std::size_t k = 0; k < 3 && !done(); ++k)
        join_over(view, {c[k], c[(k + 1) % 3]}, other, own, member_beside);
    };
    join_with(b_, t, of_a_[s].corner, [&](std::uint32_t beside) { return member(s, beside); });
    join_with(a_, s, of_b_[t].corner, [&](std::uint32_t beside) { return member(beside, t); });
  }

  /// An edge by its ends; its distance is computed only where it would join anything.
  template <class Member>
  void join_over(const PairLocalPart& view, const std::pair<std::uint32_t, std::uint32_t>& ends,
                 const Corners& other, std::uint32_t own, const Member& member_beside) {
    const Part& part = view.part();
    const std::uint32_t edge = edge_between(part, ends.first, ends.second);
    if (edge == kNoIndex) return;
    bool known_near = false;
    for (const std::uint32_t beside : incident_triangles(part, edge)) {
      const std::uint32_t number = member_beside(beside);
      if (number == kNoComponent || sets_.joined(own, number)) continue;
      known_near =
          known_near || nearest_parameter(view.vertex(ends.first).as<double>(),
                                          view.vertex(ends.second).as<double>(), other, squared_)
                            .has_value();
      if (!known_near) return;
      sets_.join(own, number);
    }
  }

  const PairLocalPart &a_, &b_;
  double reach_, squared_;
  std::vector<DoubleTriangle> of_a_, of_b_;
  SlabCandidates facing_;
  NearCorners corners_;
  QueryContext& work_;
  std::vector<TrianglePair> between_;  ///< near, but not at a corner of the first; ascending
  UnionFind sets_;
};

}  // namespace

bool is_single_region_affordable(const Part& a, const Part& b) {
  const std::size_t x = a.triangles.size(), y = b.triangles.size();
  return x * y <= kPairsPerTriangle * (x + y);
}

std::optional<Box3d> find_single_region(const PairLocalPart& a, const PairLocalPart& b,
                                        const SingleRegionOptions& options, QueryContext& work) {
  if (!is_single_region_affordable(a.part(), b.part())) return std::nullopt;
  SingleRegionFinder place(a, b, options.reach, work);
  if (!place.certain()) return std::nullopt;
  return options.boxed ? place.extent() : empty_box<double>();
}

}  // namespace strake::geometry
