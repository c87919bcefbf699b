// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rules/rule_context.hpp"
#include "rules/rule_file.hpp"
#include "strake/clash/policy.hpp"

namespace strake::rules {

/// Returns what a rule that exempts says of each object, with a warning where it says nothing of
/// any.
[[nodiscard]] clash::Exemption exemption_of(const ExemptingRule& rule, RuleContext& rule_context);

}  // namespace strake::rules
