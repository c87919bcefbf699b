// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strake::parallel {

/// A flag per item that workers set while others read it, and that is never taken back: "this one
/// is done with, spare yourself the work".
///
///     Marks hidden(edges.size());
///     ... if (hidden.is_set(e)) continue; ... hidden.set(e); ...
///
/// A worker may see a flag late. So a flag may decide whether work is done in vain, never a result,
/// until the region has ended; then all see all. It says nothing of other memory that was written
/// before it was set: hand values over by the end of a region.
class Marks {
 public:
  Marks() = default;
  /// All of them down.
  explicit Marks(std::size_t items) : flags_(items) {}

  [[nodiscard]] std::size_t size() const { return flags_.size(); }
  [[nodiscard]] bool is_set(std::size_t item) const {
    return flags_[item].load(std::memory_order_relaxed) != 0;
  }
  /// How many are set.
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        flags_, [](const auto& flag) { return flag.load(std::memory_order_relaxed) != 0; }));
  }
  void set(std::size_t item) { flags_[item].store(1, std::memory_order_relaxed); }

 private:
  std::vector<std::atomic<std::uint8_t>> flags_;
};

}  // namespace strake::parallel
