// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/candidate.hpp"
#include "clash/object_pairs.hpp"
#include "clash/pair_rules.hpp"

namespace strake::clash {

/// Report::not_compared: the objects of the sets that lack geometry, the pairs that are too large
/// and those of which one lies within the other's open surface, unless they hit otherwise; messages
/// of these codes tell of both. Errors here and below: cancelled.
[[nodiscard]] Status note_not_compared(const Judged& judged, const ObjectPairs& objects,
                                       const model::Scene& scene, const parallel::Context& context,
                                       Report& report);

/// Report::sheets.
void note_sheets(const PartList& list, Report& report);

/// "unknown-sag", once per file.
[[nodiscard]] Status note_unknown_sag(const PartList& list, const model::Model& model,
                                      const parallel::Context& context, Diagnostics& diagnostics);

/// Report::counters, and the candidates of each rule.
[[nodiscard]] Status tally(const Judged& judged, const ObjectPairs& objects, const PairRules& rules,
                           const parallel::Context& context, Report& report);

}  // namespace strake::clash
