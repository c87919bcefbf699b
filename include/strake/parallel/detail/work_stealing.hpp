// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0033 says why each worker has a share of its own.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "strake/parallel/executor.hpp"

namespace strake::parallel::detail {

/// What a worker has in hand of the positions that are dealt out.
struct WorkerShare {
  std::size_t position = 0, end = 0;  ///< taken and not yet visited
  std::size_t share = 0;              ///< where the next come from
  std::size_t shares_left = 0;        ///< that one and those to look at after it
};

/// Deals the positions [0, n) of a visiting order out to workers, each position once.
///
/// They lie in equal, contiguous shares. A worker takes a chunk at a time from the share that has
/// its number, then from whichever has some left: until then workers meet neither at a counter nor
/// at the slots of neighbouring items, and in the end a free worker finds whatever is left (static
/// stealing). One share for all deals out in ascending order.
class WorkStealingShares {
 public:
  /// Who gets what a worker has not begun of its share.
  enum class Rest : bool {
    free,  ///< whoever has nothing left
    kept,  ///< that worker, and the whole share at once; one that sits alone gets all shares
  };

  /// Before workers take any. Memory for `shares` counters may be lacking: std::bad_alloc.
  void deal(std::size_t n, std::size_t shares, std::size_t chunk, Rest rest) {
    all_ = one_;
    if (shares > 1) all_ = many_ = std::vector<Share>(shares);
    const auto start = [&](std::size_t i) { return n / shares * i + std::min(i, n % shares); };
    for (std::size_t i = 0; i < shares; ++i) {
      all_[i].next.store(start(i), std::memory_order_relaxed);
      all_[i].end = start(i + 1);
      all_[i].chunk = rest == Rest::free ? chunk : start(i + 1) - start(i);
    }
    rest_ = rest;
  }

  [[nodiscard]] WorkerShare share_of(Seat seat) const {
    const std::size_t own = seat.index % all_.size();
    const std::size_t others = all_.size() - 1 - (rest_ == Rest::free ? 0 : own);
    return {.share = own, .shares_left = others / step(seat) + 1};
  }

  /// The next positions for the worker in that seat; false when none are left.
  bool take(WorkerShare& hand, Seat seat) {
    while (hand.shares_left > 0) {
      Share& share = all_[hand.share];
      const std::size_t taken = share.next.fetch_add(share.chunk, std::memory_order_relaxed);
      if (taken < share.end) {
        hand.position = taken;
        hand.end = taken + std::min(share.chunk, share.end - taken);
        return true;
      }
      leave(hand, seat);
    }
    return false;
  }

  /// Takes no more from the share in hand.
  void leave(WorkerShare& hand, Seat seat) const {
    hand.position = hand.end;
    do {
      hand.share += step(seat);
      if (hand.share >= all_.size()) hand.share -= all_.size();
    } while (--hand.shares_left > 0 && is_empty(all_[hand.share]));
  }

 private:
  struct Share {
    alignas(64) std::atomic<std::size_t> next{0};
    alignas(64) std::size_t end = 0;  // nobody writes here while workers take
    std::size_t chunk = 1;
  };

  static bool is_empty(const Share& share) {
    return share.next.load(std::memory_order_relaxed) >= share.end;
  }
  [[nodiscard]] std::size_t step(Seat seat) const { return rest_ == Rest::free ? 1 : seat.count; }

  std::array<Share, 1> one_;
  std::vector<Share> many_;
  std::span<Share> all_ = one_;
  Rest rest_ = Rest::free;
};

}  // namespace strake::parallel::detail
