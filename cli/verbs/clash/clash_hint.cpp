// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_hint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/assemblies.hpp"
#include "strake/clash/group.hpp"

namespace strake::cli {

namespace {

constexpr std::uint64_t kLeastHits = 20;

/// Whether all results of a group by assembly lie within one: so its name begins.
bool is_within(const clash::Group& group) { return group.name.starts_with("within "); }

/// Returns the hint about the pair of assemblies with most hits, if it has a quarter of all.
std::string hint_of_one(const std::vector<clash::Group>& groups, std::uint64_t hits) {
  constexpr std::uint64_t kLeastPart = 4;
  const clash::Group& most = *std::ranges::max_element(groups, {}, &clash::Group::count_hit);
  if (most.count_hit * kLeastPart < hits) return {};
  return fmt::format("{} of {} hits lie {}{}: --group-by assembly makes them one line",
                     most.count_hit, hits, is_within(most) ? "" : "between ", most.name);
}

/// Returns the hint about hits between parts of one equipment, if they are half of all.
/// `from_aveva`: the profile knows what the assemblies are.
std::string hint_of_parts(const std::vector<clash::Group>& groups, std::uint64_t hits,
                          bool from_aveva) {
  constexpr std::uint64_t kLeastPart = 2;
  std::uint64_t within = 0;
  for (const clash::Group& group : groups)
    if (is_within(group)) within += group.count_hit;
  if (within * kLeastPart < hits) return {};
  return fmt::format(
      "{} of {} hits lie between parts of one assembly: --group-by assembly has a line for each; "
      "{}[[same_assembly]] of a rules file leaves them out",
      within, hits, from_aveva ? "--profile plant or " : "");
}

}  // namespace

std::string concentration_hint(const clash::Findings& findings, const model::Model& model) {
  std::uint64_t hits = 0;
  for (const clash::Report& test : findings.tests) hits += test.count_hit;
  if (hits < kLeastHits) return {};
  const Result<clash::Grouping> grouping =
      clash::group_results(findings, model, {.by = clash::GroupBy::assembly});
  if (!grouping || grouping->groups.empty()) return {};
  const std::string within =
      hint_of_parts(grouping->groups, hits, !model::Assemblies(model).empty());
  return within.empty() ? hint_of_one(grouping->groups, hits) : within;
}

}  // namespace strake::cli
