// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <new>
#include <string>
#include <string_view>

namespace strake::parallel {

/// How far a run is. Workers add, anyone may look at any time: there are no callbacks, so a slow
/// terminal never holds up the work.
///
/// A phase is claimed by whoever begins it first and lasts until it ends; what is begun meanwhile
/// (a nested region) is part of it and not shown. Regions claim a phase under their own name; a
/// caller that knows better (bytes of a file, say) claims its own around them.
class Progress {
 public:
  struct Snapshot {
    std::string phase;  ///< empty: nothing is running
    std::uint64_t done = 0, total = 0;
    std::uint64_t phases_ended = 0;
  };

  /// True when the phase is now this caller's to add to and to end.
  [[nodiscard]] bool begin(std::string_view phase, std::uint64_t total);
  void add(std::uint64_t amount) { done_.fetch_add(amount, std::memory_order_relaxed); }
  void end();

  [[nodiscard]] Snapshot snapshot() const;

 private:
  mutable std::mutex mutex_;
  std::string phase_;
  bool active_ = false;
  std::uint64_t total_ = 0, ended_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

/// Claims a phase for as long as it lives, if it is free and somebody requested progress (not
/// null). Where there is no memory for its name it is not told of.
class ProgressPhase {
 public:
  ProgressPhase(Progress* progress, std::string_view phase, std::uint64_t total) noexcept
      : ours_(claimed(progress, phase, total) ? progress : nullptr) {}
  ProgressPhase(const ProgressPhase&) = delete;
  ProgressPhase& operator=(const ProgressPhase&) = delete;
  ProgressPhase(ProgressPhase&&) = delete;
  ProgressPhase& operator=(ProgressPhase&&) = delete;
  ~ProgressPhase() {
    if (ours_ != nullptr) ours_->end();
  }

  /// Whether the phase is this one's to add to.
  [[nodiscard]] bool is_ours() const { return ours_ != nullptr; }
  void add(std::uint64_t amount) const {
    if (ours_ != nullptr) ours_->add(amount);
  }

 private:
  static bool claimed(Progress* progress, std::string_view phase, std::uint64_t total) noexcept
      try {
    return progress != nullptr && progress->begin(phase, total);
  } catch (const std::bad_alloc&) {
    return false;
  }

  Progress* ours_;
};

}  // namespace strake::parallel
