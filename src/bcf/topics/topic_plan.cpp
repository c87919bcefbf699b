// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/topic_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "report/clash/contents.hpp"
#include "strake/report/decisions.hpp"

namespace strake::bcf {
namespace {

using clash::ResultRef;

/// Whether somebody wrote into the decision about a result.
bool is_decided(const report::DecidedResult* decided) {
  if (decided == nullptr) return false;
  const report::Decision& decision = *decided->decision;
  return decision.status > report::DecisionStatus::active || !decision.by.empty() ||
         !decision.comment.empty() || !decision.assignee.empty();
}

/// The order of results: less comes first.
auto rank(const report::ClashContents& contents, const ResultRef& result) {
  const clash::Pair& pair = pair_of(contents, result);
  const report::DecidedResult* const decided = decision_about(contents, result);
  const bool settled = decided != nullptr && decided->is_settled();
  return std::tuple(settled, -static_cast<int>(pair.cls), pair.d_mm, result.test, result.pair);
}

void sort_by_rank(const report::ClashContents& contents, std::vector<ResultRef>& results) {
  using Rank = decltype(rank(contents, ResultRef{}));
  std::vector<Rank> ranks;
  ranks.reserve(results.size());
  for (const ResultRef& result : results) ranks.push_back(rank(contents, result));
  std::sort(ranks.begin(), ranks.end());
  for (std::size_t i = 0; i < results.size(); ++i)
    results[i] = {std::get<3>(ranks[i]), std::get<4>(ranks[i])};
}

TopicPlan plan_groups(const report::ClashContents& contents) {
  TopicPlan plan;
  const std::vector<clash::Group>& groups = contents.grouping->groups;
  const std::size_t taken = std::min(groups.size(), contents.bcf.max_topics);
  for (std::size_t g = 0; g < taken; ++g) {
    plan.topics.push_back({&groups[g], groups[g].results});
    sort_by_rank(contents, plan.topics.back().results);
  }
  plan.left_out.groups = groups.size() - taken;
  return plan;
}

TopicPlan plan_results(const report::ClashContents& contents) {
  TopicPlan plan;
  std::vector<ResultRef> results;
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const std::vector<clash::Pair>& pairs = contents.findings.tests[t].pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const ResultRef result{static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(p)};
      if (pairs[p].allowed >= 0) continue;
      if (pairs[p].cls == clash::Class::contact && !contents.bcf.contacts &&
          !is_decided(decision_about(contents, result)))
        ++plan.left_out.contacts;
      else
        results.push_back(result);
    }
  }
  sort_by_rank(contents, results);
  const std::size_t taken = std::min(results.size(), contents.bcf.max_topics);
  plan.left_out.results = results.size() - taken;
  for (std::size_t r = 0; r < taken; ++r) plan.topics.push_back({nullptr, {results[r]}});
  return plan;
}

}  // namespace

TopicPlan plan_topics(const report::ClashContents& contents) {
  return contents.grouping != nullptr ? plan_groups(contents) : plan_results(contents);
}

}  // namespace strake::bcf
