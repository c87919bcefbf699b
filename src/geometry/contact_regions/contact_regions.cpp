// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/contact_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/union_find.hpp"
#include "geometry/contact_regions/edge_hits.hpp"
#include "geometry/contact_regions/interior_links.hpp"
#include "geometry/contact_regions/near_triangles.hpp"
#include "geometry/contact_regions/overlap_extent.hpp"
#include "geometry/contact_regions/single_region.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

constexpr std::uint32_t kNoRegion = 0xffffffffU;
/// Added to the reach, grid units: far above the rounding of a touch in doubles.
constexpr double kTouch = 1.0 / 256;

class RegionFinder {
 public:
  RegionFinder(const PartWithBvh& a, const PartWithBvh& b, const ContactRegionOptions& options)
      : treed_a_(a),
        treed_b_(b),
        a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        options_(options),
        reach_(options.reach + kTouch) {}

  std::optional<std::vector<ContactRegion>> find(QueryContext& work) {
    const SingleRegionDetail one = options_.one;
    const auto near = [&](std::uint64_t max_near) {
      return near_triangles(a_, b_, {.reach = reach_, .limit = max_near}, work);
    };
    std::optional<std::vector<NearTrianglePair>> pairs;
    if (one != SingleRegionDetail::described && is_single_region_affordable(a_.part(), b_.part())) {
      if (!wide()) pairs = near(few_pairs());
      if (!pairs) {
        const bool boxed = one == SingleRegionDetail::boxed;
        if (const auto box = find_single_region(a_, b_, {.reach = reach_, .boxed = boxed}, work)) {
          std::vector<ContactRegion> single(1);
          single.front().extent = *box;
          return single;
        }
      }
    }
    if (!pairs) pairs = near(options_.max_pairs);
    if (!pairs) return std::nullopt;
    pairs_ = std::move(*pairs);
    UnionFind sets(pairs_.size() + a_.part().vertices.size() + b_.part().vertices.size());
    const bool single = join_all(sets, work) == 1;
    if (single && one == SingleRegionDetail::counted) return std::vector<ContactRegion>(1);
    if (single && one == SingleRegionDetail::boxed) return std::vector<ContactRegion>{boxed_all()};
    return describe(sets, work);
  }

  /// Returns the region of a point among those of find(). Of several regions on a triangle it is
  /// the one whose other triangle is nearest: nothing separates the point from it.
  [[nodiscard]] std::optional<std::uint32_t> region_of(const ContactSurfacePoint& spot) const {
    const RegionSide side = spot.of_a ? side_a() : side_b();
    const std::span<const std::uint32_t> group = pairs_on(side, spot.triangle);
    if (group.empty()) {
      const std::vector<std::uint32_t>& vertices = spot.of_a ? vertices_a_ : vertices_b_;
      for (const std::uint32_t v : side.own.part().triangles[spot.triangle])
        if (vertices[v] != kNoRegion) return vertices[v];
      return std::nullopt;
    }
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t place = number_[group.front()];
    for (const std::uint32_t i : group) {
      const Corners other = as_doubles(side.other.corners(side.other_of(pairs_[i])));
      const Vec3d d = spot.point - nearest_on_triangle(spot.point, other);
      if (!(dot(d, d) < least)) continue;
      least = dot(d, d);
      place = number_[i];
    }
    return place;
  }

  /// Returns the region of two triangles.
  [[nodiscard]] std::optional<std::uint32_t> region_of_pair(std::uint32_t a,
                                                            std::uint32_t b) const {
    const auto numbers = [](const NearTrianglePair& p) { return std::pair(p.a, p.b); };
    const auto found = std::ranges::lower_bound(pairs_, std::pair(a, b), {}, numbers);
    if (found == pairs_.end() || numbers(*found) != std::pair(a, b)) return std::nullopt;
    return number_[static_cast<std::size_t>(found - pairs_.begin())];
  }

 private:
  /// Number of near pairs per triangle that are united one by one before a shortcut to a single
  /// region is tried. Between 1 and 4 ships show no difference (decision 0073).
  static constexpr std::uint64_t kFewPerTriangle = 1;

