// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clash/narrow.hpp"
#include "clash/pair_rules.hpp"
#include "clash/parts.hpp"

namespace strake::clash {

/// The answer for one pair of parts, by its index among the candidates; not null.
struct Found {
  std::size_t candidate = 0;
  const PartAnswer* answer = nullptr;
};

/// The pairs of objects that are not NO_HIT: the join of the answers of their parts by whether a
/// rule allows them, class, level, d, witness and part numbers, which is associative and
/// commutative. `found` is by candidate. Errors: cancelled.
[[nodiscard]] Result<std::vector<Pair>> join_by_objects(
    const std::vector<Found>& found, const std::vector<geometry::IndexPair>& candidates,
    const PartList& list, const PairRules& rules, const parallel::Context& context);

/// Hexadecimal hash of the pairs by durable ids: classes, relations, d, witnesses, and the rules
/// that allow them. Errors: cancelled.
[[nodiscard]] Result<std::string> hash_of(const Report& report, const model::Model& model,
                                          const parallel::Context& context);

}  // namespace strake::clash
