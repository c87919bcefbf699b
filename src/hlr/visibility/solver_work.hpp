// SPDX-License-Identifier: Apache-2.0
// What the solvers count, and its sums.
#pragma once

#include <cstdint>
#include <span>

#include "hlr/visibility/visibility_scene.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

struct SolverWork {
  std::uint64_t edges = 0, covered = 0, tests = 0, wide_tests = 0, left_out = 0, specks = 0;
  bool specked = false;           ///< some of the visible pieces are specks
  double own_s = 0, timed_s = 0;  ///< of timed items: in tests against their own objects, and all
};

/// Adds the work to the counters that are no sums over objects (sum_up_lines()).
void add(Counters& counters, const SolverWork& work);

/// Adds the lines that a work counted to those of an object.
void add(LineCount& lines, const SolverWork& work);

/// Adds the work on each item to what is counted and left out of its object, and to `specked`.
/// Returns the sum of what add() gives to the counters, and of the seconds. Errors: cancelled.
[[nodiscard]] Result<SolverWork> sum_up_work(const VisibilityScene& visibility,
                                             std::span<const SolverWork> work,
                                             const parallel::Context& context, Drawing& drawing,
                                             SpeckedObjects& specked);

}  // namespace strake::hlr
