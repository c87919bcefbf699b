// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <stop_token>
#include <type_traits>
#include <utility>
#include <vector>

namespace strake::parallel {

/// A queue between threads that holds so many values at most: who is faster waits for who is
/// slower, so memory stays bounded whatever their paces.
///
///     BoundedQueue<Batch> queue(8);
///     // producers                              // consumers
///     if (!queue.push(std::move(batch))) ...     while (auto batch = queue.pop()) write(*batch);
///     queue.close();  // when all producers are done
///
/// Any number of threads may push, pop and close. Values come out in the order in which they went
/// in; which consumer gets which is left to the schedule. For results in the order of their items
/// see pipeline().
///
/// There is room for all from the beginning, so that no call can throw and leave who waits asleep.
template <class T>
class BoundedQueue {
 public:
  static_assert(std::is_nothrow_move_constructible_v<T>, "values are handed from thread to thread");

  /// 0 counts as 1. Throws std::bad_alloc, or std::length_error of a capacity beyond all memory.
  explicit BoundedQueue(std::size_t capacity) : slots_(std::max<std::size_t>(capacity, 1)) {}
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;
  BoundedQueue(BoundedQueue&&) = delete;
  BoundedQueue& operator=(BoundedQueue&&) = delete;
  ~BoundedQueue() = default;

  /// Waits for room. False, with the value left as it was, when the queue is closed or `stop` is
  /// triggered before there is any.
  [[nodiscard]] bool push(T&& value, const std::stop_token& stop = {}) {
    {
      std::unique_lock lock(mutex_);
      const bool room =
          has_room_.wait(lock, stop, [this] { return closed_ || held_ < slots_.size(); });
      if (!room || closed_) return false;
      slots_[(first_ + held_++) % slots_.size()].emplace(std::move(value));
    }
    has_values_.notify_one();
    return true;
  }

  /// Waits for a value. None when the queue is closed and empty, or `stop` is triggered while there
  /// is none.
  [[nodiscard]] std::optional<T> pop(const std::stop_token& stop = {}) {
    std::optional<T> value;
    {
      std::unique_lock lock(mutex_);
      has_values_.wait(lock, stop, [this] { return closed_ || held_ > 0; });
      if (held_ == 0) return value;
      value.emplace(*std::move(slots_[first_]));
      slots_[first_].reset();
      first_ = (first_ + 1) % slots_.size();
      --held_;
    }
    has_room_.notify_one();
    return value;
  }

  /// Nothing more goes in; what is in still comes out.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    has_room_.notify_all();
    has_values_.notify_all();
  }

  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

 private:
  std::mutex mutex_;
  std::condition_variable_any has_room_, has_values_;
  std::vector<std::optional<T>> slots_;  ///< a ring
  std::size_t first_ = 0, held_ = 0;
  bool closed_ = false;
};

}  // namespace strake::parallel
