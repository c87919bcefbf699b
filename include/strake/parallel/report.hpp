// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace strake::parallel {

/// What one region (all its runs together) cost, and how evenly the team shared it.
struct RegionReport {
  std::string name;
  std::uint64_t runs = 0;  ///< runs by a whole team, or without one
  /// Runs by one worker of several: inside another region, or of a single block, heavy items of
  /// for_each_by_weight among them.
  std::uint64_t nested_runs = 0;
  std::uint64_t items = 0;
  double wall_s = 0;           ///< of `runs`
  double nested_cpu_s = 0;     ///< of `nested_runs`; where these are inside another region or hold
                               ///< one, its busy time has it, too
  std::vector<double> busy_s;  ///< CPU seconds per worker in `runs`; index = worker
  double longest_s = 0;  ///< the longest block of `runs` (with grain 1: item), wall seconds, at
                         ///< most busy
  /// Set by RunReport::add, summed over runs: busy seconds over workers, and what no schedule could
  /// take less than, the larger of that and the longest block.
  double share_s = 0, least_s = 0;

  [[nodiscard]] double total_busy_s() const;
  /// Mean over maximum of the workers' busy time: 1 is perfect, 1/workers is one doing it all.
  [[nodiscard]] double load_balance() const;
  /// The efficiency that no schedule can pass: total / (P · max(total / P, longest block)), the
  /// longest of each run.
  [[nodiscard]] double bound() const;
};

/// What a stage of a computation took, its regions and what lies between them.
struct StageReport {
  std::string name;
  double wall_s = 0, cpu_s = 0;  ///< cpu: of the whole process
};

/// Collects the reports of the regions that run under a Context that names it. Thread-safe.
/// Asking for it makes regions read clocks per block. Without a team no region can tell that it is
/// inside another: its time is then in the entries of both.
class RunReport {
 public:
  /// Adds one run to the entry of its name.
  void add(const RegionReport& run);
  /// Adds to the stage of that name.
  void add(const StageReport& run);
  /// One entry per name, in order of first appearance.
  [[nodiscard]] std::vector<RegionReport> regions() const;
  [[nodiscard]] std::vector<StageReport> stages() const;

 private:
  void merge(const RegionReport& run);

  mutable std::mutex mutex_;
  std::vector<RegionReport> regions_;
  std::vector<StageReport> stages_;
};

/// Measures one stage from construction to destruction; null: nobody needs it.
class StageTimer {
 public:
  StageTimer(RunReport* report, std::string_view stage);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  StageTimer(StageTimer&&) = delete;
  StageTimer& operator=(StageTimer&&) = delete;

 private:
  RunReport* report_;
  StageReport run_;  ///< while it runs: the clocks at its start
};

/// CPU seconds that the calling thread, and all threads together, have used so far.
[[nodiscard]] double thread_cpu_s();
[[nodiscard]] double process_cpu_s();

}  // namespace strake::parallel
