// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "project/results/clash_queries.hpp"
#include "project/review/decide_if_unchanged.hpp"
#include "strake/core/result.hpp"

namespace strake::serve {

/// What the page asks to be decided: about these clashes, as they were when it saw them.
struct DecisionRequest {
  std::vector<std::string> keys;
  project::ClashDecision decision;  ///< `by` and `at` are left to who takes it
  project::KnownState known;
};

/// Reads the JSON of a request: {"run", "event", "keys", and at least one of "status", "assignee"
/// and "comment"}. Errors: usage for anything else.
[[nodiscard]] Result<DecisionRequest> read_decision_request(std::string_view text);

}  // namespace strake::serve
