// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/overlaps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/rules/options.hpp"
#include "geometry/intersect/coplanar_faces.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::clash {
namespace {

enum class OverlapState : std::uint8_t { apart, common, open };

/// Decides the candidate pairs of parts: first those that need no tree, then of the others only
/// those that their own boxes leave open.
class OverlapSearch {
 public:
  OverlapSearch(const ScenePartList& list, const std::vector<geometry::IndexPair>& pairs,
                const model::Model& model, const parallel::Context& context)
      : unique_pairs_(all_unique(pairs.size())),
        work_(list, pairs, unique_pairs_, context),
        cache_(list, model),
        states_(pairs.size(), OverlapState::open) {}

  /// Returns the state of each pair, none of them open. Errors: cancelled.
  Result<std::vector<OverlapState>> run() {
    if (const Status s = decide_coplanar(); !s) return s.error();
    if (const Status s = decide_framed(); !s) return s.error();
    if (const Status s = decide_exactly(); !s) return s.error();
    return std::move(states_);
  }

 private:
  Status decide_coplanar() {
    return parallel::for_each(
        work_.context(), {.name = "flush pairs", .n = work_.size(), .grain = PairTasks::kGrain},
        [&](std::size_t i) {
          const geometry::PlacedPart &x = work_.a(i).placed, &y = work_.b(i).placed;
          if (!geometry::fits_pair(x, y))
            states_[i] = OverlapState::apart;
          else if (geometry::find_coplanar_contact(x, y).touching)
            states_[i] = OverlapState::common;
        });
  }

  Status decide_framed() {
    const auto open = find_open();
    if (!open) return open.error();
    if (const Status s = cache_.ensure_frames(work_.parts_of(*open), work_.context()); !s) return s;
    return decide(*open, "oriented boxes", [&](const ScenePart& x, const ScenePart& y) {
      const PairOperand p = cache_.framed(x), q = cache_.framed(y);
      constexpr double kApart = 1;  // the broad phase's boxes are in whole units
      const double gap = geometry::oriented_box_separation({p.treed.placed, p.frame},
                                                           {q.treed.placed, q.frame}, kApart)
                             .lower;
      return gap >= kApart ? OverlapState::apart : OverlapState::open;
    });
  }

  Status decide_exactly() {
    const auto open = find_open();
    if (!open) return open.error();
    if (const Status s = cache_.ensure_trees(work_.parts_of(*open), work_.context()); !s) return s;
    return decide(*open, "overlaps", [&](const ScenePart& x, const ScenePart& y) {
      geometry::QueryContext work;
      const auto met = geometry::meet(cache_.treed(x).treed, cache_.treed(y).treed, work);
      return met.meeting == geometry::Meeting::apart ? OverlapState::apart : OverlapState::common;
    });
  }

  [[nodiscard]] Result<std::vector<std::size_t>> find_open() const {
    return work_.filter("open pairs",
                        [&](std::size_t i) { return states_[i] == OverlapState::open; });
  }

  template <class StateOf>
  Status decide(std::span<const std::size_t> subset, std::string_view name,
                const StateOf& state_of) {
    return work_.for_each_of(subset, name, PairTasks::kGrain,
                             [&](std::size_t i, const ScenePart& x, const ScenePart& y) {
                               states_[i] = state_of(x, y);
                             });
  }

  UniquePairs unique_pairs_;
  PairTasks work_;
  AccelerationCache cache_;
  std::vector<OverlapState> states_;  ///< by pair
};

Result<std::vector<ObjectPair>> by_objects(const std::vector<OverlapState>& states,
                                           const ScenePartList& list,
                                           const std::vector<geometry::IndexPair>& pairs,
                                           const parallel::Context& context) {
  const auto objects = ObjectPairs::find(pairs, list, context);
  if (!objects) return objects.error();
  return parallel::collect<ObjectPair>(
      context, {.name = "overlapping objects", .n = objects->size(), .grain = PairTasks::kBlock},
      [&](std::size_t k, std::vector<ObjectPair>& out) {
        const auto first = states.begin() + static_cast<std::ptrdiff_t>(objects->begin(k));
        const auto last = states.begin() + static_cast<std::ptrdiff_t>(objects->end(k));
        if (std::find(first, last, OverlapState::common) == last) return;
        const geometry::IndexPair& pair = pairs[objects->begin(k)];
        out.push_back({model::ObjectId{list.parts[pair.first].object},
                       model::ObjectId{list.parts[pair.second].object}});
      });
}

}  // namespace

Result<std::vector<ObjectPair>> overlapping_pairs(const model::Scene& scene, const Sets& sets,
                                                  const Options& options,
                                                  const parallel::Context& context) {
  if (const Status s = check(options, sets, scene.model->objects.size()); !s) return s.error();
  const auto list = collect_scene_parts(scene, sets, Curves::off, context);
  if (!list) return list.error();
  const auto found = find_candidate_pairs(*list, sets, {}, options, context);
  if (!found) return found.error();
  const auto states = OverlapSearch(*list, found->pairs, *scene.model, context).run();
  if (!states) return states.error();
  return by_objects(*states, *list, found->pairs, context);
}

}  // namespace strake::clash