  /// Whether the rest of the reach beyond the distance is so wide relative to the smaller part that
  /// more than a few triangles will be near.
  [[nodiscard]] bool wide() const {
    const auto size = [](const Part& part) {
      const Vec3d d = part.box.hi.as<double>() - part.box.lo.as<double>();
      return std::max({d.x, d.y, d.z});
    };
    return 4 * (options_.reach - options_.distance) > std::min(size(a_.part()), size(b_.part()));
  }

  [[nodiscard]] std::uint64_t few_pairs() const {
    return std::min(options_.max_pairs,
                    kFewPerTriangle * (a_.part().triangles.size() + b_.part().triangles.size()));
  }

  [[nodiscard]] std::uint32_t first_vertex(bool of_a) const {
    return static_cast<std::uint32_t>(pairs_.size() + (of_a ? 0 : a_.part().vertices.size()));
  }

  [[nodiscard]] RegionSide side_a() const { return {a_, b_, true}; }
  [[nodiscard]] RegionSide side_b() const { return {b_, a_, false}; }

  /// The pairs that a triangle of a side is in.
  [[nodiscard]] std::span<const std::uint32_t> pairs_on(const RegionSide& side,
                                                        std::uint32_t triangle) const {
    const PairsByTriangle& rows = side.is_a ? of_a_ : of_b_;
    const auto own = [&](std::uint32_t first) { return side.own_of(pairs_[rows.order[first]]); };
    const auto end = rows.first.end() - 1;
    const auto row =
        std::lower_bound(rows.first.begin(), end, triangle,
                         [&](std::uint32_t first, std::uint32_t t) { return own(first) < t; });
    if (row == end || own(*row) != triangle) return {};
    return rows.group(static_cast<std::size_t>(row - rows.first.begin()));
  }

