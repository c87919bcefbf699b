// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <vector>

#include "strake/parallel/allowance.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/optional_lock.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

/// Counts how often it is locked, and how deep.
struct CountingMutex {
  int locked = 0, depth = 0;
  void lock() {
    ++locked;
    ++depth;
  }
  void unlock() { --depth; }
};

TEST(OptionalLock, locks_only_where_there_are_others) {
  Team one(1), two(2);
  CountingMutex mutex;
  for (Executor* const team : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&one)}) {
    const OptionalLock lock(mutex, {.team = team});
    EXPECT_FALSE(lock.owns_lock());
    EXPECT_EQ(mutex.locked, 0);
  }
  {
    const OptionalLock lock(mutex, {.team = &two});
    EXPECT_TRUE(lock.owns_lock());
    EXPECT_EQ(mutex.depth, 1);
  }
  EXPECT_EQ(mutex.locked, 1);
  EXPECT_EQ(mutex.depth, 0);
}

TEST(OptionalLock, leaves_by_an_exception_unlocked) {
  Team team(2);
  CountingMutex mutex;
  EXPECT_THROW(
      {
        const OptionalLock lock(mutex, {.team = &team});
        throw 1;
      },
      int);
  EXPECT_EQ(mutex.depth, 0);
}

/// What one thread at a time may do: a sum without atomics, in two steps.
template <class Mutex>
void guards_a_sum() {
  for (const unsigned threads : {1U, 2U, 8U}) {
    Team team(threads);
    const Context context{.team = &team};
    Mutex mutex;
    std::array<std::uint64_t, 2> sums{};
    ASSERT_TRUE(for_each(context, {.name = "sum", .n = 20000}, [&](std::size_t i) {
      const OptionalLock lock(mutex, context);
      sums[0] += i;
      sums[1] = sums[0];
    }));
    EXPECT_EQ(sums[0], 20000ULL * 19999 / 2);
    EXPECT_EQ(sums[1], sums[0]);
  }
}
TEST(OptionalLock, guards_with_a_mutex) { guards_a_sum<std::mutex>(); }
TEST(OptionalLock, guards_with_a_recursive_mutex) { guards_a_sum<std::recursive_mutex>(); }
TEST(OptionalLock, guards_with_a_shared_mutex) { guards_a_sum<std::shared_mutex>(); }

TEST(OptionalLock, a_recursive_mutex_may_be_held_twice_by_one_worker) {
  Team team(4);
  const Context context{.team = &team};
  std::recursive_mutex mutex;
  std::uint64_t sum = 0;
  const auto add = [&](std::uint64_t value) {
    const OptionalLock lock(mutex, context);
    sum += value;
  };
  std::uint64_t expected = 0;
  // A region of one item leaves the team free for one inside it, whose workers would wait for the
  // mutex that this item holds, and it for them. So what is inside has no team.
  for (const std::size_t n : {1U, 500U}) {
    ASSERT_TRUE(for_each(context, {.name = "outer", .n = n}, [&](std::size_t i) {
      const OptionalLock lock(mutex, context);
      add(i);
      EXPECT_TRUE(for_each({}, {.name = "inner", .n = 10}, [&](std::size_t) { add(1); }));
    }));
    expected += n * (n - 1) / 2 + n * 10;
    EXPECT_EQ(sum, expected);
  }
}

TEST(ItemLocks, one_writer_at_a_time_for_each_item) {
  constexpr std::size_t kItems = 7, kWrites = 100000;
  for (const unsigned threads : {1U, 2U, 8U, 64U}) {
    Team team(threads);
    ItemLocks locks(kItems);
    std::vector<std::array<std::uint64_t, 2>> sums(kItems);
    ASSERT_TRUE(for_each({.team = &team}, {.name = "scatter", .n = kWrites, .grain = 100},
                         [&](std::size_t i) {
                           auto& sum = sums[i % kItems];
                           const auto held = locks.hold(i % kItems);
                           sum[0] += i;
                           sum[1] = sum[0];
                         }));
    std::uint64_t total = 0;
    for (const auto& sum : sums) {
      EXPECT_EQ(sum[0], sum[1]);
      total += sum[0];
    }
    EXPECT_EQ(total, std::uint64_t{kWrites} * (kWrites - 1) / 2);
    if (threads == 1) {
      EXPECT_EQ(locks.waits(), 0U);
    }
  }
}

