// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace strake::parallel {

/// One lock per item, of a byte: for the rare pattern where items write into each other.
///
///     ItemLocks locks(objects.size());
///     { const auto held = locks.hold(u);  objects[u].add(hit); }
///
/// Busy waiting, so hold one for some microseconds at most, and never two at once. The order of
/// writers is left to the schedule: what they write must come out the same in any order. Prefer to
/// gather (docs/patterns/item-locks.md).
class ItemLocks {
 public:
  explicit ItemLocks(std::size_t items) : flags_(items) {}

  class Held {
   public:
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    Held(Held&&) = delete;
    Held& operator=(Held&&) = delete;
    ~Held() { flag_.clear(std::memory_order_release); }

   private:
    friend class ItemLocks;
    explicit Held(std::atomic_flag& flag) : flag_(flag) {}
    std::atomic_flag& flag_;
  };

  /// Waits until nobody holds the item.
  [[nodiscard]] Held hold(std::size_t item) {
    std::atomic_flag& flag = flags_[item];
    if (flag.test_and_set(std::memory_order_acquire)) {
      waits_.fetch_add(1, std::memory_order_relaxed);
      for (int spins = 0; flag.test_and_set(std::memory_order_acquire);)
        if (++spins % kSpins == 0) std::this_thread::yield();
    }
    return Held(flag);
  }

  /// How often somebody had to wait.
  [[nodiscard]] std::uint64_t waits() const { return waits_.load(std::memory_order_relaxed); }

 private:
  static constexpr int kSpins = 64;
  std::vector<std::atomic_flag> flags_;
  std::atomic<std::uint64_t> waits_{0};
};

}  // namespace strake::parallel
