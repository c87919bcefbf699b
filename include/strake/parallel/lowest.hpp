// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strake::parallel {

/// The lowest item that is offered for each of some keys, by workers that offer in any order:
/// "whose shape is it first", without a pass by one worker that goes through all items.
///
///     Lowest first(shapes);
///     const Status status = for_each(context, {.name = "first bodies", .n = n, .grain = 4096},
///                                    [&](std::size_t b) { first.offer(shape_of(b), b); });
///     ... first[s] is the lowest body of shape s, or Lowest::kNone ...
///
/// Which items were offered decides, not who came first, so it is the same for any team. Read
/// between regions; within one a worker may see an item that is not the lowest yet. Items are below
/// 2^32 - 1.
class Lowest {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// None for every key.
  explicit Lowest(std::size_t keys) : items_(keys) {
    for (std::atomic<std::uint32_t>& item : items_) item.store(kNone, std::memory_order_relaxed);
  }

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] std::uint32_t operator[](std::size_t key) const {
    return items_[key].load(std::memory_order_relaxed);
  }
  /// Costs a look where a lower item is known already.
  void offer(std::size_t key, std::size_t item) {
    const auto offered = static_cast<std::uint32_t>(item);
    std::uint32_t known = items_[key].load(std::memory_order_relaxed);
    while (offered < known &&
           !items_[key].compare_exchange_weak(known, offered, std::memory_order_relaxed)) {
    }
  }

 private:
  std::vector<std::atomic<std::uint32_t>> items_;
};

}  // namespace strake::parallel
