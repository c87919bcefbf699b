// SPDX-License-Identifier: Apache-2.0
// What the records of an evaluation say: speed-ups, their spread, balance, bounds, noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/evaluate/record.hpp"

namespace strake::cli {

/// Returns the median; 0 where there is none.
[[nodiscard]] double median(std::vector<double> values);

/// Returns the contender of a name on so many threads; null: there is none, or it has no result.
[[nodiscard]] const ContenderRecord* find_contender(const StageRecord& stage,
                                                    const std::string& name, unsigned threads);

/// Returns how far the two sequential runs of a stage are apart, as part of their time: what
/// differs by less cannot be known on this machine. 0 where there was only one.
[[nodiscard]] double timing_noise(const StageRecord& stage);

/// Returns the busy seconds of each worker in all regions of the team.
[[nodiscard]] std::vector<double> busy_seconds(const ContenderRecord& run);

/// What one parallel run came to beside the sequential one.
struct Speedup {
  double sequential_s = 0, parallel_s = 0;
  double speedup = 0;
  /// Mean over maximum of the workers' busy time, over all regions of the team.
  double load_balance = 1;
  /// The worst of a region above 50 ms, and its name; 1 where there is none.
  double worst_balance = 1;
  std::string worst_region;
  /// The part of the sequential time that no region of a team shares, and the speed-up that it
  /// allows on so many threads (Amdahl 1967).
  double serial_share = 0, amdahl = 0;
  /// The largest serial piece of work that has a name.
  std::string serial_region;
  /// The speed-up that the longest item of each region allows besides.
  double bound = 0;
  /// CPU seconds of the calling thread outside of the regions of a team, and the speed-up that they
  /// allow: CPU time of the parallel run over its part of it with the rest shared perfectly. Unlike
  /// those by wall time these hold on a machine that others use.
  double alone_s = 0, by_cpu = 0;
  /// The speed-up of work that is shared perfectly, in the same rounds; 0: not measured.
  double machine = 0;
};

/// Returns the speed-up of ours on so many threads; none where it was not measured.
[[nodiscard]] std::optional<Speedup> speedup_of(const StageRecord& stage, unsigned threads);

/// Returns "iso: local 0.62 s, 1.85 x on 2 threads; global ...".
[[nodiscard]] std::string outcome_line(const CaseRecord& one, const EvaluationSettings& settings);

struct Spread {
  std::size_t count = 0;
  double mean = 0, deviation = 0, least = 0, greatest = 0;
};
[[nodiscard]] Spread spread_of(std::span<const double> values);

/// Returns the speed-ups of all cases that have the stage.
[[nodiscard]] Spread spread_of(const EvaluationRecord& record, const std::string& stage,
                               unsigned threads);

/// What the thesis reports of a stage.
struct ThesisFigures {
  const char* stage;
  Spread speedup;
  const char* over;
};
[[nodiscard]] std::span<const ThesisFigures> thesis_figures();

/// Returns the most threads that were measured.
[[nodiscard]] unsigned max_threads(const EvaluationRecord& record);

}  // namespace strake::cli
