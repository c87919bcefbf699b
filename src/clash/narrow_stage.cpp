// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_stage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "clash/curves.hpp"
#include "clash/narrow.hpp"
#include "clash/pair_limits.hpp"
#include "clash/spheres.hpp"

namespace strake::clash {
namespace {

bool is_too_large(const PartRef& a, const PartRef& b) {
  return !geometry::fits_pair(a.placed, b.placed);
}

class ExactStage {
 public:
  ExactStage(const Stage& stage, const Judged& judged, std::vector<Candidate>& candidates)
      : stage_(stage),
        work_(stage.work),
        aids_(stage.aids),
        judged_(judged),
        candidates_(candidates) {}

  Status run() {
    if (const Status s = settle_simple_pairs(); !s) return s;
    if (const Status s = part_distant_pairs(); !s) return s;
    if (const Status s = first_look(); !s) return s;
    if (const Status s = depths(); !s) return s;
    return distances();
  }

 private:
  /// Closed forms, and contacts in coordinate planes, which are most of them, need no trees.
  Status settle_simple_pairs() {
    return parallel::for_each(
        work_.context(), {.name = "simple pairs", .n = work_.size(), .grain = CaseWork::kGrain},
        [&](std::size_t i) {
          const PartRef &a = work_.a(i), &b = work_.b(i);
          Candidate& c = candidates_[i];
          c.too_large = is_too_large(a, b);
          if (c.too_large) return;
          if (has_wire(*a.placed.part, *b.placed.part)) return;
          const NarrowPart x = aids_.bare(a), y = aids_.bare(b);
          const NarrowOptions options = stage_.pair_options.of(a, b);
          auto answer = judge_analytic(x, y, options);
          if (!answer) answer = judge_flush(x, y, options, c.known.separated);
          c.done = answer.has_value();
          if (c.done) c.look.answer = *answer;
        });
  }

  [[nodiscard]] Result<std::vector<std::size_t>> open_cases(std::string_view name) const {
    return work_.that(
        name, [&](std::size_t i) { return !candidates_[i].done && !candidates_[i].too_large; });
  }

  /// Boxes along the coordinate axes of what stands askew meet far more often than the bodies do.
  Status part_distant_pairs() {
    const auto unsettled = open_cases("unsettled pairs");
    if (!unsettled) return unsettled.error();
    if (const Status s = aids_.want_frames(work_.parts_of(*unsettled), work_.context()); !s)
      return s;
    const Status status =
        work_.over(*unsettled, "parting planes", CaseWork::kGrain,
                   [&](std::size_t i, const PartRef& a, const PartRef& b) {
                     const NarrowOptions options = stage_.pair_options.of(a, b);
                     Candidate& c = candidates_[i];
                     const NarrowPart x = aids_.framed(a), y = aids_.framed(b);
                     const geometry::PartingGap gap = gap_between(x, y, options);
                     c.known.gap = gap;
                     c.done = gap.lower >= parting_gap(*a.placed.part, *b.placed.part, options);
                     if (c.done || has_wire(*a.placed.part, *b.placed.part)) return;
                     const auto flush = charged(c, work_.context(), [&](NarrowWork& work) {
                       return judge_flush_askew(x, y, options, gap, c.known.flush_asked, work);
                     });
                     c.done = flush.has_value();
                     if (flush) c.look.answer = *flush;
                   });
    if (!status) return status;
    auto open = open_cases("open pairs");
    if (!open) return open.error();
    open_ = std::move(*open);
    return {};
  }

  Status first_look() {
    if (const Status s = aids_.want_trees(work_.parts_of(open_), work_.context()); !s) return s;
    return work_.over(open_, "narrow phase", CaseWork::kGrain,
                      [&](std::size_t i, const PartRef& a, const PartRef& b) {
                        Candidate& c = candidates_[i];
                        const NarrowPart x = aids_.treed(a), y = aids_.treed(b);
                        const NarrowOptions options = stage_.pair_options.of(a, b);
                        c.look = charged(c, work_.context(), [&](NarrowWork& work) {
                          if (!has_wire(*a.placed.part, *b.placed.part))
                            return look_at(x, y, options, c.known, work);
                          FirstLook look;
                          look.answer = judge_wire(x, y, options, work);
                          return look;
                        });
                      });
  }

