// SPDX-License-Identifier: Apache-2.0
// Seconds of the local and of the global step, which one loop over edges does at once.
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {

/// Wall seconds since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Shares the time of a loop over edges out between the two steps, by a sample of its items. It is
/// made when the loop begins.
class StepShares {
 public:
  /// `report` null: nobody asks, and no item is timed.
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
