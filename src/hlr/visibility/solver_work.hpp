// SPDX-License-Identifier: Apache-2.0
// What the solvers count, and its sums; seconds of the local and of the global step, which one loop
// over edges does at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/stopwatch.hpp"
#include "hlr/visibility/visibility_scene.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {

struct SolverWork {
  std::uint64_t edges = 0, covered = 0, tests = 0, wide_tests = 0, left_out = 0, specks = 0;
  std::uint64_t clipped = 0;      ///< clipped pieces that were left out
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

/// Shares the time of a loop over edges out between the two steps, by a sample of its items. It is
/// made when the loop begins.
class StepShares {
 public:
  /// `report` null: nobody needs it, and no item is timed.
  StepShares(parallel::RunReport* report, Stage stage, std::size_t items);

  /// Returns whether an item is one of the sample.
  [[nodiscard]] bool times(std::size_t item) const { return every_ > 0 && item % every_ == 0; }

  /// Reports the loop, which has ended: of `timed_s` seconds of the sample `own_s` went into tests
  /// of edges against their own objects.
  void report(double own_s, double timed_s) const;

 private:
  void add(std::string_view step, double share) const;

  parallel::RunReport* report_;
  Stage stage_;
  std::size_t every_ = 0;  ///< 0: none is timed
  double start_cpu_s_ = 0;
  Stopwatch watch_;
};

}  // namespace strake::hlr
