// SPDX-License-Identifier: Apache-2.0
#include "clash/places.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "clash/witness.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/meeting_places.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::MeetingPlace;
using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;

/// Pairs of near triangles beyond which places are not told apart. Parts of some thousand triangles
/// may have them all near each other; of finer parts no pair of parts may take more than
/// microseconds a triangle, and a dozen a triangle is what lies face to face.
constexpr std::uint64_t kPairsPerTriangle = 4, kLeastPairs = 1U << 14U;

/// Two parts in canonical order.
class PairPlaces {
 public:
  PairPlaces(const NarrowPart& a, const NarrowPart& b, const PartAnswer& whole,
             const NarrowOptions& options, NarrowWork& work)
      : a_(a),
        b_(b),
        whole_(whole),
        options_(options),
        work_(work),
        part_a_(*a.treed.placed.part),
        part_b_(*b.treed.placed.part),
        thresholds_(thresholds(part_a_, part_b_, options)) {}

  std::optional<std::vector<PartPlace>> run(bool describe_one) {
    const auto found = geometry::meeting_places(
        a_.treed, b_.treed,
        {.reach = place_reach(a_, b_, whole_, options_),
         .interiors_meet = whole_.separation.interiors_meet,
         .describe_one = describe_one,
         .most_pairs = kLeastPairs +
                       kPairsPerTriangle * (part_a_.triangles.size() + part_b_.triangles.size())},
        work_.pair);
    if (!found) return std::nullopt;
    std::vector<PartPlace> places;
    if (found->size() < 2 && !describe_one) return places;
    if (found->size() < 2) {
      // What is common reaches farther than the skins that are near each other.
      const bool deep = found->empty() || whole_.separation.interiors_meet;
      places.push_back({whole_, deep ? extent_in_common() : found->front().extent});
      return places;
    }
    if (whole_.separation.interiors_meet) make_planes();
    for (const MeetingPlace& place : *found) places.push_back({answer_at(place), place.extent});
    give_whole(places);
    return places;
  }

 private:
  [[nodiscard]] Box3d extent_in_common() const {
    const geometry::PartFrame f = geometry::make_frame(part_a_), g = geometry::make_frame(part_b_);
    return geometry::common_extent({a_.treed.placed, &f}, {b_.treed.placed, &g},
                                   place_reach(a_, b_, whole_, options_));
  }

  void make_planes() {
    planes_a_ = geometry::make_support_planes(part_a_);
    planes_b_ = geometry::make_support_planes(part_b_);
    a_.planes = &planes_a_;
    b_.planes = &planes_b_;
  }

  PartAnswer answer_at(const MeetingPlace& place) {
    PartAnswer answer;
    answer.separation = {
        .d = place.nearest.distance, .lower = place.least, .upper = place.nearest.distance};
    answer.witness = place.nearest.distance > 0 ? witness_of_gap(place.nearest)
                                                : witness_of_touch(place.nearest.on_a);
    answer.relation = place.nearest.distance <= options_.contact_distance ? Relation::abut_outside
                                                                          : Relation::separate;
    if (whole_.separation.interiors_meet) go_deep(place, answer);
    answer.separation.sag = part_a_.sag + part_b_.sag;
    answer.judgement = judge(answer.separation, thresholds_);
    answer.judgement.flags |= part_flags(part_a_, part_b_);
    return answer;
  }

  /// The depth there; none that can be found is a touch that may be as deep as the bound.
  void go_deep(const MeetingPlace& place, PartAnswer& answer) {
    geometry::DepthGoal goal;
    goal.threshold = thresholds_.overlap;
    goal.known_upper = -whole_.separation.lower;
    goal.triangle_a = place.nearest.triangle_a;
    goal.triangle_b = place.nearest.triangle_b;
    goal.meeting_point = place.nearest.on_a;
    goal.within = place.extent;
    const geometry::Depth depth = depth_of(a_, b_, goal, work_);
    work_.depth_cells += depth.cells;
    answer.separation.lower = -depth.upper;
    if (!(depth.value > 0)) return;
    answer.separation = {
        .d = -depth.value, .lower = -depth.upper, .upper = -depth.lower, .interiors_meet = true};
    answer.witness = witness_of_depth(a_.treed, b_.treed, depth.point);
    const bool sheet = part_a_.kind == PartKind::sheet || part_b_.kind == PartKind::sheet;
    answer.relation = sheet ? Relation::cross : Relation::interfere;
  }

  /// The answer as a whole is that of the worst place, which holds its witness.
  void give_whole(std::vector<PartPlace>& places) const {
    const Vec3d at = whole_.witness.point();
    const auto less_likely = [&](const PartPlace& x, const PartPlace& y) {
      const bool in_x = x.extent.contains({at, at}), in_y = y.extent.contains({at, at});
      if (in_x != in_y) return in_y;
      return x.answer.separation.d > y.answer.separation.d;
    };
    const auto worst = std::ranges::max_element(places, less_likely);
    worst->answer = whole_;
    for (PartPlace& place : places) {
      if (&place == &*worst) continue;
      // No place is worse than the whole; the two searches stop at different brackets.
      keep_within_whole(place.answer);
    }
  }

  void keep_within_whole(PartAnswer& answer) const {
    Separation& s = answer.separation;
    if (s.d >= whole_.separation.d && s.lower >= whole_.separation.lower) return;
    s.lower = std::max(s.lower, whole_.separation.lower);
    s.d = std::max(s.d, whole_.separation.d);
    s.upper = std::max(s.upper, s.d);
    answer.judgement = judge(s, thresholds_);
    answer.judgement.flags |= part_flags(part_a_, part_b_);
  }

  NarrowPart a_, b_;
  const PartAnswer& whole_;
  const NarrowOptions& options_;
  NarrowWork& work_;
  const Part &part_a_, &part_b_;
  Thresholds thresholds_;
  geometry::SupportPlanes planes_a_, planes_b_;
};

}  // namespace

double place_reach(const NarrowPart& a, const NarrowPart& b, const PartAnswer& whole,
                   const NarrowOptions& options) {
  const double near = whole.judgement.cls == Class::clearance_violation
                          ? options.clearance
                          : std::max(options.touch_gap, options.contact_distance);
  return near + a.treed.placed.part->sag + b.treed.placed.part->sag;
}

std::optional<std::vector<PartPlace>> places_of(const NarrowPart& a, const NarrowPart& b,
                                                const PartAnswer& whole,
                                                const NarrowOptions& options, bool describe_one,
                                                NarrowWork& work) {
  if (in_canonical_order(a.treed, b.treed))
    return PairPlaces(a, b, whole, options, work).run(describe_one);
  PartAnswer turned = whole;
  turn(turned, b, a);
  auto places = PairPlaces(b, a, turned, options, work).run(describe_one);
  if (!places) return places;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  for (PartPlace& place : *places) {
    turn(place.answer, a, b);
    place.extent = place.extent.moved(shift);
  }
  return places;
}

}  // namespace strake::clash
