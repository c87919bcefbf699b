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
std::vector<FormerPair> former_pairs(const RememberedReport& results,
                                     std::span<const std::uint32_t> now_of, ReportMatch& match) {
  const std::vector<Pair>& pairs = results.report.pairs;
  std::vector<FormerPair> former;
  former.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t a = now_of[index(pairs[i].a)], b = now_of[index(pairs[i].b)];
    if (a == model::kNoObject || b == model::kNoObject)
      match.different.push_back({FormerResult{&pairs[i], results.rows[i]}, std::nullopt});
    else
      former.push_back({std::min(a, b), std::max(a, b), i});
  }
  if (!std::ranges::is_sorted(former, {}, objects_of)) std::ranges::sort(former, {}, objects_of);
  return former;
}

auto objects_of(const Pair& p) { return std::pair(p.a, p.b); }

auto measures(const Pair& p) {
  return std::tie(p.cls, p.relation, p.d_mm, p.point_mm, p.regions, p.severest);
}

/// The rule that allows a pair, whatever its number.
std::string_view rule_of(const clash::Report& report, const Pair& pair) {
  return pair.allowed < 0
             ? std::string_view()
             : std::string_view(report.allowed[static_cast<std::size_t>(pair.allowed)].rule);
}

/// Whether rows of clashes say the same of two results of one pair.
bool is_same_measure(const clash::Report& earlier, const Pair& was, const clash::Report& report,
                     const Pair& is) {
  return measures(was) == measures(is) && rule_of(earlier, was) == rule_of(report, is);
}

/// Returns the rows of the results that stayed, in their places among so many; 0 for what was put
/// in.
std::vector<std::int64_t> rows_of_now(const std::vector<std::int64_t>& rows,
                                      const clash::PairChanges& changes, std::size_t results) {
  std::vector<std::int64_t> now;
  now.reserve(results);
  std::size_t from = 0, gone = 0;
  const auto copy_until = [&](std::size_t place) {
    while (now.size() < place) {
      const std::size_t next =
          gone < changes.gone_from.size() ? changes.gone_from[gone] : rows.size();
      const std::size_t last = std::min(next, from + (place - now.size()));
      now.insert(now.end(), rows.begin() + static_cast<std::ptrdiff_t>(from),
                 rows.begin() + static_cast<std::ptrdiff_t>(last));
      from = last;
      if (from == next && gone < changes.gone_from.size()) {
        ++gone;
        ++from;
      }
    }
  };
  for (const std::size_t place : changes.put_in) {
    copy_until(place);
    now.push_back(0);
  }
  copy_until(results);
  return now;
}

}  // namespace

Result<ReportMatch> match_reports(const StoredTest& before, const Snapshot& now,
                                  const clash::Report& report, const parallel::Context& context) {
  ReportMatch match;
  const Result<std::vector<std::uint32_t>> now_of = same_objects(before.snapshot, now, context);
  if (!now_of) return now_of.error();
  match.rows.assign(report.pairs.size(), 0);
  const clash::Report& earlier = before.results.report;
  const std::vector<FormerPair> former = former_pairs(before.results, *now_of, match);
  const auto former_result = [&](const FormerPair& p) {
    return FormerResult{&earlier.pairs[p.at], before.results.rows[p.at]};
  };
  auto at = former.begin();
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    const Pair& pair = report.pairs[i];
    const std::pair sought(index(pair.a), index(pair.b));
    for (; at != former.end() && objects_of(*at) < sought; ++at)
      match.different.push_back({former_result(*at), std::nullopt});
    if (at == former.end() || objects_of(*at) != sought) {
      match.different.push_back({std::nullopt, i});
      continue;
    }
    const FormerResult was = former_result(*at);
    match.rows[i] = was.row;
    if (!is_same_measure(earlier, *was.pair, report, pair)) match.different.push_back({was, i});
    ++at;
  }
  for (; at != former.end(); ++at) match.different.push_back({former_result(*at), std::nullopt});
  return match;
}

Result<ReportMatch> match_changes(const StoredTest& before, const clash::PairChanges& changes,
                                  const clash::Report& report) {
  const std::vector<std::int64_t>& rows = before.results.rows;
  if (report.pairs.size() + changes.gone.size() != rows.size() + changes.put_in.size())
    return Error{ErrorCode::internal, "a run follows other results than those stored", {}, {}};
  ReportMatch match;
  match.rows = rows_of_now(rows, changes, report.pairs.size());
  std::size_t gone = 0, put_in = 0;
  while (gone < changes.gone.size() || put_in < changes.put_in.size()) {
    const Pair* const was = gone < changes.gone.size() ? &changes.gone[gone] : nullptr;
    const Pair* const is =
        put_in < changes.put_in.size() ? &report.pairs[changes.put_in[put_in]] : nullptr;
    const bool has_former =
                   is == nullptr || (was != nullptr && objects_of(*was) <= objects_of(*is)),
               has_now = was == nullptr || (is != nullptr && objects_of(*is) <= objects_of(*was));
    PairMatch one;
    if (has_former) one.before = FormerResult{was, rows[changes.gone_from[gone++]]};
    if (has_now) one.now = changes.put_in[put_in++];
    if (has_former && has_now) match.rows[*one.now] = one.before->row;
    if (!(has_former && has_now && is_same_measure(before.results.report, *was, report, *is)))
      match.different.push_back(one);
  }
  return match;
}

}  // namespace strake::project
