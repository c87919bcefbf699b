// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/near_pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"
#include "geometry/heavy_walk.hpp"
#include "geometry/places/bucket_order.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {
namespace {

/// Of two parts, those triangles of the one that come near the other's box.
struct Listed {
  std::vector<std::uint32_t> id;
  std::vector<DoubleTriangle> triangle;

  Listed(const PartView& of, const PartView& other, double squared) {
    const Box3d box = other.box(other.part().box).as<double>();
    for (std::uint32_t t = 0; t < of.part().triangles.size(); ++t) {
      const TriangleCorners c = of.corners(t);
      if (squared_gap(box_of(as_doubles(c)), box) > squared) continue;
      id.push_back(t);
      triangle.emplace_back(c);
    }
  }
};

/// Small parts are walked triangle by triangle.
template <class Visit>
void walk_lists(const PartView& a, const PartView& b, double squared, PairWork& work,
                Visit&& visit) {
  const Listed x(a, b, squared), y(b, a, squared);
  for (std::size_t i = 0; i < x.id.size(); ++i)
    for (std::size_t j = 0; j < y.id.size(); ++j) {
      if (squared_gap(x.triangle[i].box, y.triangle[j].box) > squared) continue;
      ++work.triangle_pairs;
      const DistanceBounds bounds = distance_bounds(x.triangle[i], y.triangle[j], squared, squared);
      if (bounds.lower <= squared && !visit(NearTriangles{bounds, x.id[i], y.id[j]})) return;
    }
}

/// Settles in exact arithmetic what the bounds leave open; false for triangles out of reach.
bool settle(const PartView& a, const PartView& b, double squared, NearTriangles& pair,
            PairWork& work) {
  if (pair.squared.lower > squared) return false;
  if (pair.squared.upper <= squared) return true;
  ++work.exact_fallbacks;
  const SquaredDistance exact =
      exact_distance(a.corners(pair.a), b.corners(pair.b), pair.squared.upper).squared;
  const double s = ratio_to_double(exact.numerator, exact.denominator);
  pair.squared = {s * (1 - 0x1p-52), s * (1 + 0x1p-52)};
  return s <= squared;
}

/// Pairs of triangles that are certainly within reach, up to a number.
struct Gathering {
  const PartView &a, &b;
  std::size_t most;
  double reach;  ///< a square
  PairWork work = {};
  std::vector<NearTriangles> pairs = {};
  bool too_many = false;

  bool operator()(NearTriangles pair) {
    if (!settle(a, b, reach, pair, work)) return true;
    too_many = pairs.size() == most;
    if (!too_many) pairs.push_back(pair);
    return !too_many;
  }
  bool take(Gathering& piece) {
    too_many = piece.too_many || pairs.size() + piece.pairs.size() > most;
    if (pairs.empty())
      pairs = std::move(piece.pairs);
    else if (!too_many)
      pairs.insert(pairs.end(), piece.pairs.begin(), piece.pairs.end());
    return !too_many;
  }
};

/// Where there are too many, little more than that is looked at.
void gather_by_trees(Gathering& all, PairWork& work) {
  const auto room = [&] { return all.most - all.pairs.size(); };
  std::optional<std::size_t> alone;  // how many the walk found before it asked for help
  heavy_near_walk(
      all.a, all.b, all.reach, work, [&] { return Gathering{all.a, all.b, room(), all.reach}; },
      [&](Gathering& piece) {
        const bool goes_on = all.take(piece);
        if (!alone) alone = all.pairs.size();
        return goes_on;
      },
      [](const Gathering& /*alone*/) { return false; },
      [&](std::size_t done) {
        const std::size_t found = all.pairs.size() - *alone;
        return found == 0 ? kWalkPieces : 1 + room() * done / found;
      });
}

std::vector<NearTriangles> by_triangles(const std::vector<NearTriangles>& pairs, const Part& a,
                                        const Part& b) {
  std::vector<std::uint32_t> order = first_numbers(pairs.size());
  bucket_order(order, b.triangles.size(), [&](std::uint32_t i) { return pairs[i].b; });
  bucket_order(order, a.triangles.size(), [&](std::uint32_t i) { return pairs[i].a; });
  std::vector<NearTriangles> sorted;
  sorted.reserve(pairs.size());
  for (const std::uint32_t i : order) sorted.push_back(pairs[i]);
  return sorted;
}

}  // namespace

bool triangles_within(const PartView& a, const PartView& b, const DoubleTriangle& of_a,
                      const DoubleTriangle& of_b, const NodePair& numbers, double squared,
                      PairWork& work) {
  NearTriangles pair{distance_bounds(of_a, of_b, squared, squared), numbers.a, numbers.b};
  return settle(a, b, squared, pair, work);
}

std::optional<std::vector<NearTriangles>> near_triangles(const PartView& a, const PartView& b,
                                                         const NearQuestion& question,
                                                         PairWork& work) {
  const double squared = question.reach * question.reach;
  Gathering all{a, b, question.most, squared};
  if (a.planted() && b.planted()) {
    gather_by_trees(all, work);
  } else {
    walk_lists(a, b, squared, all.work, all);
    work += all.work;
  }
  if (all.too_many) return std::nullopt;
  return by_triangles(all.pairs, a.part(), b.part());
}

void sharpen(const PartView& a, const PartView& b, NearTriangles& pair) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const DistanceBounds sharp =
      distance_bounds(DoubleTriangle(a.corners(pair.a)), DoubleTriangle(b.corners(pair.b)), kAll);
  pair.squared = {std::max(pair.squared.lower, sharp.lower),
                  std::min(pair.squared.upper, sharp.upper)};
}

}  // namespace strake::geometry