  Status depths() {
    std::vector<std::size_t> deep;
    for (const std::size_t i : open_)
      if (candidates_[i].look.next == FirstLook::Next::depth) deep.push_back(i);
    if (const Status s = aids_.want_planes(work_.parts_of(deep), work_.context()); !s) return s;
    return work_.over(deep, "depth", 1, [&](std::size_t i, const PartRef& a, const PartRef& b) {
      Candidate& c = candidates_[i];
      c.look.answer = charged(c, work_.context(), [&](NarrowWork& work) {
        return judge_depth(aids_.planed(a), aids_.planed(b), c.look, c.known,
                           stage_.pair_options.of(a, b), work);
      });
    });
  }

  /// A case whose distance may show in the answer of a pair of objects, as far as `far`.
  struct Wanted {
    std::uint32_t number = 0;
    double far = 0;
  };

  /// How far apart the others are; where two objects meet, only as far as it could matter.
  Status distances() {
    const auto wanted = parallel::collect<Wanted>(
        work_.context(),
        {.name = "distances wanted", .n = stage_.objects.size(), .grain = CaseWork::kBlock},
        [&](std::size_t k, std::vector<Wanted>& out) { want_distances(k, out); });
    if (!wanted) return wanted.error();
    std::vector<double> reach(candidates_.size(), 0);
    for (const Wanted& w : *wanted) reach[w.number] = std::max(reach[w.number], w.far);
    std::vector<std::size_t> apart;
    for (std::size_t i = 0; i < reach.size(); ++i)
      if (reach[i] > 0) apart.push_back(i);
    return work_.over(apart, "distance", CaseWork::kGrain,
                      [&](std::size_t i, const PartRef& a, const PartRef& b) {
                        Candidate& c = candidates_[i];
                        c.look.answer = charged(c, work_.context(), [&](NarrowWork& work) {
                          return judge_distance(aids_.treed(a), aids_.treed(b),
                                                stage_.pair_options.of(a, b), reach[i], work);
                        });
                      });
  }

  /// How far the distances of one pair of objects' parts may show in its answer. Parts that meet
  /// are more severe than parts that are apart, unless the sag of those hides that they meet too.
  /// Whether regions are listed makes no difference: the answer is the same without them.
  void want_distances(std::size_t objects, std::vector<Wanted>& wanted) const {
    const std::size_t first = stage_.objects.begin(objects), end = stage_.objects.end(objects);
    bool meeting = false;
    // Where a rule may allow the worst of them, every other one counts.
    const bool all = stage_.rules.may_allow(judged_.a(first).object, judged_.b(first).object);
    for (std::size_t i = first; i < end && !all; ++i) {
      const PartAnswer& answer = judged_.of(i).look.answer;
      meeting = meeting || answer.judgement.cls == Class::hit ||
                (answer.judgement.cls >= Class::contact && answer.separation.d <= 0);
    }
    for (std::size_t i = first; i < end; ++i) {
      if (judged_.of(i).look.next != FirstLook::Next::distance) continue;
      double far = std::numeric_limits<double>::infinity();
      if (meeting) {
        const PartRef &a = judged_.a(i), &b = judged_.b(i);
        const double sag = a.placed.part->sag + b.placed.part->sag;
        // As near as that it may be a contact elsewhere, or as deep as what is worst.
        const NarrowOptions options = stage_.pair_options.of(a, b);
        far = sag + std::max(options.touch_gap, options.step) + kSnapReach;
      }
      wanted.push_back({judged_.cases.of[i], far});
    }
  }

  const Stage& stage_;
  const CaseWork& work_;
  PartAids& aids_;
  const Judged& judged_;
  std::vector<Candidate>& candidates_;
  std::vector<std::size_t> open_;  ///< cases that want trees
};

}  // namespace

Status judge_exactly(const Stage& stage, const Judged& judged, std::vector<Candidate>& candidates) {
  return ExactStage(stage, judged, candidates).run();
}

Status judge_by_spheres(const Stage& stage, std::vector<Candidate>& candidates) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].too_large = is_too_large(stage.work.a(i), stage.work.b(i));
    if (!candidates[i].too_large) open.push_back(i);
  }
  const Status planted = stage.aids.want_trees(stage.work.parts_of(open), stage.work.context());
  if (!planted) return planted;
  return stage.work.over(
      open, "sphere subdivision", 1, [&](std::size_t i, const PartRef& a, const PartRef& b) {
        Candidate& c = candidates[i];
        c.look.answer = charged(c, stage.work.context(), [&](NarrowWork& work) {
          return judge_spheres(stage.aids.treed(a), stage.aids.treed(b),
                               stage.pair_options.of(a, b), stage.options.most_spheres, work);
        });
      });
}

}  // namespace strake::clash
