// SPDX-License-Identifier: Apache-2.0
// Regions on the threads of a host: faithful, lazy and hostile ones give what a team gives.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/host_executor.hpp"
#include "support/parallel_results.hpp"

namespace strake::parallel {
namespace {

using Body = HostExecutor::Body;

void on_threads(unsigned count, const Body& body) {
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < count; ++i) threads.emplace_back([&body, i] { body(i); });
  for (std::thread& t : threads) t.join();
}

struct Host {
  const char* name;
  HostExecutor::Call call;
};

/// The first three do what they are requested to.
std::vector<Host> hosts() {
  return {
      {"threads", on_threads},
      {"one after another",
       [](unsigned count, const Body& body) {
         for (unsigned i = 0; i < count; ++i) body(i);
       }},
      {"from the last on",
       [](unsigned count, const Body& body) {
         for (unsigned i = count; i > 0; --i) body(i - 1);
       }},
      {"does nothing", [](unsigned, const Body&) {}},
      {"throws at once", [](unsigned, const Body&) { throw std::runtime_error("no threads"); }},
      {"throws what is no exception", [](unsigned, const Body&) { throw 7; }},
      {"throws half way",
       [](unsigned count, const Body& body) {
         for (unsigned i = 0; i < count / 2; ++i) body(i);
         throw std::runtime_error("no more threads");
       }},
      {"calls some twice, and some that are not",
       [](unsigned count, const Body& body) {
         on_threads(count, [&](unsigned i) {
           body(i);
           body(i / 2);
           body(count + i);
         });
       }},
      {"no function", {}},
  };
}

TEST(HostExecutor, gives_the_bytes_of_a_region_without_workers) {
  for (const std::size_t grain : {1U, 7U, 5000U}) {
    Region region{.name = "hosted", .n = test::kResultItems, .grain = grain};
    const test::Results expected = test::results({}, region, 0);
    const test::OwnResults own = test::own_results({}, region, 0);
    for (const Host& host : hosts())
      for (const unsigned workers : {1U, 2U, 5U, 16U}) {
        HostExecutor executor(workers, host.call);
        EXPECT_EQ(test::own_results({.team = &executor}, region, workers), own) << host.name;
        for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks}) {
          region.schedule = schedule;
          EXPECT_EQ(test::results({.team = &executor}, region, workers), expected)
              << host.name << ", workers " << workers << ", grain " << grain;
        }
      }
  }
}

TEST(HostExecutor, serves_each_seat_once) {
  for (const Host& host : hosts()) {
    HostExecutor executor(6, host.call);
    ASSERT_EQ(executor.size(), 6U);
    for (int round = 0; round < 20; ++round) {
      std::vector<int> calls(6, 0);  // plain ints: a lost happens-before is a TSan report
      EXPECT_TRUE(executor.run([&](Seat seat) {
        EXPECT_EQ(seat.count, 6U);
        ++calls[seat.index];
      }));
      EXPECT_EQ(calls, std::vector<int>(6, 1)) << host.name;
    }
  }
}

// A host that goes on without its threads, and one that keeps what it was given.
TEST(HostExecutor, waits_for_seats_that_the_host_does_not) {
  std::vector<std::thread> threads;
  HostExecutor executor(4, [&](unsigned count, const Body& body) {
    for (unsigned i = 0; i < count; ++i) threads.emplace_back([body, i] { body(i); });
  });
  for (int round = 0; round < 50; ++round) {
    std::vector<int> calls(4, 0);
    executor.run([&](Seat seat) {
      std::this_thread::yield();
      ++calls[seat.index];
    });
    EXPECT_EQ(calls, std::vector<int>(4, 1));
  }
  for (std::thread& t : threads) t.join();
}

TEST(HostExecutor, nested_regions_run_alone) {
  HostExecutor executor(4, on_threads);
  const Context context{.team = &executor};
  std::vector<std::vector<std::thread::id>> who(8, std::vector<std::thread::id>(50));
  const Status status = for_each(context, {.name = "outer", .n = who.size()}, [&](std::size_t i) {
    return for_each(context, {.name = "inner", .n = who[i].size()},
                    [&](std::size_t k) { who[i][k] = std::this_thread::get_id(); });
  });
  ASSERT_TRUE(status);
  for (const auto& ids : who) EXPECT_EQ(ids, std::vector<std::thread::id>(ids.size(), ids[0]));
}

TEST(HostExecutor, reports_the_lowest_failing_item) {
  for (const Host& host : hosts()) {
    HostExecutor executor(3, host.call);
    const Status status =
        for_each({.team = &executor}, {.name = "failing", .n = 500}, [](std::size_t i) -> Status {
          if (i % 97 == 96) return Error{ErrorCode::input, std::to_string(i), {}, {}};
          return {};
        });
    ASSERT_FALSE(status) << host.name;
    EXPECT_EQ(status.error().message, "96") << host.name;
  }
}

}  // namespace
}  // namespace strake::parallel
