// SPDX-License-Identifier: Apache-2.0
#include "project/results/match_reports.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace strake::project {
namespace {

using clash::Pair;

/// A result of the earlier run by the numbers that its objects have now.
struct FormerPair {
  std::uint32_t a = 0, b = 0;
  std::size_t at = 0;
};

auto objects_of(const FormerPair& p) { return std::pair(p.a, p.b); }

/// Returns the objects of one state by their numbers in the other, whatever else changed about
/// them.
Result<std::vector<std::uint32_t>> same_objects(const Snapshot& then, const Snapshot& now,
                                                const parallel::Context& context) {
  if (then.identities == now.identities) {
    std::vector<std::uint32_t> same(then.identities.size());
    std::iota(same.begin(), same.end(), 0U);
    return same;
  }
  const auto nameless = [](const Snapshot& state) {
    return Snapshot{{}, state.identities, std::vector<Hash128>(state.identities.size())};
  };
  return unchanged(nameless(then), nameless(now), context);
}

/// Returns the results of the earlier run in the order of objects now; those with an object that
/// is gone go to `different`.
std::vector<FormerPair> former_pairs(const std::vector<Pair>& pairs, ReportMatch& match) {
  std::vector<FormerPair> former;
  former.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = match.now_of[index(pairs[i].a)], b = match.now_of[index(pairs[i].b)];
    if (a == model::kNoObject || b == model::kNoObject)
      match.different.push_back({i, std::nullopt});
    else
      former.push_back({std::min(a, b), std::max(a, b), i});
  }
  if (!std::ranges::is_sorted(former, {}, objects_of)) std::ranges::sort(former, {}, objects_of);
  return former;
}

auto measures(const Pair& p) {
  return std::tie(p.cls, p.relation, p.d_mm, p.point_mm, p.regions, p.severest);
}

/// The rule that allows a pair, whatever its number.
std::string_view rule_of(const clash::Report& report, const Pair& pair) {
  return pair.allowed < 0
             ? std::string_view()
             : std::string_view(report.allowed[static_cast<std::size_t>(pair.allowed)].rule);
}

}  // namespace

Result<ReportMatch> match_reports(const StoredTest& before, const Snapshot& now,
                                  const clash::Report& report, const parallel::Context& context) {
  ReportMatch match;
  Result<std::vector<std::uint32_t>> now_of = same_objects(before.snapshot, now, context);
  if (!now_of) return now_of.error();
  match.now_of = std::move(*now_of);
  match.before_of.assign(now.identities.size(), model::kNoObject);
  for (std::uint32_t o = 0; o < match.now_of.size(); ++o)
    if (match.now_of[o] != model::kNoObject) match.before_of[match.now_of[o]] = o;
  match.rows.assign(report.pairs.size(), 0);
  const clash::Report& earlier = before.results.report;
  const std::vector<FormerPair> former = former_pairs(earlier.pairs, match);
  auto at = former.begin();
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    const Pair& pair = report.pairs[i];
    const std::pair sought(index(pair.a), index(pair.b));
    for (; at != former.end() && objects_of(*at) < sought; ++at)
      match.different.push_back({at->at, std::nullopt});
    if (at == former.end() || objects_of(*at) != sought) {
      match.different.push_back({std::nullopt, i});
      continue;
    }
    const Pair& was = earlier.pairs[at->at];
    match.rows[i] = before.results.rows[at->at];
    if (measures(was) != measures(pair) || rule_of(earlier, was) != rule_of(report, pair))
      match.different.push_back({at->at, i});
    ++at;
  }
  for (; at != former.end(); ++at) match.different.push_back({at->at, std::nullopt});
  return match;
}

}  // namespace strake::project
