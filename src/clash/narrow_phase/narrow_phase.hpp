// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/narrow_phase/acceleration_cache.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/pairs/pair_tasks.hpp"

/// The narrow phase: classes, separations and relations of all unique pairs of a run.
namespace strake::clash {

/// The inputs that the stages of a run share.
struct StageInputs {
  const PairTasks& work;
  const ObjectPairs& objects;
  const RuleMatcher& rules;
  const PairToleranceTable& pair_tolerances;
  const Options& options;
  AccelerationCache& cache;
};

/// Evaluates all unique pairs, exact and certified: the cheapest test decides first, and only what
/// is left open goes on to trees, depths and distances. `evaluated` shows `candidates`, one per
/// unique pair. Errors here and below: cancelled.
[[nodiscard]] Status run_exact_narrow_phase(const StageInputs& stage,
                                            const EvaluatedPairs& evaluated,
                                            std::vector<Candidate>& candidates);

/// Evaluates every unique pair by halving its common box: the baseline.
[[nodiscard]] Status run_sphere_narrow_phase(const StageInputs& stage,
                                             std::vector<Candidate>& candidates);

/// Marks the unique pairs (Candidate::in_open) whose surfaces are apart, but where one part lies
/// within the other, an open surface that nearly encloses what it surrounds: were it meant as a
/// solid, they would hit. Pairs that touch there become UNCERTAIN instead, and may be a HIT. It
/// runs after all results are there. Errors: cancelled.
[[nodiscard]] Status mark_enclosed(const StageInputs& stage, std::vector<Candidate>& candidates);

}  // namespace strake::clash
