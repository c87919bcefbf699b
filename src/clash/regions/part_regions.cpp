// SPDX-License-Identifier: Apache-2.0
#include "clash/regions/part_regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "clash/narrow_phase/canonical_order.hpp"
#include "clash/narrow_phase/pair_evaluator.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/narrow_phase/wire_clash.hpp"
#include "clash/narrow_phase/witness.hpp"
#include "geometry/contact_regions/contact_regions.hpp"
#include "geometry/interior_depth/bounds/convexity.hpp"
#include "geometry/interior_depth/sheets/sheet_crossing.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

struct DetailRequest {
  std::size_t pair = 0;
  RegionDetail detail = RegionDetail::whole;
};

/// Requests the detail that the k-th pair of objects needs of its pairs of parts.
void request_detail(const EvaluatedPairs& evaluated, const ObjectPairs& objects, std::size_t k,
                    bool may_allow, std::vector<DetailRequest>& out) {
  const std::size_t first = objects.begin(k), end = objects.end(k), before = out.size();
  const auto cls = [&](std::size_t i) {
    return evaluated.of(i).evaluation.answer.classification.cls;
  };
  Class worst = Class::no_hit;
  for (std::size_t i = first; i < end; ++i) worst = std::max(worst, cls(i));
  for (std::size_t i = first; i < end; ++i) {
    if (cls(i) == Class::no_hit) continue;
    if (cls(i) == Class::clearance_violation && cls(i) != worst && !may_allow) continue;
    // The regions of a line and any other part are not distinguished.
    if (has_wire(*evaluated.a(i).placed.part, *evaluated.b(i).placed.part)) continue;
    const bool copies = evaluated.of(i).evaluation.answer.relation == Relation::duplicate;
    out.push_back({i, copies ? RegionDetail::whole : RegionDetail::if_several});
  }
  if (may_allow || out.size() - before > 1)
    for (std::size_t i = before; i < out.size(); ++i)
      out[i].detail = may_allow ? RegionDetail::all : RegionDetail::each;
}

}  // namespace

Result<std::vector<RegionDetail>> region_detail_of(const EvaluatedPairs& evaluated,
                                                   const ObjectPairs& objects,
                                                   const RuleMatcher& rules, const Options& options,
                                                   const parallel::Context& context) {
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 4096;
  const auto all = parallel::collect<DetailRequest>(
      context, {.name = "places asked for", .n = objects.size(), .grain = kGrain},
      [&](std::size_t k, std::vector<DetailRequest>& out) {
        const std::size_t i = objects.begin(k);
        const bool may_allow = rules.may_allow(evaluated.a(i).object, evaluated.b(i).object);
        if (may_allow || options.engine.max_regions > 0)
          request_detail(evaluated, objects, k, may_allow, out);
      });
  if (!all) return all.error();
  std::vector<RegionDetail> detail(evaluated.pairs.size(), RegionDetail::whole);
  for (const DetailRequest& a : *all) detail[a.pair] = a.detail;
  return detail;
}

namespace {

using geometry::Box3d;
using geometry::ContactRegion;
using geometry::Part;
using geometry::PartKind;
using geometry::SingleRegionDetail;
using geometry::Vec3d;

/// The most pairs of near triangles for which regions are distinguished. Parts of some thousand
/// triangles may have them all near each other; of finer parts no pair of parts may take more than
/// microseconds a triangle, and parts that lie face to face have a dozen a triangle. With 32 a pipe
/// of 100,000 triangles in a sleeve took 6 µs a triangle, and was given up then.
constexpr std::uint64_t kPairsPerTriangle = 2, kMinPairs = 1U << 14U;
/// The least number of cells of space that a region may cut, however many regions there are.
constexpr std::uint32_t kMinCells = 400;

/// Finds the regions of two parts in canonical order.
class PartRegionFinder {
 public:
  PartRegionFinder(const PairOperand& a, const PairOperand& b, const PartPairResult& whole,
                   const PairTolerances& options, NarrowWork& work)
      : a_(a),
        b_(b),
        whole_(whole),
        options_(options),
        work_(work),
        part_a_(*a.treed.placed.part),
        part_b_(*b.treed.placed.part),
        shift_((b.treed.placed.origin - a.treed.placed.origin).as<double>()),
        thresholds_(thresholds(part_a_, part_b_, options)) {}

