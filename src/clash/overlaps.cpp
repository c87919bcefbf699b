// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/overlaps.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "clash/object_pairs.hpp"
#include "clash/options.hpp"
#include "clash/part_aids.hpp"
#include "strake/geometry/flush_contact.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

/// Pairs per block: small enough that a heavy one holds up few others.
constexpr std::size_t kGrain = 8, kBlock = 4096;

enum class State : std::uint8_t { apart, common, open };

State state(bool common) { return common ? State::common : State::apart; }

class Overlaps {
 public:
  Overlaps(const model::Scene& scene, const parallel::Context& context)
      : context_(context), aids_(list_, *scene.model) {}

  Result<std::vector<ObjectPair>> run(const model::Scene& scene, const Sets& sets,
                                      const Options& options) {
    auto parts = list_parts(scene, sets, Curves::off, context_);
    if (!parts) return parts.error();
    list_ = std::move(*parts);
    auto pairs = near_pairs(list_, sets, 0, options, context_);
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    // What needs no tree first, and of the others only what their own boxes leave open.
    if (const Status s = decide_flush(); !s) return s.error();
    if (const Status s = decide_framed(); !s) return s.error();
    if (const Status s = decide_exactly(); !s) return s.error();
    return by_objects();
  }

 private:
  [[nodiscard]] const PartRef& a(std::size_t i) const { return list_.parts[pairs_[i].first]; }
  [[nodiscard]] const PartRef& b(std::size_t i) const { return list_.parts[pairs_[i].second]; }

  Status decide_flush() {
    auto states = parallel::transform(
        context_, {.name = "flush pairs", .n = pairs_.size(), .grain = kGrain}, [&](std::size_t i) {
          const geometry::PlacedPart &x = a(i).placed, &y = b(i).placed;
          if (!geometry::fits_pair(x, y)) return State::apart;
          return geometry::flush_contact(x, y).touching ? State::common : State::open;
        });
    if (!states) return states.error();
    states_ = std::move(*states);
    return {};
  }

  Status decide_framed() {
    if (const Status s = find_open(); !s) return s;
    if (const Status s = aids_.want_frames(open_parts(), context_); !s) return s;
    return for_open("parting planes", [&](const PartRef& x, const PartRef& y) {
      const NarrowPart p = aids_.framed(x), q = aids_.framed(y);
      constexpr double kApart = 1;  // as the broad phase's boxes leave it: whole units
      const double gap =
          geometry::frame_gap({p.treed.placed, p.frame}, {q.treed.placed, q.frame}, kApart);
      return gap >= kApart ? State::apart : State::open;
    });
  }

  Status decide_exactly() {
    if (const Status s = find_open(); !s) return s;
    if (const Status s = aids_.want_trees(open_parts(), context_); !s) return s;
    return for_open("overlaps", [&](const PartRef& x, const PartRef& y) {
      geometry::PairWork work;
      const auto met = geometry::meet(aids_.treed(x).treed, aids_.treed(y).treed, work);
      return state(met.meeting != geometry::Meeting::apart);
    });
  }

  Status find_open() {
    auto open = parallel::collect<std::size_t>(
        context_, {.name = "open pairs", .n = pairs_.size(), .grain = kBlock},
        [&](std::size_t i, std::vector<std::size_t>& out) {
          if (states_[i] == State::open) out.push_back(i);
        });
    if (!open) return open.error();
    open_ = std::move(*open);
    return {};
  }

  [[nodiscard]] std::vector<bool> open_parts() const {
    std::vector<bool> parts(list_.unique.size(), false);
    for (const std::size_t i : open_) parts[a(i).unique] = parts[b(i).unique] = true;
    return parts;
  }

  template <class Decide>
  Status for_open(std::string_view name, Decide&& decide) {
    return parallel::for_each(
        context_, {.name = name, .n = open_.size(), .grain = kGrain},
        [&](std::size_t k) { states_[open_[k]] = decide(a(open_[k]), b(open_[k])); });
  }

  Result<std::vector<ObjectPair>> by_objects() const {
    const auto objects = ObjectPairs::find(pairs_, list_, context_);
    if (!objects) return objects.error();
    return parallel::collect<ObjectPair>(
        context_, {.name = "overlapping objects", .n = objects->size(), .grain = kBlock},
        [&](std::size_t k, std::vector<ObjectPair>& out) {
          for (std::size_t i = objects->begin(k); i < objects->end(k); ++i) {
            if (states_[i] != State::common) continue;
            out.push_back({model::ObjectId{a(i).object}, model::ObjectId{b(i).object}});
            return;
          }
        });
  }

  const parallel::Context& context_;
  PartList list_;
  PartAids aids_;
  std::vector<geometry::IndexPair> pairs_;
  std::vector<State> states_;      ///< by pair
  std::vector<std::size_t> open_;  ///< pairs not decided yet
};

}  // namespace

Result<std::vector<ObjectPair>> overlapping_pairs(const model::Scene& scene, const Sets& sets,
                                                  const Options& options,
                                                  const parallel::Context& context) {
  if (const Status s = check(options, sets, scene.model->objects.size()); !s) return s.error();
  return Overlaps(scene, context).run(scene, sets, options);
}

}  // namespace strake::clash
