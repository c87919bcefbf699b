// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {

/// Returns a result of the contents.
[[nodiscard]] inline const clash::Pair& pair_of(const ClashContents& contents,
                                                const clash::ResultRef& result) {
  return contents.findings.tests[result.test].pairs[result.pair];
}

/// Returns the decision about a result; null where there is none.
[[nodiscard]] inline const DecidedResult* decision_about(const ClashContents& contents,
                                                     std::size_t test, const clash::Pair& pair) {
  return contents.decided == nullptr ? nullptr : contents.decided->of(test, pair);
}
[[nodiscard]] inline const DecidedResult* decision_about(const ClashContents& contents,
                                                     const clash::ResultRef& result) {
  return decision_about(contents, result.test, pair_of(contents, result));
}

}  // namespace strake::report
