// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/near_triangles.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "geometry/bvh/traversal.hpp"
#include "geometry/contact_regions/counting_sort.hpp"
#include "geometry/contact_regions/slab_candidates.hpp"
#include "geometry/distance/distance_traversal.hpp"
#include "geometry/distance/slab_partition.hpp"
#include "geometry/numeric/morton_order.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {
namespace {

/// The triangles of each of two parts that come near the other's box.
struct CandidateTriangles {
  std::vector<std::uint32_t> id;
  std::vector<DoubleTriangle> triangle;

  CandidateTriangles(const PairLocalPart& of, const PairLocalPart& other, double squared) {
    const Box3d box = other.box(other.part().box).as<double>();
    for (std::uint32_t t = 0; t < of.part().triangles.size(); ++t) {
      const TriangleCorners c = of.corners(t);
      if (squared_gap(box_of(as_doubles(c)), box) > squared) continue;
      id.push_back(t);
      triangle.emplace_back(c);
    }
  }

  void keep_below(const Heights& heights, double level) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < id.size(); ++i) {
      if (heights.lowest(id[i]) > level) continue;
      id[kept] = id[i];
      triangle[kept++] = triangle[i];
    }
    id.resize(kept);
    triangle.resize(kept);
  }
};

/// Number of pairs of candidates per triangle of the two parts beyond which they are first filtered
/// by the slab between the parts.
constexpr std::size_t kManyListed = 4;

/// Small parts are scanned triangle by triangle.
template <class Visit>
void walk_lists(const PairLocalPart& a, const PairLocalPart& b, double reach, QueryContext& work,
                Visit&& visit) {
  const double squared = reach * reach;
  CandidateTriangles x(a, b, squared), y(b, a, squared);
  if (x.id.size() * y.id.size() >
      kManyListed * (a.part().triangles.size() + b.part().triangles.size())) {
    const SlabHeights heights = project_on_slab_axis(a, b, reach);
    x.keep_below(heights.a, heights.level_a);
    y.keep_below(heights.b, heights.level_b);
  }
  for (std::size_t i = 0; i < x.id.size(); ++i)
    for (std::size_t j = 0; j < y.id.size(); ++j) {
      if (squared_gap(x.triangle[i].box, y.triangle[j].box) > squared) continue;
      ++work.triangle_pairs;
      const DistanceBounds bounds =
          triangle_distance_bounds(x.triangle[i], y.triangle[j], squared, squared);
      if (bounds.lower <= squared && !visit(NearTrianglePair{bounds, x.id[i], y.id[j]})) return;
    }
}

/// Settles in exact arithmetic what the bounds leave open; false for triangles out of reach.
bool settle(const PairLocalPart& a, const PairLocalPart& b, double squared, NearTrianglePair& pair,
            QueryContext& work) {
  if (pair.squared.lower > squared) return false;
  if (pair.squared.upper <= squared) return true;
  ++work.exact_fallbacks;
  const SquaredDistance exact =
      exact_triangle_distance(a.corners(pair.a), b.corners(pair.b), pair.squared.upper).squared;
  const double s = ratio_to_double(exact.numerator, exact.denominator);
  pair.squared = {s * (1 - 0x1p-52), s * (1 + 0x1p-52)};
  return s <= squared;
}

/// Pairs of triangles that are certainly within reach, up to a number.
struct NearTriangleCollector {
  const PairLocalPart &a, &b;
  std::size_t limit;
  double reach;  ///< a square
  QueryContext work = {};
  std::vector<NearTrianglePair> pairs = {};
  bool too_many = false;

  bool operator()(NearTrianglePair pair) {
    if (!settle(a, b, reach, pair, work)) return true;
    too_many = pairs.size() == limit;
    if (!too_many) pairs.push_back(pair);
    return !too_many;
  }
  bool take(NearTriangleCollector& piece) {
    too_many = too_many || piece.too_many || pairs.size() + piece.pairs.size() > limit;
    if (pairs.empty())
      pairs = std::move(piece.pairs);
    else if (!too_many)
      pairs.insert(pairs.end(), piece.pairs.begin(), piece.pairs.end());
    return !too_many;
  }
};

/// Number of triangles sampled for a part, and how many of them have to agree. part_distance.cpp
/// says what samples and probes gain.
constexpr std::size_t kSampledTriangles = 64, kAgree = 8;
/// Number of triangles below which a scan of all costs little more.
constexpr std::size_t kMinSampled = 4 * kSampledTriangles;
/// Factor by which the pairs that they stand for have to be too many.
constexpr std::uint64_t kFarTooMany = 2;

/// How many triangles of `b` are within reach of one of `a`, up to `limit`.
std::uint64_t count_near(const PairLocalPart& a, std::uint32_t triangle, const PairLocalPart& b,
                         const NearTriangleOptions& options, QueryContext& work) {
  const double squared = options.reach * options.reach;
  const DoubleTriangle own(a.corners(triangle));
  const auto shift = b.shift().as<double>();
  const auto may_reach = [&](const TriangleBvh::Node& node) {
    ++work.node_pairs;
    return squared_gap(own.box, node.box.as<double>().moved(shift)) <= squared;
  };
  std::uint64_t near = 0;
  (void)traverse_bvh(b.tree(), may_reach, [&](std::uint32_t t) {
    const DoubleTriangle other(b.corners(t));
    if (squared_gap(own.box, other.box) > squared) return true;
    ++work.triangle_pairs;
    near += triangles_within(a, b, own, other, {triangle, t}, squared, work) ? 1U : 0U;
    return near < options.limit;
  });
  return near;
}

