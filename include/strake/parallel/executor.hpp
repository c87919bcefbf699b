// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "strake/parallel/detail/function_ref.hpp"

namespace strake::parallel {

/// One worker's place in a region: worker `index` of the `count` that take part.
struct Seat {
  unsigned index = 0;
  unsigned count = 1;
};

/// Who works on a region: a Team, or the threads that a host has already (HostExecutor). All that
/// the patterns ask of them is to call a body once for each worker; schedule, blocks, order of
/// results and reports are the same for any.
///
/// 1. run() returns when every seat's call has returned; what they wrote is visible to the caller.
/// 2. An executor that is busy (run() called from within a region, or from a second thread) lets
///    nobody wait: the second caller runs its own body alone, with Seat{0, 1}. So nested regions
///    and concurrent callers cannot deadlock, and one region's workers never serve another's.
/// 3. A body must not throw: an exception that leaves it ends the program.
class Executor {
 public:
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  Executor(Executor&&) = delete;
  Executor& operator=(Executor&&) = delete;
  virtual ~Executor() = default;

  /// Seats of a region; at least 1.
  [[nodiscard]] unsigned size() const { return size_; }

  /// Calls body once per seat, concurrently where there are threads for it. True when all seats
  /// took part, false when the workers were busy and the caller ran alone.
  bool run(FunctionRef<void(Seat)> body) noexcept;

 protected:
  /// 0 counts as 1.
  explicit Executor(unsigned size) : size_(size == 0 ? 1 : size) {}
  /// For those that learn it while they are made.
  void set_size(unsigned size) { size_ = size; }

 private:
  /// Calls body once with each Seat{index, size()}; never called twice at a time, nor for one seat.
  virtual void call_all(FunctionRef<void(Seat)> body) noexcept = 0;

  unsigned size_;
  std::atomic<bool> busy_{false};
};

}  // namespace strake::parallel
