// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {
namespace {

TEST(Team, none_counts_as_one) {
  Team team(0);
  EXPECT_EQ(team.size(), 1U);
  int calls = 0;
  EXPECT_TRUE(team.run([&](Seat seat) {
    ++calls;
    EXPECT_EQ(seat.index, 0U);
    EXPECT_EQ(seat.count, 1U);
  }));
  EXPECT_EQ(calls, 1);
}

TEST(Team, every_seat_is_called_once_and_its_writes_are_seen) {
  for (const unsigned size : {1U, 2U, 3U, 8U, 64U}) {
    Team team(size);
    ASSERT_EQ(team.size(), size);
    for (int round = 0; round < 50; ++round) {
      std::vector<int> calls(size, 0);  // plain ints: a lost happens-before is a TSan report
      EXPECT_TRUE(team.run([&](Seat seat) {
        EXPECT_EQ(seat.count, size);
        ++calls[seat.index];
      }));
      EXPECT_EQ(calls, std::vector<int>(size, 1));
    }
  }
}

TEST(Team, worker_zero_is_the_caller) {
  Team team(3);
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<std::thread::id> ids(3);
  team.run([&](Seat seat) { ids[seat.index] = std::this_thread::get_id(); });
  EXPECT_EQ(ids[0], caller);
  EXPECT_NE(ids[1], caller);
  EXPECT_NE(ids[1], ids[2]);
}

TEST(Team, nested_regions_run_alone_on_their_worker) {
  Team team(4);
  std::atomic<int> inner{0}, innermost{0};
  EXPECT_TRUE(team.run([&](Seat) {
    const std::thread::id self = std::this_thread::get_id();
    EXPECT_FALSE(team.run([&](Seat seat) {
      EXPECT_EQ(seat.count, 1U);
      EXPECT_EQ(std::this_thread::get_id(), self);
      ++inner;
      EXPECT_FALSE(team.run([&](Seat) { ++innermost; }));
    }));
  }));
  EXPECT_EQ(inner, 4);
  EXPECT_EQ(innermost, 4);
}

TEST(Team, nesting_three_deep_gives_the_sequential_result) {
  const auto build = [](const Context& context) {
    return transform(context, {.name = "outer", .n = 7}, [&](std::size_t i) {
      const auto middle = transform(context, {.name = "middle", .n = 5}, [&](std::size_t j) {
        const auto inner = transform(context, {.name = "inner", .n = 3},
                                     [&](std::size_t k) { return 100 * i + 10 * j + k; });
        return *inner;
      });
      return *middle;
    });
  };
  const auto expected = build({});
  ASSERT_TRUE(expected);
  for (const unsigned size : {2U, 5U}) {
    Team team(size);
    const auto got = build({.team = &team});
    ASSERT_TRUE(got);
    EXPECT_EQ(*got, *expected);
  }
}

TEST(Team, two_threads_may_share_a_team) {
  Team team(3);
  std::atomic<std::uint64_t> sum{0};
  const auto caller = [&] {
    for (int round = 0; round < 200; ++round) {
      const Status status =
          for_each({.team = &team}, {.name = "shared", .n = 10}, [&](std::size_t i) { sum += i; });
      EXPECT_TRUE(status);
    }
  };
  std::thread other(caller);
  std::thread third(caller);
  caller();
  other.join();
  third.join();
  EXPECT_EQ(sum, 3U * 200U * 45U);
}

TEST(Team, survives_many_empty_regions) {
  Team team(2);
  const Context context{.team = &team};
  for (int round = 0; round < 100'000; ++round) {
    team.run([](Seat) {});
    ASSERT_TRUE(for_each(context, {.name = "empty"}, [](std::size_t) { FAIL(); }));
  }
}

TEST(Team, many_may_be_built_and_torn_down) {
  std::atomic<int> calls{0};
  for (int round = 0; round < 10'000; ++round) {
    Team team(3);
    if (round % 2 == 0) team.run([&](Seat) { ++calls; });
  }
  EXPECT_EQ(calls, 15'000);
}

TEST(Team, an_absurd_size_is_bounded) {
  const Team team(1'000'000);
  EXPECT_LE(team.size(), Team::kMaxWorkers);
  EXPECT_GE(team.size(), 2U);
}

}  // namespace
}  // namespace strake::parallel
