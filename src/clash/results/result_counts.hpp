// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0020 says what counts as not compared, and which of it stops a run.

#include <cstdint>
#include <span>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/rules/rule_matcher.hpp"

/// What is counted and logged over the results of a test.
namespace strake::clash {

/// Fills Report::not_compared: the objects of the sets that lack geometry, the pairs that are too
/// large and those of which one lies within the other's open surface, unless they hit otherwise;
/// messages of these codes tell of both. Errors here and below: cancelled.
[[nodiscard]] Status record_not_compared(const EvaluatedPairs& evaluated,
                                         const ObjectPairs& objects, const model::Scene& scene,
                                         const parallel::Context& context, Report& report);

/// Adds the messages about pairs in Report::not_compared.
void report_not_compared(const model::Model& model, Report& report);

/// Fills Report::sheets. Errors: cancelled.
[[nodiscard]] Status count_sheets(const ScenePartList& list, const parallel::Context& context,
                                  Report& report);

/// Returns an entry for each file: other than 0 where it has parts of unknown sag.
[[nodiscard]] Result<std::vector<std::uint8_t>> files_of_unknown_sag(
    const ScenePartList& list, const model::Model& model, const parallel::Context& context);

/// Adds "unknown-sag" for each of these files.
void report_unknown_sag(std::span<const std::uint8_t> by_file, const model::Model& model,
                        Diagnostics& diagnostics);

/// Fills Report::counters, and the candidates of each rule.
[[nodiscard]] Status fill_counters(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                                   const RuleMatcher& rules, const parallel::Context& context,
                                   Report& report);

/// Fills Report::log; the classes are those of the report's pairs, and what it does not hold is
/// NO_HIT. Errors: cancelled.
[[nodiscard]] Status log_pairs(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                               const RuleMatcher& rules, const parallel::Context& context,
                               Report& report);

}  // namespace strake::clash
