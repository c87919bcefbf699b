// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/pairs/pair_tasks.hpp"

namespace strake::clash {

/// What the stages of a run share.
struct StageInputs {
  const PairTasks& work;
  const ObjectPairs& objects;
  const RuleMatcher& rules;
  const PairToleranceTable& pair_tolerances;
  const Options& options;
  AccelerationCache& cache;
};

/// The answers of all cases, exact and certified: what takes least decides first, and only what is
/// left open goes on to trees, depths and distances. `evaluated` shows `candidates`, one per case.
/// Errors here and below: cancelled.
[[nodiscard]] Status run_exact_narrow_phase(const StageInputs& stage,
                                            const EvaluatedPairs& evaluated,
                                            std::vector<Candidate>& candidates);

/// The baseline: every case by halving its common box.
[[nodiscard]] Status run_sphere_narrow_phase(const StageInputs& stage,
                                             std::vector<Candidate>& candidates);

/// Marks the cases (Candidate::in_open) that are apart as far as skins tell, but where one part
/// lies within the other, an open surface that nearly encloses what it surrounds: meant as a solid,
/// it would hit. Those that touch there are UNCERTAIN instead, and may be a HIT. After all answers
/// are there. Errors: cancelled.
[[nodiscard]] Status mark_enclosed(const StageInputs& stage, std::vector<Candidate>& candidates);

}  // namespace strake::clash