  std::optional<std::vector<PartRegion>> run(RegionDetail detail) {
    const double reach = region_reach(a_, b_, whole_, options_);
    const double clearance = options_.clearance + part_a_.sag + part_b_.sag;
    const bool beyond = detail == RegionDetail::all && clearance > reach;
    const bool describe_one = detail >= RegionDetail::each;
    // Where interiors meet, the common part reaches farther than the surfaces that are near each
    // other.
    const bool boxed = describe_one && !whole_.separation.interiors_meet;
    if (!find(reach, boxed ? SingleRegionDetail::boxed : SingleRegionDetail::counted))
      return std::nullopt;
    std::vector<PartRegion> regions;
    if (found_.all.size() > 1)
      regions = several();
    else if (describe_one)
      regions.push_back(only());
    if (!beyond) return regions;
    if (!find(clearance, SingleRegionDetail::described)) return std::nullopt;
    add_clearance_regions(regions);
    return regions;
  }

 private:
  bool find(double reach, SingleRegionDetail one) {
    auto found = geometry::find_contact_regions(
        a_.treed, b_.treed,
        {.reach = reach,
         .distance = std::max(whole_.separation.d, 0.0),
         .interiors_meet = whole_.separation.interiors_meet,
         .one = one,
         .max_pairs = std::max(
             kMinPairs, kPairsPerTriangle * (part_a_.triangles.size() + part_b_.triangles.size()))},
        work_.pair);
    if (found) found_ = std::move(*found);
    return found.has_value();
  }

  std::vector<PartRegion> several() {
    if (whole_.separation.interiors_meet) {
      if (both_sheets())
        cross_sheets();
      else
        make_planes();
    }
    const std::optional<std::uint32_t> deepest =
        whole_.separation.interiors_meet ? region_of(whole_.witness.point()) : std::nullopt;
    std::vector<PartRegion> regions;
    for (std::size_t n = 0; n < found_.all.size(); ++n)
      regions.push_back({n == deepest ? whole_ : answer_at(n), found_.all[n].extent, false});
    give_whole(regions, deepest);
    return regions;
  }

  PartRegion only() const {
    const bool deep = found_.all.empty() || whole_.separation.interiors_meet;
    return {whole_, deep ? extent_in_common() : found_.all.front().extent, true};
  }

  /// Adds those regions within the clearance that hold none within the touch gap.
  void add_clearance_regions(std::vector<PartRegion>& regions) {
    for (std::size_t n = 0; n < found_.all.size(); ++n) {
      const ContactRegion& region = found_.all[n];
      if (region.nearest.distance > options_.touch_gap && is_gap(region))
        regions.push_back({answer_at(n), region.extent, false});
    }
  }

  [[nodiscard]] Box3d extent_in_common() const {
    geometry::OrientedBox own_a, own_b;
    const auto frame_of = [](const PairOperand& part,
                             geometry::OrientedBox& own) -> const geometry::OrientedBox* {
      if (part.frame != nullptr) return part.frame;
      own = geometry::make_oriented_box(*part.treed.placed.part);
      return &own;
    };
    return geometry::overlap_extent({a_.treed.placed, frame_of(a_, own_a), a_.treed.tree},
                                    {b_.treed.placed, frame_of(b_, own_b), b_.treed.tree},
                                    region_reach(a_, b_, whole_, options_));
  }

  void make_planes() {
    const auto provide = [](PairOperand& part, geometry::FaceKdop& own) {
      if (part.planes != nullptr) return;
      own = geometry::make_face_kdop(*part.treed.placed.part);
      part.planes = &own;
    };
    provide(a_, planes_a_);
    provide(b_, planes_b_);
  }

