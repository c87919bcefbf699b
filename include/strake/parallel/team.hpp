// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "strake/parallel/function_ref.hpp"

namespace strake::parallel {

/// One worker's place in a region: worker `index` of the `count` that take part.
struct Seat {
  unsigned index = 0;
  unsigned count = 1;
};

/// A fixed team of threads, created once and reused by every region.
///
///     strake::parallel::Team team(strake::parallel::default_workers());
///     team.run([&](strake::parallel::Seat seat) { ... });
///
/// Most code never calls run() but hands the team to for_each and its relatives in a Context.
///
/// 1. The calling thread is worker 0; a team of one has no threads of its own.
/// 2. run() returns when every worker has returned; what they wrote is visible to the caller.
/// 3. A team that is busy (run() called from within a region, or from a second thread) does not
///    wait: the second caller runs its own body alone, with Seat{0, 1}. So nested regions and
///    concurrent callers cannot deadlock, and one region's workers never serve another's.
/// 4. A body must not throw: an exception that leaves it ends the program.
class Team {
 public:
  static constexpr unsigned kMaxWorkers = 1024;

  /// 0 counts as 1. A host that refuses a thread gives a smaller team, see size().
  explicit Team(unsigned workers);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  Team(Team&&) = delete;
  Team& operator=(Team&&) = delete;

  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(threads_.size()) + 1; }

  /// Calls body once per seat, seats concurrently. True when the whole team took part, false when
  /// it was busy and the caller ran alone.
  bool run(FunctionRef<void(Seat)> body) noexcept;

 private:
  void serve(unsigned index) noexcept;

  std::vector<std::thread> threads_;
  const FunctionRef<void(Seat)>* body_ = nullptr;
  std::atomic<bool> busy_{false};
  std::atomic<bool> closing_{false};
  // 32 bits wide so that waiting is a futex on the word itself. Apart, because the sleepers poll
  // the one while the finishers write the other.
  alignas(64) std::atomic<std::uint32_t> generation_{0};
  alignas(64) std::atomic<std::uint32_t> pending_{0};
};

/// How many workers this process can really run at a time: the CPUs of its affinity mask, or the
/// container's CPU quota (cgroup version 1 or 2) rounded up where that is less; at least 1.
[[nodiscard]] unsigned default_workers();

}  // namespace strake::parallel
