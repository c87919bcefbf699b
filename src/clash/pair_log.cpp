// SPDX-License-Identifier: Apache-2.0
#include "clash/pair_log.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

constexpr std::size_t kGrain = 4096;

/// What one pair of objects cost; an earlier pair of parts may have been the same question as one
/// of theirs, which then took no work of its own.
LoggedPair logged(const Judged& judged, std::size_t begin, std::size_t end,
                  const PairRules& rules) {
  LoggedPair pair;
  pair.a = model::ObjectId{judged.a(begin).object};
  pair.b = model::ObjectId{judged.b(begin).object};
  pair.may_be_allowed = rules.may_allow(index(pair.a), index(pair.b));
  for (std::size_t i = begin; i < end; ++i) {
    const NarrowCost& cost = judged.of(i).cost;
    ++pair.part_pairs;
    if (judged.cases.first[judged.cases.of[i]] != i) ++pair.repeated_part_pairs;
    pair.node_pairs += cost.pair.node_pairs;
    pair.triangle_pairs += cost.pair.triangle_pairs;
    pair.exact_fallbacks += cost.pair.exact_fallbacks;
    pair.depth_cells += cost.depth_cells;
  }
  return pair;
}

/// Sets the classes of some logged pairs. Both lists are by objects.
void set_classes(std::span<LoggedPair> log, const std::vector<Pair>& pairs) {
  const auto before = [](const auto& x, const auto& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  };
  auto at = std::lower_bound(pairs.begin(), pairs.end(), log.front(), before);
  for (LoggedPair& logged : log) {
    while (at != pairs.end() && before(*at, logged)) ++at;
    if (at != pairs.end() && !before(logged, *at)) logged.cls = at->cls;
  }
}

}  // namespace

Status log_pairs(const Judged& judged, const ObjectPairs& objects, const PairRules& rules,
                 const parallel::Context& context, Report& report) {
  auto log = parallel::transform(
      context, {.name = "log of pairs", .n = objects.size(), .grain = kGrain},
      [&](std::size_t k) { return logged(judged, objects.begin(k), objects.end(k), rules); });
  if (!log) return log.error();
  const parallel::Region pieces{.n = log->size(), .grain = kGrain};
  const Status status = parallel::for_each(
      context, {.name = "classes in the log", .n = pieces.blocks()}, [&](std::size_t piece) {
        const std::size_t first = piece * kGrain;
        set_classes(std::span(*log).subspan(first, std::min(kGrain, log->size() - first)),
                    report.pairs);
      });
  if (!status) return status.error();
  report.log = std::move(*log);
  return {};
}

}  // namespace strake::clash