TEST(ItemLocks, one_item_does_not_keep_out_of_another) {
  ItemLocks locks(2);
  const auto first = locks.hold(0);
  const auto second = locks.hold(1);
  EXPECT_EQ(locks.waits(), 0U);
}

TEST(ItemLocks, who_waits_is_counted_and_goes_on) {
  // The holder lets go once it has seen the other wait: deterministic, under the test's time-out.
  Team team(2);
  ItemLocks locks(1);
  Marks held(1);
  bool entered = false;
  ASSERT_TRUE(for_each({.team = &team}, {.name = "two", .n = 2}, [&](std::size_t i) {
    if (i == 0) {
      const auto lock = locks.hold(0);
      held.set(0);
      while (locks.waits() == 0) std::this_thread::yield();
    } else {
      while (!held.is_set(0)) std::this_thread::yield();
      const auto lock = locks.hold(0);
      entered = true;
    }
  }));
  EXPECT_TRUE(entered);
  EXPECT_EQ(locks.waits(), 1U);
}

TEST(Marks, are_down_until_they_are_set) {
  constexpr std::size_t kItems = 10000;
  for (const unsigned threads : {1U, 2U, 8U}) {
    Team team(threads);
    Marks marks(kItems);
    EXPECT_EQ(marks.size(), kItems);
    EXPECT_FALSE(marks.is_set(0));
    // Several set each, others read meanwhile.
    ASSERT_TRUE(for_each({.team = &team}, {.name = "marks", .n = 4 * kItems}, [&](std::size_t i) {
      if (const std::size_t item = i % kItems; item % 3 == 0 && !marks.is_set(item))
        marks.set(item);
    }));
    for (std::size_t i = 0; i < kItems; ++i) ASSERT_EQ(marks.is_set(i), i % 3 == 0) << i;
    EXPECT_EQ(marks.count(), (kItems + 2) / 3);
  }
  EXPECT_EQ(Marks().size(), 0U);
}

TEST(Allowance, is_used_up_to_the_last_and_no_further) {
  Allowance five(5);
  EXPECT_EQ(five.limit(), 5U);
  EXPECT_TRUE(five.take(3));
  EXPECT_TRUE(five.take(2));
  EXPECT_TRUE(five.take(0));
  EXPECT_FALSE(five.take(1));
  EXPECT_FALSE(five.take(0)) << "once refused, always refused";
}

TEST(Allowance, does_not_overflow) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  Allowance small(1);
  EXPECT_TRUE(small.take(1));
  EXPECT_FALSE(small.take(kMax));
  EXPECT_FALSE(small.take(kMax));
  Allowance all(kMax);
  EXPECT_EQ(all.limit(), kMax - 1);
  EXPECT_TRUE(all.take(kMax - 1));
  EXPECT_FALSE(all.take(1));
  EXPECT_FALSE(Allowance(kMax).take(kMax));
}

TEST(Allowance, whether_all_fits_does_not_depend_on_the_team) {
  constexpr std::uint64_t kNeeded = 1000 * 999 / 2;
  for (const unsigned threads : {1U, 2U, 8U})
    for (const std::uint64_t limit : {kNeeded - 1, kNeeded}) {
      Team team(threads);
      Allowance allowance(limit);
      const Status status =
          for_each({.team = &team}, {.name = "takes", .n = 1000}, [&](std::size_t i) -> Status {
            if (allowance.take(i)) return {};
            return Error{ErrorCode::input, "too many", {}, {}};
          });
      EXPECT_EQ(static_cast<bool>(status), limit == kNeeded);
    }
}

}  // namespace
}  // namespace strake::parallel
