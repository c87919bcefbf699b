// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Rules that do nothing, and whether that is because earlier ones have done it. Both functions
/// need the counts of the report and follow from lists of pairs alone; errors: cancelled.
namespace strake::clash {

/// Fills Exempted::shadowed_by; `exempted` has every pair of objects that was exempted, once for
/// each rule that took parts of it.
[[nodiscard]] Status record_shadowed_exemptions(const Policy& policy,
                                                std::span<const ExemptedPair> exempted,
                                                const parallel::Context& context, Report& report);

/// Fills AllowedCount::shadowed_by by some of the report's results.
[[nodiscard]] Status record_shadowed_allowances(const Policy& policy, std::span<const Pair> pairs,
                                                const parallel::Context& context, Report& report);

}  // namespace strake::clash
