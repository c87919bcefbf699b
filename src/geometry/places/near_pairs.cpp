// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/near_pairs.hpp"

#include <algorithm>
#include <tuple>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"
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
      const DistanceBounds bounds = distance_bounds(x.triangle[i], y.triangle[j], squared);
      if (bounds.lower <= squared && !visit(NearTriangles{bounds, x.id[i], y.id[j]})) return;
    }
}

}  // namespace

std::optional<std::vector<NearTriangles>> near_triangles(const PartView& a, const PartView& b,
                                                         double reach, std::uint64_t most,
                                                         PairWork& work) {
  const double squared = reach * reach;
  std::vector<NearTriangles> pairs;
  bool too_many = false;
  const auto visit = [&](NearTriangles pair) {
    if (pair.squared.upper > squared) {
      ++work.exact_fallbacks;
      const SquaredDistance exact =
          exact_distance(a.corners(pair.a), b.corners(pair.b), pair.squared.upper).squared;
      const double s = ratio_to_double(exact.numerator, exact.denominator);
      if (s > squared) return true;
      pair.squared = {s, s};
    }
    too_many = pairs.size() == most;
    if (!too_many) pairs.push_back(pair);
    return !too_many;
  };
  if (a.planted() && b.planted())
    NearWalk(a, b, work).run(squared, visit);
  else
    walk_lists(a, b, squared, work, visit);
  if (too_many) return std::nullopt;
  std::ranges::sort(pairs, [](const NearTriangles& x, const NearTriangles& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  return pairs;
}

}  // namespace strake::geometry
