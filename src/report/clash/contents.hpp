// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "strake/clash/group.hpp"
#include "strake/model/model.hpp"
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
                                                         std::size_t test,
                                                         const clash::Pair& pair) {
  return contents.decided == nullptr ? nullptr : contents.decided->of(test, pair);
}
[[nodiscard]] inline const DecidedResult* decision_about(const ClashContents& contents,
                                                         const clash::ResultRef& result) {
  return decision_about(contents, result.test, pair_of(contents, result));
}

/// Returns what an object states under a name, itself or by the nearest group above that does;
/// several values of the name with "; " between. Nothing where none states it.
[[nodiscard]] std::optional<std::string> stated_text(const model::Model& model, model::ObjectId id,
                                                     std::string_view attribute);

}  // namespace strake::report
