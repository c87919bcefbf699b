// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/meeting_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/places/clip.hpp"
#include "geometry/places/edge_stops.hpp"
#include "geometry/places/inside_links.hpp"
#include "geometry/places/near_pairs.hpp"
#include "strake/core/disjoint_sets.hpp"

namespace strake::geometry {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
/// Added to the reach, grid units: far above what double arithmetic makes of a touch.
constexpr double kTouch = 1.0 / 256;

std::array<Slab, 3> slabs_of(const Box3d& box) {
  return {Slab{{1, 0, 0}, box.lo.x, box.hi.x}, Slab{{0, 1, 0}, box.lo.y, box.hi.y},
          Slab{{0, 0, 1}, box.lo.z, box.hi.z}};
}

/// Adds what of two triangles lies within reach of the other to a box.
void include_common(const TriangleCorners& a, const TriangleCorners& b, double reach,
                    Box3d& extent) {
  // What rounding may have cut off.
  const double margin = reach + 1;
  const Corners corners_a = as_doubles(a), corners_b = as_doubles(b);
  const Box3d box_a = box_of(corners_a), box_b = box_of(corners_b);
  const Box3d room_a = box_b.inflated(margin), room_b = box_a.inflated(margin);
  if (extent.contains(room_a.common(room_b))) return;
  const Box3d of_a = room_a.contains(box_a) ? box_a : box_within(corners_a, slabs_of(room_a));
  const Box3d of_b = room_b.contains(box_b) ? box_b : box_within(corners_b, slabs_of(room_b));
  const Box3d both = of_a.inflated(margin).common(of_b.inflated(margin));
  extent.include(both.empty() ? room_a.common(room_b) : both);
}

class Places {
 public:
  Places(const TreedPart& a, const TreedPart& b, const PlacesQuestion& question, PairWork& work)
      : treed_a_(a),
        treed_b_(b),
        a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        question_(question),
        reach_(question.reach + kTouch),
        work_(work) {}

  std::optional<std::vector<MeetingPlace>> run() {
    // Who has one place only is not asked where it is nearest.
    const bool sharp = question_.describe_one;
    auto pairs = near_triangles(
        a_, b_, {.reach = reach_, .most = question_.most_pairs, .sharp = sharp}, work_);
    if (!pairs) return std::nullopt;
    pairs_ = std::move(*pairs);
    DisjointSets sets(pairs_.size() + a_.part().vertices.size() + b_.part().vertices.size());
    if (join_all(sets) == 1 && !question_.describe_one) return std::vector<MeetingPlace>(1);
    if (!sharp) sharpen(a_, b_, pairs_);
    return describe(sets);
  }

 private:
  [[nodiscard]] std::uint32_t first_vertex(bool of_a) const {
    return static_cast<std::uint32_t>(pairs_.size() + (of_a ? 0 : a_.part().vertices.size()));
  }

  /// Returns how many sets of pairs there are.
  std::size_t join_all(DisjointSets& sets) {
    const PlacesSide side_a{a_, b_, true}, side_b{b_, a_, false};
    const SidePairs of_a = grouped(side_a, pairs_), of_b = grouped(side_b, pairs_);
    std::size_t left = pairs_.size();
    left -= join_round_triangles(side_a, of_a, of_b, pairs_, reach_, sets);
    if (left > 1) left -= join_round_triangles(side_b, of_b, of_a, pairs_, reach_, sets);
    if (left <= 1 || !question_.interiors_meet) return left;
    if (b_.solid())
      link_inside(side_a, treed_b_, pairs_, edge_stops(side_a, of_a, pairs_, reach_), reach_,
                  {sets, first_vertex(true)}, work_);
    if (a_.solid())
      link_inside(side_b, treed_a_, pairs_, edge_stops(side_b, of_b, pairs_, reach_), reach_,
                  {sets, first_vertex(false)}, work_);
    left = 0;
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) left += sets.root(i) == i ? 1U : 0U;
    return left;
  }

  std::vector<MeetingPlace> describe(DisjointSets& sets) {
    std::vector<MeetingPlace> places;
    std::vector<std::uint32_t> nearest, number(pairs_.size(), kNone);
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      const std::uint32_t root = sets.root(i);  // the lowest: met before the others
      if (root == i) {
        number[i] = static_cast<std::uint32_t>(places.size());
        places.emplace_back();
        places.back().least = std::sqrt(pairs_[i].squared.lower);
        nearest.push_back(i);
      }
      const std::uint32_t n = number[i] = number[root];
      MeetingPlace& place = places[n];
      include_common(a_.corners(pairs_[i].a), b_.corners(pairs_[i].b), reach_, place.extent);
      place.least = std::min(place.least, std::sqrt(pairs_[i].squared.lower));
      if (pairs_[i].squared.upper < pairs_[nearest[n]].squared.upper) nearest[n] = i;
    }
    include_vertices(a_, first_vertex(true), sets, number, places);
    include_vertices(b_, first_vertex(false), sets, number, places);
    for (std::size_t n = 0; n < places.size(); ++n) measure(pairs_[nearest[n]], places[n]);
    return places;
  }

  /// Those inside the other body that belong to a place.
  static void include_vertices(const PartView& view, std::uint32_t first, DisjointSets& sets,
                               const std::vector<std::uint32_t>& number,
                               std::vector<MeetingPlace>& places) {
    for (std::uint32_t v = 0; v < view.part().vertices.size(); ++v) {
      const std::uint32_t root = sets.root(first + v);
      if (root < number.size()) places[number[root]].extent.include(view.vertex(v).as<double>());
    }
  }

  void measure(const NearTriangles& pair, MeetingPlace& place) {
    ++work_.exact_fallbacks;
    const NearestPoints p =
        exact_distance(a_.corners(pair.a), b_.corners(pair.b), pair.squared.upper);
    place.nearest = {.squared = ratio_to_double(p.squared.numerator, p.squared.denominator),
                     .distance = sqrt_ratio_to_double(p.squared.numerator, p.squared.denominator),
                     .on_a = p.on_a,
                     .on_b = p.on_b,
                     .triangle_a = pair.a,
                     .triangle_b = pair.b};
    place.least = std::min(place.least, place.nearest.distance);
  }

  const TreedPart &treed_a_, &treed_b_;
  PartView a_, b_;
  const PlacesQuestion& question_;
  double reach_;
  PairWork& work_;
  std::vector<NearTriangles> pairs_;
};

}  // namespace

std::optional<std::vector<MeetingPlace>> meeting_places(const TreedPart& a, const TreedPart& b,
                                                        const PlacesQuestion& question,
                                                        PairWork& work) {
  return Places(a, b, question, work).run();
}

}  // namespace strake::geometry
