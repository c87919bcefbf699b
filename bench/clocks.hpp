// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <string>

namespace strake::bench {

/// Seconds since the last call.
class Lap {
 public:
  double operator()() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The same in CPU seconds of all threads: what a busy machine does not spoil.
class CpuLap {
 public:
  double operator()() {
    const std::clock_t now = std::clock();
    const double lap = static_cast<double>(now - last_) / CLOCKS_PER_SEC;
    last_ = now;
    return lap;
  }

 private:
  std::clock_t last_ = std::clock();
};

/// Both since the last call, as text.
class Clock {
 public:
  [[nodiscard]] std::string text() {
    const double wall = wall_(), cpu = cpu_();
    return fmt::format("{:.3f} s, {:.3f} s CPU", wall, cpu);
  }

 private:
  Lap wall_;
  CpuLap cpu_;
};

}  // namespace strake::bench
