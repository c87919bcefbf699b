// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/progress.hpp"

#include <algorithm>

namespace strake::parallel {

bool Progress::begin(std::string_view phase, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  if (active_) return false;
  phase_ = phase;
  active_ = true;
  total_ = total;
  done_.store(0, std::memory_order_relaxed);
  return true;
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  active_ = false;
  ++ended_;
}

Progress::Snapshot Progress::snapshot() const {
  const std::lock_guard lock(mutex_);
  if (!active_) return {.phase = {}, .done = 0, .total = 0, .phases_ended = ended_};
  return {.phase = phase_,
          .done = std::min(done_.load(std::memory_order_relaxed), total_),
          .total = total_,
          .phases_ended = ended_};
}

}  // namespace strake::parallel
