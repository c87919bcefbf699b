// SPDX-License-Identifier: Apache-2.0
// oneTBB and OpenMP as workers: the bytes are those of a team and of no team.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <span>
#include <thread>
#include <vector>

#include "strake/parallel/backends/openmp.hpp"
#include "strake/parallel/backends/tbb.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/team.hpp"
#include "support/parallel_results.hpp"

namespace strake::parallel {
namespace {

TEST(Backends, give_the_same_bytes) {
  for (const std::size_t grain : {1U, 100U}) {
    Region region{.name = "foreign", .n = test::kResultItems, .grain = grain};
    const test::Results expected = test::results({}, region, 0);
    const test::OwnResults own = test::own_results({}, region, 0);
    const std::vector<std::uint32_t> longest =
        longest_first(region.blocks(), [](std::size_t i) { return test::value(i); });
    for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
      Team team(workers);
      oneapi::tbb::task_arena arena(static_cast<int>(workers));
      HostExecutor tbb(workers, in_arena(arena)), openmp(workers, by_openmp());
      for (Executor* const executor : {static_cast<Executor*>(&team), static_cast<Executor*>(&tbb),
                                       static_cast<Executor*>(&openmp)}) {
        region.order = {};
        ASSERT_EQ(test::own_results({.team = executor}, region, workers), own)
            << "workers " << workers << ", grain " << grain;
        for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks})
          for (const std::size_t chunk : {1U, 5U})
            for (const bool ordered : {false, true}) {
              region.schedule = schedule;
              region.chunk = chunk;
              region.order = ordered ? std::span<const std::uint32_t>(longest)
                                     : std::span<const std::uint32_t>();
              ASSERT_EQ(test::results({.team = executor}, region, workers), expected)
                  << "workers " << workers << ", grain " << grain << ", chunk " << chunk;
            }
      }
    }
  }
}

// While a worker of the arena waits for a region to end it must not start on another of the
// program's own tasks: that would enter what the first holds a second time.
TEST(Backends, a_waiting_worker_takes_no_foreign_task) {
  // As many threads as it requests, on however few cores.
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                            4);
  oneapi::tbb::task_arena arena(3);
  HostExecutor executor(3, in_arena(arena));
  std::atomic<int> entered_twice{0};
  std::atomic<bool> first{true}, begun{false};
  arena.execute([&] {
    oneapi::tbb::parallel_for(0, 300, [&](int) {
      thread_local int depth = 0;
      if (depth++ > 0) ++entered_twice;
      if (first.exchange(false)) {
        // Item 1 takes long, on another thread once item 0 waits for it to begin.
        const Status status =
            for_each({.team = &executor}, {.name = "inner", .n = 2}, [&](std::size_t i) {
              begun = begun || i == 1;
              for (int ms = 0; ms < (i == 0 ? 1000 : 50) && !(i == 0 && begun); ++ms)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            });
        EXPECT_TRUE(status);
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      --depth;
    });
  });
  EXPECT_EQ(entered_twice, 0);
}

}  // namespace
}  // namespace strake::parallel
