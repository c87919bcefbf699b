// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/overlaps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "clash/case_work.hpp"
#include "clash/object_pairs.hpp"
#include "clash/options.hpp"
#include "clash/part_aids.hpp"
#include "strake/geometry/flush_contact.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::clash {
namespace {

enum class State : std::uint8_t { apart, common, open };

/// What becomes of the near pairs of parts: what needs no tree first, and of the others only what
/// their own boxes leave open.
class Overlaps {
 public:
  Overlaps(const PartList& list, const std::vector<geometry::IndexPair>& pairs,
           const model::Model& model, const parallel::Context& context)
      : cases_(each_alone(pairs.size())),
        work_(list, pairs, cases_, context),
        aids_(list, model),
        states_(pairs.size(), State::open) {}

  /// By pair, none of them open. Errors: cancelled.
  Result<std::vector<State>> run() {
    if (const Status s = decide_flush(); !s) return s.error();
    if (const Status s = decide_framed(); !s) return s.error();
    if (const Status s = decide_exactly(); !s) return s.error();
    return std::move(states_);
  }

 private:
  Status decide_flush() {
    return parallel::for_each(
        work_.context(), {.name = "flush pairs", .n = work_.size(), .grain = CaseWork::kGrain},
        [&](std::size_t i) {
          const geometry::PlacedPart &x = work_.a(i).placed, &y = work_.b(i).placed;
          if (!geometry::fits_pair(x, y))
            states_[i] = State::apart;
          else if (geometry::flush_contact(x, y).touching)
            states_[i] = State::common;
        });
  }

  Status decide_framed() {
    const auto open = find_open();
    if (!open) return open.error();
    if (const Status s = aids_.want_frames(work_.parts_of(*open), work_.context()); !s) return s;
    return decide(*open, "parting planes", [&](const PartRef& x, const PartRef& y) {
      const NarrowPart p = aids_.framed(x), q = aids_.framed(y);
      constexpr double kApart = 1;  // as the broad phase's boxes leave it: whole units
      const double gap =
          geometry::frame_gap({p.treed.placed, p.frame}, {q.treed.placed, q.frame}, kApart).lower;
      return gap >= kApart ? State::apart : State::open;
    });
  }

  Status decide_exactly() {
    const auto open = find_open();
    if (!open) return open.error();
    if (const Status s = aids_.want_trees(work_.parts_of(*open), work_.context()); !s) return s;
    return decide(*open, "overlaps", [&](const PartRef& x, const PartRef& y) {
      geometry::PairWork work;
      const auto met = geometry::meet(aids_.treed(x).treed, aids_.treed(y).treed, work);
      return met.meeting == geometry::Meeting::apart ? State::apart : State::common;
    });
  }

  [[nodiscard]] Result<std::vector<std::size_t>> find_open() const {
    return work_.that("open pairs", [&](std::size_t i) { return states_[i] == State::open; });
  }

  template <class Judge>
  Status decide(std::span<const std::size_t> some, std::string_view name, const Judge& judge) {
    return work_.over(
        some, name, CaseWork::kGrain,
        [&](std::size_t i, const PartRef& x, const PartRef& y) { states_[i] = judge(x, y); });
  }

  Cases cases_;
  CaseWork work_;
  PartAids aids_;
  std::vector<State> states_;  ///< by pair
};

Result<std::vector<ObjectPair>> by_objects(const std::vector<State>& states, const PartList& list,
                                           const std::vector<geometry::IndexPair>& pairs,
                                           const parallel::Context& context) {
  const auto objects = ObjectPairs::find(pairs, list, context);
  if (!objects) return objects.error();
  return parallel::collect<ObjectPair>(
      context, {.name = "overlapping objects", .n = objects->size(), .grain = CaseWork::kBlock},
      [&](std::size_t k, std::vector<ObjectPair>& out) {
        const auto first = states.begin() + static_cast<std::ptrdiff_t>(objects->begin(k));
        const auto last = states.begin() + static_cast<std::ptrdiff_t>(objects->end(k));
        if (std::find(first, last, State::common) == last) return;
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
  const auto list = list_parts(scene, sets, Curves::off, context);
  if (!list) return list.error();
  const auto pairs = near_pairs(*list, sets, 0, options, context);
  if (!pairs) return pairs.error();
  const auto states = Overlaps(*list, *pairs, *scene.model, context).run();
  if (!states) return states.error();
  return by_objects(*states, *list, *pairs, context);
}

}  // namespace strake::clash
