// SPDX-License-Identifier: Apache-2.0
#include "clash/place_stage.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "clash/pair_limits.hpp"
#include "clash/telling.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

class PlaceStage {
 public:
  PlaceStage(const Stage& stage, const Judged& judged, std::vector<Candidate>& candidates)
      : stage_(stage),
        work_(stage.work),
        aids_(stage.aids),
        judged_(judged),
        candidates_(candidates),
        places_(candidates.size()) {}

  Result<std::vector<std::vector<PartPlace>>> run() {
    auto telling =
        how_to_tell(judged_, stage_.objects, stage_.rules, stage_.options, work_.context());
    if (!telling) return telling.error();
    telling_ = std::move(*telling);
    std::vector<std::size_t> alone, asking;
    for (std::size_t i = 0; i < telling_.size(); ++i) {
      if (telling_[i] == Telling::if_several) alone.push_back(i);
      if (telling_[i] >= Telling::each) asking.push_back(i);
    }
    if (const auto taken = take_simple(alone); !taken) return taken.error();
    const auto simple = take_simple(asking);
    if (!simple) return simple.error();
    if (const Status s = measure_simple(*simple); !s) return s.error();
    asking.insert(asking.end(), alone.begin(), alone.end());
    if (const Status s = tell(asking); !s) return s.error();
    return std::move(places_);
  }

 private:
  /// Takes those cases out that certainly have one place: where one flat face of each meets, where
  /// one body lies in the other, and of two convex parts.
  Result<std::vector<std::size_t>> take_simple(std::vector<std::size_t>& some) const {
    const auto flat = parallel::transform(
        work_.context(), {.name = "flat places", .n = some.size(), .grain = CaseWork::kGrain},
        [&](std::size_t k) { return static_cast<std::uint8_t>(in_flat_place(some[k])); });
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

  /// A solid that lies in another: a connected body of which every point is common.
  [[nodiscard]] bool is_contained(std::size_t i) const {
    const Relation relation = candidates_[i].look.answer.relation;
    return work_.a(i).placed.part->kind == geometry::PartKind::solid &&
           work_.b(i).placed.part->kind == geometry::PartKind::solid &&
           (relation == Relation::a_in_b || relation == Relation::b_in_a ||
            relation == Relation::abut_inside || relation == Relation::duplicate);
  }

  [[nodiscard]] bool in_flat_place(std::size_t i) const {
    const PartAnswer& answer = candidates_[i].look.answer;
    if (answer.separation.interiors_meet || answer.judgement.cls != Class::contact) return false;
    const PartRef &a = work_.a(i), &b = work_.b(i);
    const NarrowPart x = aids_.framed(a), y = aids_.framed(b);
    const NarrowOptions options = stage_.pair_options.of(a, b);
    double reach = place_reach(x, y, answer, options);
    if (telling_[i] == Telling::all) reach = std::max(reach, reach_of(options));
    return geometry::in_one_flat_place({x.treed.placed, x.frame}, {y.treed.placed, y.frame}, reach);
  }

  /// By unique part, of those that some of the cases are about.
  Result<parallel::Precomputed<std::uint8_t>> convex_parts(
      const std::vector<std::size_t>& some) const {
    // Dents that a place cannot be told by: the touch gap bridges them.
    const double slack = std::max(1.0, stage_.pair_options.least_touch_gap() / 4);
    const auto& unique = judged_.list.unique;
    parallel::Precomputed<std::uint8_t> convex(unique.size());
    const Status status = convex.fill_by_weight(
        work_.context(), {.name = "convex parts"}, CaseWork::kHeavy,
        parallel::keys_of(work_.parts_of(some)),
        [&](std::size_t u) { return unique[u]->triangles.size(); },
        [&](std::size_t u) {
          return static_cast<std::uint8_t>(
              geometry::nearly_convex(*unique[u], slack, work_.context()));
        });
    if (!status) return status.error();
    return convex;
  }

  /// The boxes of cases that have one place.
  Status measure_simple(const std::vector<std::size_t>& some) {
    if (const Status s = aids_.want_frames(work_.parts_of(some), work_.context()); !s) return s;
    return work_.over(
        some, "simple places", CaseWork::kGrain,
        [&](std::size_t i, const PartRef& a, const PartRef& b) {
          const NarrowPart x = aids_.treed(a), y = aids_.treed(b);
          const PartAnswer& answer = candidates_[i].look.answer;
          const double reach = place_reach(x, y, answer, stage_.pair_options.of(a, b));
          places_[i] = {{answer,
                         geometry::common_extent({a.placed, x.frame, x.treed.tree},
                                                 {b.placed, y.frame, y.treed.tree}, reach),
                         true}};
        });
  }

  Status tell(const std::vector<std::size_t>& some) {
    std::vector<std::size_t> treed;
    for (const std::size_t i : some)
      if (wants_trees(i)) treed.push_back(i);
    if (const Status s = aids_.want_trees(work_.parts_of(treed), work_.context()); !s) return s;
    return work_.over(some, "places", 1, [&](std::size_t i, const PartRef& a, const PartRef& b) {
      Candidate& c = candidates_[i];
      auto found = charged(c, work_.context(), [&](NarrowWork& work) {
        return places_of(aids_.planed(a), aids_.planed(b), c.look.answer,
                         stage_.pair_options.of(a, b), telling_[i], work);
      });
      c.too_near_to_tell = !found;
      if (found) places_[i] = std::move(*found);
    });
  }

  /// Small parts that only touch are walked faster than a tree is built.
  [[nodiscard]] bool wants_trees(std::size_t i) const {
    constexpr std::size_t kMostWalked = 512;
    return candidates_[i].look.answer.separation.interiors_meet || work_.triangles(i) > kMostWalked;
  }

  const Stage& stage_;
  const CaseWork& work_;
  PartAids& aids_;
  const Judged& judged_;
  std::vector<Candidate>& candidates_;
  std::vector<Telling> telling_;
  std::vector<std::vector<PartPlace>> places_;
};

}  // namespace

Result<std::vector<std::vector<PartPlace>>> tell_places(const Stage& stage, const Judged& judged,
                                                        std::vector<Candidate>& candidates) {
  return PlaceStage(stage, judged, candidates).run();
}

}  // namespace strake::clash
