// SPDX-License-Identifier: Apache-2.0
#include "clash/places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "clash/canonical_order.hpp"
#include "clash/pair_limits.hpp"
#include "clash/part_depth.hpp"
#include "clash/witness.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "strake/geometry/sheet_crossing.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::MeetingPlace;
using geometry::OnePlace;
using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;

/// Pairs of near triangles beyond which places are not told apart. Parts of some thousand triangles
/// may have them all near each other; of finer parts no pair of parts may take more than
/// microseconds a triangle, and a dozen a triangle is what lies face to face.
constexpr std::uint64_t kPairsPerTriangle = 2, kLeastPairs = 1U << 14U;
/// Cells of space that a place may cut at least, however many places there are.
constexpr std::uint32_t kLeastCells = 400;

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
        shift_((b.treed.placed.origin - a.treed.placed.origin).as<double>()),
        thresholds_(thresholds(part_a_, part_b_, options)) {}

  std::optional<std::vector<PartPlace>> run(Telling telling) {
    const double reach = place_reach(a_, b_, whole_, options_);
    const double clearance = options_.clearance + part_a_.sag + part_b_.sag;
    const bool beyond = telling == Telling::all && clearance > reach;
    const bool describe_one = telling >= Telling::each;
    // Where interiors meet, what is common reaches farther than the skins that are near each other.
    const bool boxed = describe_one && !whole_.separation.interiors_meet;
    if (!find(reach, boxed ? OnePlace::boxed : OnePlace::counted)) return std::nullopt;
    std::vector<PartPlace> places;
    if (found_.all.size() > 1)
      places = several();
    else if (describe_one)
      places.push_back(only());
    if (!beyond) return places;
    if (!find(clearance, OnePlace::described)) return std::nullopt;
    add_gaps(places);
    return places;
  }

 private:
  bool find(double reach, OnePlace one) {
    auto found = geometry::find_meeting_places(
        a_.treed, b_.treed,
        {.reach = reach,
         .distance = std::max(whole_.separation.d, 0.0),
         .interiors_meet = whole_.separation.interiors_meet,
         .one = one,
         .most_pairs = std::max(kLeastPairs, kPairsPerTriangle * (part_a_.triangles.size() +
                                                                  part_b_.triangles.size()))},
        work_.pair);
    if (found) found_ = std::move(*found);
    return found.has_value();
  }

  std::vector<PartPlace> several() {
    if (whole_.separation.interiors_meet) {
      if (both_sheets())
        cross_sheets();
      else
        make_planes();
    }
    const std::optional<std::uint32_t> deepest =
        whole_.separation.interiors_meet ? place_of(whole_.witness.point()) : std::nullopt;
    std::vector<PartPlace> places;
    for (std::size_t n = 0; n < found_.all.size(); ++n)
      places.push_back({n == deepest ? whole_ : answer_at(n), found_.all[n].extent, false});
    give_whole(places, deepest);
    return places;
  }

  PartPlace only() const {
    const bool deep = found_.all.empty() || whole_.separation.interiors_meet;
    return {whole_, deep ? extent_in_common() : found_.all.front().extent, true};
  }

  /// Of the places within the clearance those that hold none within the touch gap.
  void add_gaps(std::vector<PartPlace>& places) {
    for (std::size_t n = 0; n < found_.all.size(); ++n) {
      const MeetingPlace& place = found_.all[n];
      if (place.nearest.distance > options_.touch_gap && is_gap(place))
        places.push_back({answer_at(n), place.extent, false});
    }
  }

  [[nodiscard]] Box3d extent_in_common() const {
    geometry::PartFrame own_a, own_b;
    const auto frame_of = [](const NarrowPart& part,
                             geometry::PartFrame& own) -> const geometry::PartFrame* {
      if (part.frame != nullptr) return part.frame;
      own = geometry::make_frame(*part.treed.placed.part);
      return &own;
    };
    return geometry::common_extent({a_.treed.placed, frame_of(a_, own_a), a_.treed.tree},
                                   {b_.treed.placed, frame_of(b_, own_b), b_.treed.tree},
                                   place_reach(a_, b_, whole_, options_));
  }

  void make_planes() {
    const auto provide = [](NarrowPart& part, geometry::SupportPlanes& own) {
      if (part.planes != nullptr) return;
      own = geometry::make_support_planes(*part.treed.placed.part);
      part.planes = &own;
    };
    provide(a_, planes_a_);
    provide(b_, planes_b_);
  }

  [[nodiscard]] bool both_sheets() const {
    return part_a_.kind == PartKind::sheet && part_b_.kind == PartKind::sheet;
  }

  /// Finds where two sheets cross, and which place each stretch of that is in.
  void cross_sheets() {
    crossing_.emplace(a_.treed, b_.treed, apart_within(part_a_, part_b_, options_), work_.pair);
    stretches_.resize(found_.all.size());
    const auto& all = crossing_->stretches();
    for (std::uint32_t i = 0; i < all.size(); ++i)
      if (const auto place = found_.place_of_pair(all[i].triangle_a, all[i].triangle_b))
        stretches_[*place].push_back(i);
  }

  PartAnswer answer_at(std::size_t number) {
    const MeetingPlace& place = found_.all[number];
    PartAnswer answer;
    answer.separation = {
        .d = place.nearest.distance, .lower = place.least, .upper = place.nearest.distance};
    answer.witness = place.nearest.distance > 0 ? witness_of_gap(place.nearest)
                                                : witness_of_touch(place.nearest.on_a);
    answer.relation = place.nearest.distance <= options_.contact_distance ? Relation::abut_outside
                                                                          : Relation::separate;
    if (whole_.separation.interiors_meet && !is_gap(place)) go_deep(number, answer);
    answer.separation.sag = part_a_.sag + part_b_.sag;
    answer.separation.moved = whole_.separation.moved;
    answer.judgement = judge(answer.separation, thresholds_);
    answer.judgement.flags |= part_flags(part_a_, part_b_);
    return answer;
  }

  /// Whether the skins do not touch in a place, and what is between them is outside of both bodies:
  /// then these have nothing in common there.
  [[nodiscard]] bool is_gap(const MeetingPlace& place) {
    if (!(place.least > 0)) return false;
    constexpr double kSteps = 4096;
    const Vec3d middle = (place.nearest.on_a + place.nearest.on_b) * 0.5;
    const auto outside = [&](const geometry::TreedPart& part, const Vec3d& p) {
      if (part.placed.part->kind != PartKind::solid) return true;
      const geometry::Vec3l numerator{std::llround(p.x * kSteps), std::llround(p.y * kSteps),
                                      std::llround(p.z * kSteps)};
      return geometry::side_of(part, numerator, static_cast<std::int64_t>(kSteps), work_.pair) ==
             geometry::PointSide::outside;
    };
    return outside(a_.treed, middle) && outside(b_.treed, middle - shift_);
  }

  /// The place of a point of both bodies: that of the skin nearest to it, since no skin lies
  /// between.
  [[nodiscard]] std::optional<std::uint32_t> place_of(const Vec3d& p) const {
    const geometry::SkinPoint on_a = nearest_on_skin(a_.treed, p);
    const geometry::SkinPoint on_b = nearest_on_skin(b_.treed, p - shift_);
    if (on_a.distance <= on_b.distance)
      return found_.place_of({.of_a = true, .triangle = on_a.triangle, .point = on_a.point});
    return found_.place_of(
        {.of_a = false, .triangle = on_b.triangle, .point = on_b.point + shift_});
  }

  /// The depth there; none that can be found is a touch that may be as deep as the bound.
  void go_deep(std::size_t number, PartAnswer& answer) {
    geometry::DepthGoal goal;
    // Places share the allowance of the pair, as long as enough is left for each.
    const auto places = static_cast<std::uint32_t>(found_.all.size());
    goal.cells_undecided = std::max(goal.cells_undecided / places, kLeastCells);
    goal.cells_decided = std::max(goal.cells_decided / places, kLeastCells);
    goal.threshold = thresholds_.overlap;
    goal.known_upper = -whole_.separation.lower;
    const geometry::Depth depth = crossing_
                                      ? crossing_->depth_along(stretches_[number], goal, work_.pair)
                                      : depth_within(number, goal);
    work_.depth_cells += depth.cells;
    answer.separation.lower = -depth.upper;
    answer.separation.depth_complete = depth.complete;
    if (!(depth.value > 0)) return;
    answer.separation = {.d = -depth.value,
                         .lower = -depth.upper,
                         .upper = -depth.lower,
                         .interiors_meet = true,
                         .depth_complete = depth.complete};
    answer.witness = witness_of_depth(a_.treed, b_.treed, depth.point);
    const bool sheet = part_a_.kind == PartKind::sheet || part_b_.kind == PartKind::sheet;
    answer.relation = sheet ? Relation::cross : Relation::interfere;
  }

  /// What a place holds of what is common to both, of which one is a solid.
  geometry::Depth depth_within(std::size_t number, geometry::DepthGoal goal) {
    const MeetingPlace& place = found_.all[number];
    goal.apart_within = apart_within(part_a_, part_b_, options_);
    goal.triangle_a = place.nearest.triangle_a;
    goal.triangle_b = place.nearest.triangle_b;
    goal.meeting_point = place.nearest.on_a;
    goal.within = place.extent;
    goal.belongs = [this, number](const Vec3d& p) {
      return place_of(p).value_or(number) == number;
    };
    return depth_of(a_, b_, goal, work_);
  }

  /// The answer as a whole is that of the worst place, which holds its witness.
  void give_whole(std::vector<PartPlace>& places, std::optional<std::uint32_t> deepest) const {
    const Vec3d at = whole_.witness.point();
    const auto less_likely = [&](const PartPlace& x, const PartPlace& y) {
      const bool in_x = x.extent.contains({at, at}), in_y = y.extent.contains({at, at});
      if (in_x != in_y) return in_y;
      return x.answer.separation.d > y.answer.separation.d;
    };
    const auto worst = deepest ? places.begin() + static_cast<std::ptrdiff_t>(*deepest)
                               : std::ranges::max_element(places, less_likely);
    worst->answer = whole_;
    worst->is_whole = true;
    for (PartPlace& place : places) {
      if (&place == &*worst) continue;
      // No place is worse than the whole; the two searches stop at different brackets.
      keep_within_whole(place.answer);
    }
  }

  /// The whole may be known from the true surfaces, where places are told by triangles.
  void keep_within_whole(PartAnswer& answer) const {
    Separation& s = answer.separation;
    const double least = whole_.separation.lower - whole_.separation.sag;
    if (s.d >= whole_.separation.d && s.lower - s.sag >= least) return;
    const double most = s.upper + s.sag;
    s.d = std::max(s.d, whole_.separation.d);
    s.sag = std::clamp(s.d - least, 0.0, s.sag);
    s.lower = std::max(s.lower, least + s.sag);
    s.upper = std::max(s.d, most - s.sag);
    answer.judgement = judge(s, thresholds_);
    answer.judgement.flags |= part_flags(part_a_, part_b_);
  }

  NarrowPart a_, b_;
  const PartAnswer& whole_;
  const NarrowOptions& options_;
  NarrowWork& work_;
  const Part &part_a_, &part_b_;
  Vec3d shift_;
  geometry::MeetingPlaces found_;
  Thresholds thresholds_;
  geometry::SupportPlanes planes_a_, planes_b_;
  std::optional<geometry::SheetCrossing> crossing_;    ///< of two sheets in several places
  std::vector<std::vector<std::uint32_t>> stretches_;  ///< by place: those in it
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
                                                const NarrowOptions& options, Telling telling,
                                                NarrowWork& work) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  PartAnswer in_order = whole;
  if (!ordered) turn(in_order, b, a);
  auto places = ordered ? PairPlaces(a, b, in_order, options, work).run(telling)
                        : PairPlaces(b, a, in_order, options, work).run(telling);
  if (!places) return places;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  for (PartPlace& place : *places) {
    put_in_steps(place.answer);
    place.extent = {in_witness_steps(place.extent.lo), in_witness_steps(place.extent.hi)};
    if (ordered) continue;
    turn(place.answer, a, b);
    place.extent = place.extent.moved(shift);
  }
  return places;
}

}  // namespace strake::clash
