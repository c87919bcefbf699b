// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/candidate.hpp"
#include "clash/case_work.hpp"
#include "clash/object_pairs.hpp"
#include "clash/pair_options.hpp"
#include "clash/part_aids.hpp"

namespace strake::clash {

/// What the stages of a run share.
struct Stage {
  const CaseWork& work;
  const ObjectPairs& objects;
  const PairRules& rules;
  const PairOptions& pair_options;
  const Options& options;
  PartAids& aids;
};

/// The answers of all cases, exact and certified: what takes least decides first, and only what is
/// left open goes on to trees, depths and distances. `judged` shows `candidates`, one per case.
/// Errors here and below: cancelled.
[[nodiscard]] Status judge_exactly(const Stage& stage, const Judged& judged,
                                   std::vector<Candidate>& candidates);

/// The baseline: every case by halving its common box.
[[nodiscard]] Status judge_by_spheres(const Stage& stage, std::vector<Candidate>& candidates);

}  // namespace strake::clash
