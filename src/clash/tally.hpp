// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/candidate.hpp"
#include "clash/object_pairs.hpp"
#include "clash/pair_rules.hpp"

namespace strake::clash {

/// "pair-too-large", for each. Errors here and below: cancelled.
[[nodiscard]] Status note_too_large(const Judged& judged, const model::Model& model,
                                    const parallel::Context& context, Diagnostics& diagnostics);

/// "unknown-sag", once per file.
[[nodiscard]] Status note_unknown_sag(const PartList& list, const model::Model& model,
                                      const parallel::Context& context, Diagnostics& diagnostics);

/// Report::counters, and the candidates of each rule.
[[nodiscard]] Status tally(const Judged& judged, const ObjectPairs& objects, const PairRules& rules,
                           const parallel::Context& context, Report& report);

}  // namespace strake::clash