  [[nodiscard]] bool both_sheets() const {
    return part_a_.kind == PartKind::sheet && part_b_.kind == PartKind::sheet;
  }

  /// Finds where two sheets cross, and the region of each stretch of that.
  void cross_sheets() {
    crossing_.emplace(a_.treed, b_.treed, apart_within(part_a_, part_b_, options_), work_.pair);
    segments_.resize(found_.all.size());
    const auto& all = crossing_->crossing_segments();
    for (std::uint32_t i = 0; i < all.size(); ++i)
      if (const auto region = found_.region_of_pair(all[i].triangle_a, all[i].triangle_b))
        segments_[*region].push_back(i);
  }

  PartPairResult answer_at(std::size_t number) {
    const ContactRegion& region = found_.all[number];
    PartPairResult answer;
    answer.separation = {
        .d = region.nearest.distance, .lower = region.least, .upper = region.nearest.distance};
    answer.witness = region.nearest.distance > 0 ? witness_of_gap(region.nearest)
                                                 : witness_of_touch(region.nearest.on_a);
    answer.relation = region.nearest.distance <= options_.contact_distance ? Relation::abut_outside
                                                                           : Relation::separate;
    if (whole_.separation.interiors_meet && !is_gap(region)) go_deep(number, answer);
    answer.separation.sag = part_a_.sag + part_b_.sag;
    answer.separation.moved = whole_.separation.moved;
    answer.classification = classify(answer.separation, thresholds_);
    answer.classification.flags |= part_flags(part_a_, part_b_);
    return answer;
  }

  /// Whether the surfaces do not touch in a region, and what is between them is outside of both
  /// bodies: then these have nothing in common there.
  [[nodiscard]] bool is_gap(const ContactRegion& region) {
    if (!(region.least > 0)) return false;
    constexpr double kSteps = 4096;
    const Vec3d middle = (region.nearest.on_a + region.nearest.on_b) * 0.5;
    const auto outside = [&](const geometry::PartWithBvh& part, const Vec3d& p) {
      if (part.placed.part->kind != PartKind::solid) return true;
      const geometry::Vec3l numerator{std::llround(p.x * kSteps), std::llround(p.y * kSteps),
                                      std::llround(p.z * kSteps)};
      return geometry::side_of(part, numerator, static_cast<std::int64_t>(kSteps), work_.pair) ==
             geometry::PointSide::outside;
    };
    return outside(a_.treed, middle) && outside(b_.treed, middle - shift_);
  }

  /// Returns the region of a point of both bodies: that of the surface nearest to it, since no
  /// surface lies between.
  [[nodiscard]] std::optional<std::uint32_t> region_of(const Vec3d& p) const {
    const geometry::SurfacePoint on_a = nearest_on_surface(a_.treed, p);
    const geometry::SurfacePoint on_b = nearest_on_surface(b_.treed, p - shift_);
    if (on_a.distance <= on_b.distance)
      return found_.region_of({.of_a = true, .triangle = on_a.triangle, .point = on_a.point});
    return found_.region_of(
        {.of_a = false, .triangle = on_b.triangle, .point = on_b.point + shift_});
  }