/// Whether a sample of triangles from all over the first part shows that there are far too many
/// pairs. Slivers that cross each other make as many near pairs as the square of their number,
/// which a traversal notices late: most of their boxes overlap where they do not.
bool too_many_by_samples(const PairLocalPart& a, const PairLocalPart& b,
                         const NearTriangleOptions& options, QueryContext& work) {
  const std::vector<std::uint32_t>& order = a.tree().order();
  if (order.size() < kMinSampled) return false;
  const std::uint64_t wanted = kFarTooMany * options.limit * kSampledTriangles / order.size() + 1;
  const NearTriangleOptions each{.reach = options.reach, .limit = wanted / kAgree + 1};
  std::uint64_t near = 0;
  for (std::size_t i = 0; i < kSampledTriangles && near < wanted; ++i) {
    if (near + (kSampledTriangles - i) * each.limit < wanted) return false;
    near += count_near(a, sample(order, i, kSampledTriangles), b, each, work);
  }
  return near >= wanted;
}

/// Gathers from two trees: where there are too many, little more than that is looked at.
template <class Settled>
void gather_from(const PairLocalPart& a, const PairLocalPart& b, NearTriangleCollector& all,
                 QueryContext& work, const Settled& settled) {
  const auto room = [&] { return all.limit - all.pairs.size(); };
  std::optional<std::size_t> alone;  // how many there were before the walk called for help
  adaptive_distance_traversal(
      a, b, all.reach, work, [&] { return NearTriangleCollector{a, b, room(), all.reach}; },
      [&](NearTriangleCollector& piece) {
        const bool goes_on = all.take(piece);
        if (!alone) alone = all.pairs.size();
        return goes_on;
      },
      settled,
      [&](std::size_t done) {
        const std::size_t found = all.pairs.size() - *alone;
        return found == 0 ? kTraversalPieces : 1 + room() * done / found;
      });
}

/// A heavy traversal is restricted to pairs that the heights of flat faces leave open, which boxes
/// of slivers cannot separate.
void gather_by_trees(const NearTriangleOptions& options, NearTriangleCollector& all,
                     QueryContext& work) {
  const PairLocalPart &a = all.a, &b = all.b;
  const auto give_up = [&](const PairLocalPart& x, const PairLocalPart& y,
                           NearTriangleCollector& first) {
    first.too_many = too_many_by_samples(x, y, options, first.work);
    return first.too_many;
  };
  gather_from(a, b, all, work, [&](NearTriangleCollector& first) {
    if (give_up(a, b, first)) return true;
    // Slightly more than the reach: triangles exactly at it are near.
    const auto pieces = partition_by_height(a, b, {.apart = options.reach * (1 + 0x1p-40)});
    if (!pieces) return false;
    first.pairs.clear();
    for (const SlabPartition::Pair& pair : pieces->open) {
      if (all.too_many) break;
      const PairLocalPart x = pair.a->view(a.shift()), y = pair.b->view(b.shift());
      gather_from(x, y, all, work,
                  [&](NearTriangleCollector& piece) { return give_up(x, y, piece); });
    }
    return true;
  });
}

std::vector<NearTrianglePair> by_triangles(const std::vector<NearTrianglePair>& pairs,
                                           const Part& a, const Part& b) {
  std::vector<std::uint32_t> order = index_sequence(pairs.size());
  counting_sort(order, b.triangles.size(), [&](std::uint32_t i) { return pairs[i].b; });
  counting_sort(order, a.triangles.size(), [&](std::uint32_t i) { return pairs[i].a; });
  std::vector<NearTrianglePair> sorted;
  sorted.reserve(pairs.size());
  for (const std::uint32_t i : order) sorted.push_back(pairs[i]);
  return sorted;
}

}  // namespace

bool triangles_within(const PairLocalPart& a, const PairLocalPart& b, const DoubleTriangle& of_a,
                      const DoubleTriangle& of_b, const NodePair& numbers, double squared,
                      QueryContext& work) {
  NearTrianglePair pair{triangle_distance_bounds(of_a, of_b, squared, squared), numbers.a,
                        numbers.b};
  return settle(a, b, squared, pair, work);
}

std::optional<std::vector<NearTrianglePair>> near_triangles(const PairLocalPart& a,
                                                            const PairLocalPart& b,
                                                            const NearTriangleOptions& options,
                                                            QueryContext& work) {
  const double squared = options.reach * options.reach;
  NearTriangleCollector all{a, b, options.limit, squared};
  if (a.has_bvh() && b.has_bvh()) {
    gather_by_trees(options, all, work);
  } else {
    walk_lists(a, b, options.reach, all.work, all);
    work += all.work;
  }
  if (all.too_many) return std::nullopt;
  return by_triangles(all.pairs, a.part(), b.part());
}

void tighten_bounds(const PairLocalPart& a, const PairLocalPart& b, NearTrianglePair& pair) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const DistanceBounds sharp = triangle_distance_bounds(DoubleTriangle(a.corners(pair.a)),
                                                        DoubleTriangle(b.corners(pair.b)), kAll);
  pair.squared = {std::max(pair.squared.lower, sharp.lower),
                  std::min(pair.squared.upper, sharp.upper)};
}

}  // namespace strake::geometry
