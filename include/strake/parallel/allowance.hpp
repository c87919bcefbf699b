// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace strake::parallel {

/// So much may be used by all workers together: memory, results, steps of a search.
///
///     Allowance pairs(limit);
///     ... if (!pairs.take(found)) return too_many(); ...
///
/// Whether all that was requested fits is the same for any team, as a sum is; who is refused is
/// not. So a refusal may end the region with an error that names the limit alone, and may not
/// choose between two results. Take in lots: each take is one atomic addition on a word that all
/// share.
class Allowance {
 public:
  /// At most 2^64 - 2; more counts as that.
  explicit Allowance(std::uint64_t limit) : limit_(std::min(limit, kSpent - 1)) {}

  /// False if more has been requested than there is; from then on always, for any amount.
  [[nodiscard]] bool take(std::uint64_t amount) {
    std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    std::uint64_t after = 0;
    do {
      if (taken > limit_) return false;
      // One too many is as good as any number too many, and cannot overflow.
      after = amount <= limit_ - taken ? taken + amount : kSpent;
    } while (!taken_.compare_exchange_weak(taken, after, std::memory_order_relaxed));
    return after != kSpent;
  }

  [[nodiscard]] std::uint64_t limit() const { return limit_; }
  /// The former name of limit().
  [[deprecated("it is called limit()")]] [[nodiscard]] std::uint64_t most() const { return limit_; }

 private:
  static constexpr std::uint64_t kSpent = ~std::uint64_t{0};
  std::uint64_t limit_;
  std::atomic<std::uint64_t> taken_{0};
};

}  // namespace strake::parallel