  /// Measures the depth there; if none can be found, it is a touch that may be as deep as the
  /// bound.
  void go_deep(std::size_t number, PartPairResult& answer) {
    geometry::DepthOptions goal;
    // Regions share the allowance of the pair, as long as enough is left for each.
    const auto regions = static_cast<std::uint32_t>(found_.all.size());
    goal.cells_undecided = std::max(goal.cells_undecided / regions, kMinCells);
    goal.cells_decided = std::max(goal.cells_decided / regions, kMinCells);
    goal.threshold = thresholds_.overlap;
    goal.known_upper = -whole_.separation.lower;
    const geometry::Depth depth = crossing_
                                      ? crossing_->depth_along(segments_[number], goal, work_.pair)
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

  /// Returns the depth of the common part in a region, where one part is a solid.
  geometry::Depth depth_within(std::size_t number, geometry::DepthOptions goal) {
    const ContactRegion& region = found_.all[number];
    goal.apart_within = apart_within(part_a_, part_b_, options_);
    goal.triangle_a = region.nearest.triangle_a;
    goal.triangle_b = region.nearest.triangle_b;
    goal.meeting_point = region.nearest.on_a;
    goal.within = region.extent;
    goal.belongs = [this, number](const Vec3d& p) {
      return region_of(p).value_or(number) == number;
    };
    return depth_of(a_, b_, goal, work_);
  }

  /// Gives the result as a whole to the worst region, which holds its witness.
  void give_whole(std::vector<PartRegion>& regions, std::optional<std::uint32_t> deepest) const {
    const Vec3d at = whole_.witness.point();
    const auto is_less_likely = [&](const PartRegion& x, const PartRegion& y) {
      const bool in_x = x.extent.contains({at, at}), in_y = y.extent.contains({at, at});
      if (in_x != in_y) return in_y;
      return x.answer.separation.d > y.answer.separation.d;
    };
    const auto worst = deepest ? regions.begin() + static_cast<std::ptrdiff_t>(*deepest)
                               : std::ranges::max_element(regions, is_less_likely);
    worst->answer = whole_;
    worst->is_whole = true;
    for (PartRegion& region : regions) {
      if (&region == &*worst) continue;
      // No region is worse than the whole; the two searches stop at different brackets.
      keep_within_whole(region.answer);
    }
  }

  /// The whole may be known from the true surfaces, where regions are distinguished by triangles.
  void keep_within_whole(PartPairResult& answer) const {
    SignedSeparation& s = answer.separation;
    const double least = whole_.separation.lower - whole_.separation.sag;
    if (s.d >= whole_.separation.d && s.lower - s.sag >= least) return;
    const double largest = s.upper + s.sag;
    s.d = std::max(s.d, whole_.separation.d);
    s.sag = std::clamp(s.d - least, 0.0, s.sag);
    s.lower = std::max(s.lower, least + s.sag);
    s.upper = std::max(s.d, largest - s.sag);
    answer.classification = classify(s, thresholds_);
    answer.classification.flags |= part_flags(part_a_, part_b_);
  }

  PairOperand a_, b_;
  const PartPairResult& whole_;
  const PairTolerances& options_;
  NarrowWork& work_;
  const Part &part_a_, &part_b_;
  Vec3d shift_;
  geometry::ContactRegions found_;
  Thresholds thresholds_;
  geometry::FaceKdop planes_a_, planes_b_;
  std::optional<geometry::SheetCrossing> crossing_;  ///< for two sheets with several regions
  std::vector<std::vector<std::uint32_t>>
      segments_;  ///< by region: the segments of the crossing in it
};

}  // namespace

double region_reach(const PairOperand& a, const PairOperand& b, const PartPairResult& whole,
                    const PairTolerances& options) {
  const double near = whole.classification.cls == Class::clearance_violation
                          ? options.clearance
                          : std::max(options.touch_gap, options.contact_distance);
  return near + a.treed.placed.part->sag + b.treed.placed.part->sag;
}

std::optional<std::vector<PartRegion>> find_part_regions(const PairOperand& a, const PairOperand& b,
                                                         const PartPairResult& whole,
                                                         const PairTolerances& options,
                                                         RegionDetail detail, NarrowWork& work) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  PartPairResult in_order = whole;
  if (!ordered) swap_sides(in_order, b, a);
  auto regions = ordered ? PartRegionFinder(a, b, in_order, options, work).run(detail)
                         : PartRegionFinder(b, a, in_order, options, work).run(detail);
  if (!regions) return regions;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  for (PartRegion& region : *regions) {
    round_to_witness_grid(region.answer);
    region.extent = {on_witness_grid(region.extent.lo), on_witness_grid(region.extent.hi)};
    if (ordered) continue;
    swap_sides(region.answer, a, b);
    region.extent = region.extent.moved(shift);
  }
  return regions;
}

