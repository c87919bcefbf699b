// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/record.hpp"
#include "strake/core/result.hpp"

// Decision 0064 says why the same contender takes part twice, and why results are compared by
// bytes.
namespace strake::cli {

/// Runs the contenders of a stage in turn, round after round: what else the machine does hits all
/// alike. There are at least `settings.repeat` rounds, and up to three times as many while the two
/// sequential contenders, which do the same, differ by more than 2 %. Results are compared with
/// that of the first contender: their hashes in every round, what is published in the first.
/// `narrate` receives what runs. Errors: those of a contender that must have a result; cancelled.
[[nodiscard]] Result<StageRecord> measure_stage(
    std::string name, const std::vector<Contender>& contenders, const EvaluationSettings& settings,
    const std::stop_token& stop, const std::function<void(const std::string&)>& narrate);

}  // namespace strake::cli
