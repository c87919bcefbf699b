// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/candidate.hpp"
#include "clash/object_pairs.hpp"
#include "clash/pair_rules.hpp"

namespace strake::clash {

/// Report::log; the classes are those of the report's pairs, and what it does not hold is NO_HIT.
/// Errors: cancelled.
[[nodiscard]] Status log_pairs(const Judged& judged, const ObjectPairs& objects,
                               const PairRules& rules, const parallel::Context& context,
                               Report& report);

}  // namespace strake::clash
