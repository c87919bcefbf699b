// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/time_limit.hpp"

#include <chrono>
#include <utility>

namespace strake::cli {

TimeLimit::TimeLimit(std::stop_token of_run, double seconds)
    : of_run_(std::move(of_run)), thread_([this, seconds] { watch(seconds); }) {}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void TimeLimit::watch(double seconds) {
  constexpr auto kPollInterval = std::chrono::milliseconds(50);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kPollInterval, [this] { return done_; }))
    if (of_run_.stop_requested() || std::chrono::steady_clock::now() >= end) {
      source_.request_stop();
      return;
    }
}

}  // namespace strake::cli
