// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/evaluate/statistics.hpp"

namespace strake::cli {

namespace {

constexpr double kMoreWork = 0.01, kSlower = 0.15;

/// Returns the change as text: "+12.5 %".
std::string change(double before, double now) {
  return before > 0 ? fmt::format("{:+.1f} %", 100 * (now / before - 1)) : "new";
}

void compare_counters(const std::string& where, const ContenderRecord& before,
                      const ContenderRecord& now, Comparison& result) {
  for (const auto& [name, old_value] : before.counters) {
    const auto found = now.counters.find(name);
    if (found == now.counters.end()) {
      result.missing.push_back(where + ": " + name);
      continue;
    }
    ++result.compared;
    const auto was = static_cast<double>(old_value), is = static_cast<double>(found->second);
    const std::string line =
        fmt::format("{}: {} {} -> {} ({})", where, name, old_value, found->second, change(was, is));
    if (is > was * (1 + kMoreWork)) result.more_work.push_back(line);
    if (is < was * (1 - kMoreWork)) result.less_work.push_back(line);
  }
}

void compare_times(const std::string& where, const StageRecord& before, const StageRecord& now,
                   Comparison& result) {
  const ContenderRecord* const was = find_contender(before, kSequential, 1);
  const ContenderRecord* const is = find_contender(now, kSequential, 1);
  if (was == nullptr || is == nullptr || before.reference_s <= 0 || now.reference_s <= 0) return;
  const double old_ratio = median(was->seconds) / before.reference_s;
  const double ratio = median(is->seconds) / now.reference_s;
  if (ratio > old_ratio * (1 + kSlower + timing_noise(before) + timing_noise(now)))
    result.slower.push_back(fmt::format("{}: {:.1f} -> {:.1f} times the reference kernel ({})",
                                        where, old_ratio, ratio, change(old_ratio, ratio)));
}

}  // namespace

Status check_comparable(const EvaluationSettings& before, const EvaluationSettings& now) {
  if (before.scale == now.scale) return {};
  return Error{ErrorCode::usage,
               fmt::format("it was made at scale {:g}, this one at {:g}: their ships differ",
                           before.scale, now.scale),
               "--compare", fmt::format("give --scale {:g}", before.scale)};
}

Result<Comparison> compare_evaluations(const EvaluationRecord& before,
                                       const EvaluationRecord& now) {
  if (const Status status = check_comparable(before.settings, now.settings); !status)
    return status.error();
  Comparison result;
  for (const CaseRecord& old_case : before.cases) {
    const auto one = std::ranges::find(now.cases, old_case.name, &CaseRecord::name);
    if (one == now.cases.end()) {
      result.missing.push_back(old_case.name);
      continue;
    }
    for (const StageRecord& old_stage : old_case.stages) {
      const auto stage = std::ranges::find(one->stages, old_stage.name, &StageRecord::name);
      const std::string where = old_case.name + ", " + old_stage.name;
      if (stage == one->stages.end()) {
        result.missing.push_back(where);
        continue;
      }
      const ContenderRecord* const was = find_contender(old_stage, kSequential, 1);
      const ContenderRecord* const is = find_contender(*stage, kSequential, 1);
      if (was != nullptr && is != nullptr) {
        compare_counters(where, *was, *is, result);
        if (was->hash != is->hash || was->published_hash != is->published_hash)
          result.other_results.push_back(where);
      }
      compare_times(where, old_stage, *stage, result);
    }
  }
  return result;
}

}  // namespace strake::cli
