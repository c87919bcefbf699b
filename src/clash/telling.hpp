// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "clash/candidate.hpp"
#include "clash/object_pairs.hpp"
#include "clash/pair_rules.hpp"

namespace strake::clash {

/// How the places of a pair of parts are told, each more than the one before.
enum class Telling : std::uint8_t {
  whole,       ///< not at all: nobody asks, or there can be only one
  if_several,  ///< where there are several
  each,        ///< even if there is only one: it stands beside those of other parts
  all,         ///< and those within the clearance too: a rule may allow what is worse
};

/// For each case: what lists of regions ask about it, and rules that may allow one place and not
/// the other. Errors: cancelled.
[[nodiscard]] Result<std::vector<Telling>> how_to_tell(const Judged& judged,
                                                       const ObjectPairs& objects,
                                                       const PairRules& rules,
                                                       const Options& options,
                                                       const parallel::Context& context);

}  // namespace strake::clash