namespace {

class RegionStage {
 public:
  /// `detail`: that of each unique pair.
  RegionStage(const StageInputs& stage, const EvaluatedPairs& evaluated,
              std::vector<Candidate>& candidates, std::vector<RegionDetail> detail)
      : stage_(stage),
        work_(stage.work),
        cache_(stage.cache),
        evaluated_(evaluated),
        candidates_(candidates),
        detail_(std::move(detail)) {}

  Result<DetailedRegions> run() {
    found_.of_unique.resize(candidates_.size());
    found_.too_near.resize(candidates_.size(), 0);
    std::vector<std::size_t> alone, unresolved;
    for (std::size_t i = 0; i < detail_.size(); ++i) {
      if (detail_[i] == RegionDetail::if_several) alone.push_back(i);
      if (detail_[i] >= RegionDetail::each) unresolved.push_back(i);
    }
    if (const auto taken = take_simple(alone); !taken) return taken.error();
    const auto simple = take_simple(unresolved);
    if (!simple) return simple.error();
    if (const Status s = measure_simple(*simple); !s) return s.error();
    unresolved.insert(unresolved.end(), alone.begin(), alone.end());
    if (const Status s = find_open_regions(unresolved); !s) return s.error();
    return std::move(found_);
  }

 private:
  /// Removes the unique pairs that certainly have one region: where one flat face of each meets,
  /// where one body lies in the other, and where both parts are convex.
  Result<std::vector<std::size_t>> take_simple(std::vector<std::size_t>& some) const {
    const auto flat = parallel::transform(
        work_.context(), {.name = "flat places", .n = some.size(), .grain = PairTasks::kGrain},
        [&](std::size_t k) { return static_cast<std::uint8_t>(is_planar_region(some[k])); });
    if (!flat) return flat.error();
    std::vector<std::size_t> taken, others;
    for (std::size_t k = 0; k < some.size(); ++k)
      ((*flat)[k] != 0 || is_contained(some[k]) ? taken : others).push_back(some[k]);
    const auto convex = convex_parts(others);
    if (!convex) return convex.error();
    some.clear();
    for (const std::size_t i : others) {
      const bool both =
          *convex->find(work_.a(i).unique) != 0 && *convex->find(work_.b(i).unique) != 0;
      (both ? taken : some).push_back(i);
    }
    return taken;
  }

  /// Whether a solid lies in another: a connected body of which every point is common.
  [[nodiscard]] bool is_contained(std::size_t i) const {
    const Relation relation = candidates_[i].evaluation.answer.relation;
    return work_.a(i).placed.part->kind == geometry::PartKind::solid &&
           work_.b(i).placed.part->kind == geometry::PartKind::solid &&
           (relation == Relation::a_in_b || relation == Relation::b_in_a ||
            relation == Relation::abut_inside || relation == Relation::duplicate);
  }

  [[nodiscard]] bool is_planar_region(std::size_t i) const {
    const PartPairResult& answer = candidates_[i].evaluation.answer;
    if (answer.separation.interiors_meet || answer.classification.cls != Class::contact)
      return false;
    const ScenePart &a = work_.a(i), &b = work_.b(i);
    const PairOperand x = cache_.framed(a), y = cache_.framed(b);
    const PairTolerances options = stage_.pair_tolerances.of(a, b);
    double reach = region_reach(x, y, answer, options);
    if (detail_[i] == RegionDetail::all) reach = std::max(reach, reach_of(options));
    return geometry::meet_in_one_planar_region({x.treed.placed, x.frame}, {y.treed.placed, y.frame},
                                               reach);
  }

