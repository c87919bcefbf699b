// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "project/results/clash_queries.hpp"
#include "strake/core/result.hpp"

/// Decisions of people who look at a project for a while, in which others may decide, too.
namespace strake::project {

/// What somebody knows of a project: its last run, and the last change of a status or comment. Both
/// are 0 where there is none yet.
struct KnownState {
  std::int64_t run = 0, event = 0;
  friend bool operator==(const KnownState&, const KnownState&) = default;
};

/// Returns what there is to know now.
[[nodiscard]] Result<KnownState> current_state(Database& database);

/// A clash about which nothing was decided, and why: a whole sentence.
struct RefusedDecision {
  std::string key, why;
};

struct DecideOutcome {
  std::uint64_t changed = 0;  ///< rows, as decide() counts them
  std::vector<RefusedDecision> refused;
  std::vector<std::int64_t> decided;  ///< the rows that the decision is about
};

/// Decides about those of some clashes that are as somebody saw them, by decide() (decision 0101).
/// A clash that a person or a run changed since is refused, as is one that a later run does not
/// find or measures otherwise, whatever events were seen, and a key that no clash has: all others
/// stand. To be called within a transaction. Errors: those of decide(), but for unknown keys.
[[nodiscard]] Result<DecideOutcome> decide_if_unchanged(Database& database,
                                                        std::span<const std::string> keys,
                                                        const ClashDecision& decision,
                                                        const KnownState& known);

/// Returns the rows of the clashes of which a status or comment changed after an event, the first
/// `limit` of them in the order of their ids.
[[nodiscard]] Result<std::vector<std::int64_t>> changed_since(Database& database,
                                                              std::int64_t event,
                                                              std::size_t limit);

}  // namespace strake::project
