// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "strake/parallel/executor.hpp"

namespace strake::parallel {

/// A fixed team of threads, created once and reused by every region.
///
///     strake::parallel::Team team(strake::parallel::default_workers());
///     team.run([&](strake::parallel::Seat seat) { ... });
///
/// Most code never calls run() but hands the team to for_each and its relatives in a Context.
///
/// It must outlive every region that runs on it, those of other threads, too.
///
/// The calling thread is worker 0; a team of one has no threads of its own. What else holds for
/// run() stands with Executor.
class Team final : public Executor {
 public:
  static constexpr unsigned kMaxWorkers = 1024;

  /// 0 counts as 1. A host that refuses a thread gives a smaller team, see size().
  explicit Team(unsigned workers);
  ~Team() override;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  Team(Team&&) = delete;
  Team& operator=(Team&&) = delete;

 private:
  void call_all(FunctionRef<void(Seat)> body) noexcept override;
  void serve(unsigned index) noexcept;

  int spins_ = 0;  ///< before going to sleep
  std::vector<std::thread> threads_;
  const FunctionRef<void(Seat)>* body_ = nullptr;
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
