// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/stopwatch.hpp"
#include "strake/parallel/report.hpp"

namespace strake::cli {

/// What --stats prints: seconds per phase, work counters, parallel regions, peak memory.
class Stats {
 public:
  /// Measures one phase from construction to destruction.
  class Timer {
   public:
    Timer(Stats& stats, std::string_view phase);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    Timer(Timer&&) = delete;
    Timer& operator=(Timer&&) = delete;

   private:
    Stats& stats_;
    std::string phase_;
    Stopwatch watch_;
    double start_cpu_s_ = 0;
  };

  [[nodiscard]] Timer time(std::string_view phase) { return Timer(*this, phase); }
  void count(std::string_view name, std::uint64_t value);
  /// Adds a line in words about what the run did.
  void note(std::string_view name, std::string_view words);
  /// Adds one of the pairs that cost most; `where`, if not empty, tells which of equal names these
  /// are.
  void costly(std::string_view a, std::string_view b, std::string_view where, std::uint64_t cost);

  /// Returns the statistics as lines for a person.
  [[nodiscard]] std::string text(const parallel::RunReport& report) const;
  /// Returns the statistics as one JSON object.
  [[nodiscard]] std::string json(const parallel::RunReport& report) const;

 private:
  struct Phase {
    std::string name;
    double wall_s = 0, cpu_s = 0;
  };
  std::vector<Phase> phases_;
  struct Costly {
    std::string a, b, where;
    std::uint64_t cost = 0;
  };
  std::vector<std::pair<std::string, std::uint64_t>> counters_;
  std::vector<std::pair<std::string, std::string>> words_;
  std::vector<Costly> costly_;
};

/// Returns the most memory that this process has held at a time.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace strake::cli