  /// Returns whether each unique part is convex, for those that some of the unique pairs are about.
  Result<parallel::Precomputed<std::uint8_t>> convex_parts(
      const std::vector<std::size_t>& some) const {
    // Dents that do not separate regions: the touch gap bridges them.
    const double slack = std::max(1.0, stage_.pair_tolerances.min_touch_gap() / 4);
    const auto& unique = evaluated_.list.unique;
    parallel::Precomputed<std::uint8_t> convex(unique.size());
    const Status status = convex.fill_by_weight(
        work_.context(), {.name = "convex parts"}, PairTasks::kHeavy,
        parallel::keys_of(work_.parts_of(some)),
        [&](std::size_t u) { return unique[u]->triangles.size(); },
        [&](std::size_t u) {
          return static_cast<std::uint8_t>(
              geometry::nearly_convex(*unique[u], slack, work_.context()));
        });
    if (!status) return status.error();
    return convex;
  }

  /// Measures the boxes of unique pairs that have one region.
  Status measure_simple(const std::vector<std::size_t>& some) {
    if (const Status s = cache_.ensure_frames(work_.parts_of(some), work_.context()); !s) return s;
    return work_.for_each_of(
        some, "simple places", PairTasks::kGrain,
        [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
          const PairOperand x = cache_.treed(a), y = cache_.treed(b);
          const PartPairResult& answer = candidates_[i].evaluation.answer;
          const double reach = region_reach(x, y, answer, stage_.pair_tolerances.of(a, b));
          found_.of_unique[i] = {
              {answer,
               geometry::overlap_extent({a.placed, x.frame, x.treed.tree},
                                        {b.placed, y.frame, y.treed.tree}, reach),
               true}};
        });
  }

  Status find_open_regions(const std::vector<std::size_t>& some) {
    std::vector<std::size_t> treed;
    for (const std::size_t i : some)
      if (needs_bvhs(i)) treed.push_back(i);
    if (const Status s = cache_.ensure_trees(work_.parts_of(treed), work_.context()); !s) return s;
    return work_.for_each_of(
        some, "places", 1, [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
          Candidate& c = candidates_[i];
          auto found = with_cost(c, work_.context(), [&](NarrowWork& work) {
            return find_part_regions(cache_.planed(a), cache_.planed(b), c.evaluation.answer,
                                     stage_.pair_tolerances.of(a, b), detail_[i], work);
          });
          found_.too_near[i] = found ? 0 : 1;
          if (found) found_.of_unique[i] = std::move(*found);
        });
  }

  /// Whether a pair needs trees: small parts that only touch are traversed faster than a tree is
  /// built.
  [[nodiscard]] bool needs_bvhs(std::size_t i) const {
    constexpr std::size_t kMaxTrianglesWithoutBvh = 512;
    return candidates_[i].evaluation.answer.separation.interiors_meet ||
           work_.triangles(i) > kMaxTrianglesWithoutBvh;
  }

  const StageInputs& stage_;
  const PairTasks& work_;
  AccelerationCache& cache_;
  const EvaluatedPairs& evaluated_;
  std::vector<Candidate>& candidates_;
  std::vector<RegionDetail> detail_;
  DetailedRegions found_;
};

}  // namespace

Result<PartRegions> compute_part_regions(const StageInputs& stage, const EvaluatedPairs& evaluated,
                                         std::vector<Candidate>& candidates) {
  auto detail =
      region_detail_of(evaluated, stage.objects, stage.rules, stage.options, stage.work.context());
  if (!detail) return detail.error();
  // Where two pairs of objects need an equal pair of parts in different detail, it is done for
  // each.
  std::vector<RegionDetail> several(candidates.size(), RegionDetail::whole), each = several;
  for (std::size_t i = 0; i < detail->size(); ++i) {
    const std::uint32_t unique = evaluated.unique_pairs.of[i];
    const RegionDetail own = (*detail)[i];
    RegionDetail& wanted = (own == RegionDetail::if_several ? several : each)[unique];
    wanted = std::max(wanted, own);
  }
  auto at_one = RegionStage(stage, evaluated, candidates, std::move(several)).run();
  if (!at_one) return at_one.error();
  auto at_each = RegionStage(stage, evaluated, candidates, std::move(each)).run();
  if (!at_each) return at_each.error();
  return PartRegions(std::move(*detail), std::move(*at_one), std::move(*at_each));
}

}  // namespace strake::clash
