// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/parallel/context.hpp"
#include "strake/parallel/executor.hpp"

namespace strake::parallel {

/// Whether regions of this context may run items on several threads at once.
[[nodiscard]] inline bool is_concurrent(const Context& context) {
  return context.team != nullptr && context.team->size() > 1;
}

/// Holds a mutex for a scope where items run on several threads, and nothing where one thread runs
/// them all: code that is shared by both pays for the lock only where there is somebody to keep
/// out. For std::mutex, std::recursive_mutex, std::shared_mutex and whatever else has lock() and
/// unlock().
///
///     for_each(context, region, [&](std::size_t i) {
///       const OptionalLock lock(cache_mutex, context);
///       cache.note(i);
///     });
///
/// The context must be the one that the region runs with. It is wrong where the guarded data are
/// shared with threads that the context does not know of: two callers with a context each, a window
/// that reads while a region without a team writes. Those need the mutex itself.
///
/// Hold no mutex, recursive or not, while a region with a team runs: the item of a region of one
/// block, and a heavy item of for_each_by_weight, leave the team to it, and its workers would wait
/// for the mutex for ever. Give it Context{}. See docs/patterns/optional-lock.md.
template <class Mutex>
class OptionalLock {
 public:
  OptionalLock(Mutex& mutex, const Context& context)
      : mutex_(is_concurrent(context) ? &mutex : nullptr) {
    if (mutex_ != nullptr) mutex_->lock();
  }
  OptionalLock(const OptionalLock&) = delete;
  OptionalLock& operator=(const OptionalLock&) = delete;
  OptionalLock(OptionalLock&&) = delete;
  OptionalLock& operator=(OptionalLock&&) = delete;
  ~OptionalLock() {
    if (mutex_ != nullptr) mutex_->unlock();
  }

  /// Whether the mutex is held; false on one thread.
  [[nodiscard]] bool owns_lock() const { return mutex_ != nullptr; }

 private:
  Mutex* mutex_;
};

}  // namespace strake::parallel