  /// Returns how many sets of pairs there are.
  std::size_t join_all(UnionFind& sets, QueryContext& work) {
    of_a_ = grouped(side_a(), pairs_);
    of_b_ = grouped(side_b(), pairs_);
    std::size_t left = pairs_.size();
    left -= join_around_triangles(side_a(), of_a_, of_b_, pairs_, reach_, sets);
    if (left > 1) left -= join_around_triangles(side_b(), of_b_, of_a_, pairs_, reach_, sets);
    if (left <= 1) return left;
    const RegionSide of_a = side_a(), of_b = side_b();
    const NearSolid in_b{of_a, of_a_, pairs_, treed_b_, reach_};
    const NearSolid in_a{of_b, of_b_, pairs_, treed_a_, reach_};
    if (b_.solid()) left -= unite_through_material(in_b, sets, work);
    if (a_.solid()) left -= unite_through_material(in_a, sets, work);
    if (left <= 1 || !options_.interiors_meet) return left;
    if (b_.solid()) unite_through_interior(in_b, {sets, first_vertex(true)}, work);
    if (a_.solid()) unite_through_interior(in_a, {sets, first_vertex(false)}, work);
    left = 0;
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) left += sets.root(i) == i ? 1U : 0U;
    return left;
  }

  [[nodiscard]] ContactRegion boxed_all() const {
    ContactRegion place;
    for (const NearTrianglePair& p : pairs_)
      include_overlap(a_.corners(p.a), b_.corners(p.b), reach_, place.extent);
    return place;
  }

  std::vector<ContactRegion> describe(UnionFind& sets, QueryContext& work) {
    std::vector<ContactRegion> places;
    number_.assign(pairs_.size(), kNoRegion);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      const std::uint32_t root = sets.root(i);  // the lowest: met before the others
      if (root == i) {
        number_[i] = static_cast<std::uint32_t>(places.size());
        places.emplace_back();
      }
      number_[i] = number_[root];
      include_overlap(a_.corners(pairs_[i].a), b_.corners(pairs_[i].b), reach_,
                      places[number_[i]].extent);
    }
    const std::vector<std::uint32_t> nearest = find_nearest(places);
    vertices_a_ = include_vertices(a_, first_vertex(true), sets, places);
    vertices_b_ = include_vertices(b_, first_vertex(false), sets, places);
    for (std::size_t n = 0; n < places.size(); ++n) measure(pairs_[nearest[n]], places[n], work);
    return places;
  }

  /// Returns, by region, the first of its pairs that no other is certainly nearer than; sets
  /// `least`.
  std::vector<std::uint32_t> find_nearest(std::vector<ContactRegion>& places) {
    const auto box = [](const TriangleCorners& t) { return box_of(as_doubles(t)); };
    std::vector<double> gap(pairs_.size());
    std::vector<std::uint32_t> nearest(places.size(), kNoRegion);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      gap[i] = squared_gap(box(a_.corners(pairs_[i].a)), box(b_.corners(pairs_[i].b)));
      std::uint32_t& first = nearest[number_[i]];
      if (first == kNoRegion || gap[i] < gap[first]) first = i;
    }
    std::vector<double> least(places.size(), std::numeric_limits<double>::infinity());
    for (const std::uint32_t i : nearest) tighten_bounds(a_, b_, pairs_[i]);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      const std::uint32_t n = number_[i];
      const double limit = pairs_[nearest[n]].squared.upper;
      if (gap[i] * (1 - 0x1p-40) > limit) continue;
      if (i != nearest[n]) tighten_bounds(a_, b_, pairs_[i]);
      least[n] = std::min(least[n], pairs_[i].squared.lower);
      const double upper = pairs_[i].squared.upper;
      if (upper < limit || (upper == limit && i < nearest[n])) nearest[n] = i;
    }
    for (std::size_t n = 0; n < places.size(); ++n) places[n].least = std::sqrt(least[n]);
    return nearest;
  }

  /// Includes the vertices inside the other body that belong to a region; returns the region by
  /// vertex.
  std::vector<std::uint32_t> include_vertices(const PairLocalPart& view, std::uint32_t first,
                                              UnionFind& sets,
                                              std::vector<ContactRegion>& places) const {
    std::vector<std::uint32_t> place(view.part().vertices.size(), kNoRegion);
    for (std::uint32_t v = 0; v < place.size(); ++v) {
      const std::uint32_t root = sets.root(first + v);
      if (root >= number_.size()) continue;
      place[v] = number_[root];
      places[place[v]].extent.include(view.vertex(v).as<double>());
    }
    return place;
  }

  void measure(const NearTrianglePair& pair, ContactRegion& place, QueryContext& work) const {
    ++work.exact_fallbacks;
    const NearestTrianglePoints p =
        exact_triangle_distance(a_.corners(pair.a), b_.corners(pair.b), pair.squared.upper);
    place.nearest = {.squared = ratio_to_double(p.squared.numerator, p.squared.denominator),
                     .distance = sqrt_ratio_to_double(p.squared.numerator, p.squared.denominator),
                     .on_a = p.on_a,
                     .on_b = p.on_b,
                     .triangle_a = pair.a,
                     .triangle_b = pair.b};
    place.least = std::min(place.least, place.nearest.distance);
  }

  PartWithBvh treed_a_, treed_b_;
  PairLocalPart a_, b_;
  ContactRegionOptions options_;
  double reach_;
  std::vector<NearTrianglePair> pairs_;
  PairsByTriangle of_a_, of_b_;
  std::vector<std::uint32_t> number_;                   ///< of its region, by pair
  std::vector<std::uint32_t> vertices_a_, vertices_b_;  ///< likewise, kNoRegion for none
};

}  // namespace

std::optional<ContactRegions> find_contact_regions(const PartWithBvh& a, const PartWithBvh& b,
                                                   const ContactRegionOptions& options,
                                                   QueryContext& work) {
  const auto places = std::make_shared<RegionFinder>(a, b, options);
  auto all = places->find(work);
  if (!all) return std::nullopt;
  return ContactRegions{
      std::move(*all),
      [places](const ContactSurfacePoint& spot) { return places->region_of(spot); },
      [places](std::uint32_t of_a, std::uint32_t of_b) {
        return places->region_of_pair(of_a, of_b);
      }};
}

std::optional<std::vector<ContactRegion>> contact_regions(const PartWithBvh& a,
                                                          const PartWithBvh& b,
                                                          const ContactRegionOptions& options,
                                                          QueryContext& work) {
  return RegionFinder(a, b, options).find(work);
}

}  // namespace strake::geometry
