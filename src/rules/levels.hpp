// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "rules/rule_context.hpp"
#include "rules/rule_file.hpp"
#include "strake/clash/policy.hpp"

namespace strake::rules {

/// Returns what the parts of each object count as, hard, soft, insulation or none, with a warning
/// for what has no effect; nothing where a file does not speak of levels.
[[nodiscard]] std::optional<clash::Levels> levels_of(const RuleFile& rules,
                                                     RuleContext& rule_context);

}  // namespace strake::rules
