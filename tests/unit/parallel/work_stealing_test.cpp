// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/detail/work_stealing.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "intel_syntax.hpp"
#include "strake/parallel/detail/load_relaxed.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/team.hpp"
#include "support/reversed_executor.hpp"

namespace strake::parallel::detail {
namespace {

using Rest = WorkStealingShares::Rest;

/// The numbers [first, n) and then [0, first).
std::vector<std::size_t> from(std::size_t first, std::size_t n) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < n; ++i) numbers.push_back((first + i) % n);
  return numbers;
}

/// Workers that take one chunk after the other, in an order that chance decides; with one seat,
/// whatever the number of shares, as where the team is busy.
std::vector<int> takers_of(std::size_t n, std::size_t shares, std::size_t chunk, Rest rest,
                           unsigned seats) {
  WorkStealingShares dealt;
  dealt.deal(n, shares, chunk, rest);
  std::vector<int> times(n, 0);
  std::vector<std::pair<Seat, WorkerShare>> workers;
  for (unsigned i = 0; i < seats; ++i) {
    const Seat seat{i, seats};
    workers.emplace_back(seat, dealt.share_of(seat));
  }
  std::mt19937 random(7);
  while (!workers.empty()) {
    const std::size_t turn = random() % workers.size();
    auto& [seat, hand] = workers[turn];
    if (dealt.take(hand, seat)) {
      EXPECT_LT(hand.position, hand.end);
      for (; hand.position < hand.end; ++hand.position) ++times.at(hand.position);
    } else {
      EXPECT_FALSE(dealt.take(hand, seat)) << "nothing comes after nothing";
      workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(turn));
    }
  }
  return times;
}

TEST(WorkStealingShares, each_position_is_taken_once) {
  for (const std::size_t n : {0U, 1U, 2U, 7U, 63U, 64U, 65U, 1000U})
    for (const unsigned shares : {1U, 2U, 3U, 8U, 64U})
      for (const std::size_t chunk : {1U, 3U, 1000U})
        for (const Rest rest : {Rest::free, Rest::kept})
          for (const unsigned seats : {1U, shares}) {
            SCOPED_TRACE(::testing::Message() << n << " in " << shares << " by " << chunk << " for "
                                              << seats << (rest == Rest::free ? "" : " kept"));
            EXPECT_EQ(takers_of(n, shares, chunk, rest, seats), std::vector<int>(n, 1));
          }
}

TEST(WorkStealingShares, one_share_is_dealt_out_to_all_in_ascending_order) {
  WorkStealingShares dealt;
  dealt.deal(10, 1, 1, Rest::free);
  std::vector<WorkerShare> hands;
  for (unsigned i = 0; i < 3; ++i) hands.push_back(dealt.share_of({i, 3}));
  for (unsigned i = 0; i < 10; ++i) {
    WorkerShare& hand = hands[i % 3];
    ASSERT_TRUE(dealt.take(hand, {i % 3, 3}));
    EXPECT_EQ(hand.position, i);
  }
}

TEST(WorkStealingShares, neighbours_stay_with_a_worker_and_what_is_left_goes_to_all) {
  WorkStealingShares dealt;
  dealt.deal(30, 3, 1, Rest::free);
  const Seat seat{1, 3};
  WorkerShare hand = dealt.share_of(seat);
  std::vector<std::size_t> taken;
  while (dealt.take(hand, seat)) taken.push_back(hand.position);
  EXPECT_EQ(taken, from(10, 30));
}

TEST(WorkStealingShares, kept_each_gets_its_own_at_once_and_no_more) {
  WorkStealingShares dealt;
  dealt.deal(11, 3, 1, Rest::kept);
  const std::vector<std::pair<std::size_t, std::size_t>> expected{{0, 4}, {4, 8}, {8, 11}};
  for (unsigned i = 0; i < 3; ++i) {
    const Seat seat{i, 3};
    WorkerShare hand = dealt.share_of(seat);
    ASSERT_TRUE(dealt.take(hand, seat));
    EXPECT_EQ(std::pair(hand.position, hand.end), expected[i]);
    EXPECT_FALSE(dealt.take(hand, seat));
  }
}

TEST(WorkStealingShares, what_is_left_of_a_share_can_be_passed_over) {
  WorkStealingShares dealt;
  dealt.deal(30, 3, 4, Rest::free);
  const Seat seat{0, 3};
  WorkerShare hand = dealt.share_of(seat);
  std::vector<std::size_t> taken;
  while (dealt.take(hand, seat)) {
    taken.push_back(hand.position);
    dealt.leave(hand, seat);
    EXPECT_EQ(hand.position, hand.end);
  }
  EXPECT_EQ(taken, (std::vector<std::size_t>{0, 10, 20}));
}

TEST(WorkStealingShares, counters_do_not_come_round_again) {
  constexpr std::size_t kMax = std::numeric_limits<std::size_t>::max();
  for (const unsigned shares : {1U, 3U}) {
    WorkStealingShares dealt;
    dealt.deal(kMax, shares, 1, Rest::kept);
    std::size_t sum = 0;
    for (unsigned i = 0; i < shares; ++i) {
      const Seat seat{i, shares};
      WorkerShare hand = dealt.share_of(seat);
      ASSERT_TRUE(dealt.take(hand, seat));
      sum += hand.end - hand.position;
      EXPECT_FALSE(dealt.take(hand, seat));
    }
    EXPECT_EQ(sum, kMax);
  }
}

TEST(WorkStealingShares, threads_take_each_position_once) {
  for (const unsigned workers : {2U, 8U, 64U}) {
    constexpr std::size_t kItems = 64 * 200;
    WorkStealingShares dealt;
    dealt.deal(kItems, workers, 1, Rest::free);
    std::vector<int> times(kItems, 0);  // not atomic: two that take the same are a race
    {
      std::vector<std::jthread> threads;
      for (unsigned i = 0; i < workers; ++i)
        threads.emplace_back([&, seat = Seat{i, workers}] {
          WorkerShare hand = dealt.share_of(seat);
          while (dealt.take(hand, seat)) ++times[hand.position++];
        });
    }
    EXPECT_EQ(times, std::vector<int>(kItems, 1));
  }
}

/// The items of a region in the order in which two workers visit them, the second one first.
std::vector<std::size_t> visits(const Region& region) {
  HostExecutor host = strake::test::second_first();
  std::vector<std::size_t> visited;
  EXPECT_TRUE(for_each({.team = &host}, region, [&](std::size_t i) { visited.push_back(i); }));
  return visited;
}

TEST(WorkStealingShares, of_a_region_are_for_many_blocks) {
  EXPECT_EQ(visits({.n = 200}), from(100, 200));
  EXPECT_EQ(visits({.n = 200, .chunk = 7}), from(100, 200));
  EXPECT_EQ(visits({.n = 400, .grain = 2}), from(200, 400));
  EXPECT_EQ(visits({.n = 100}), from(0, 100)) << "few blocks: low ones first";
  EXPECT_EQ(visits({.n = 200, .grain = 2}), from(0, 200)) << "few blocks: low ones first";
}

TEST(WorkStealingShares, of_a_static_region_are_kept) {
  // Otherwise the second worker would go on with the first one's before that has its turn: the
  // visits would be the same, so worker contexts tell who it was.
  HostExecutor host = strake::test::second_first();
  int made = 0;
  std::vector<int> visitors(200, 0);
  ASSERT_TRUE(for_each_with(
      {.team = &host}, {.n = 200, .schedule = Schedule::static_blocks}, [&] { return ++made; },
      [&](const int& worker, std::size_t i) { visitors[i] = worker; }));
  for (std::size_t i = 0; i < 200; ++i) ASSERT_EQ(visitors[i], i < 100 ? 2 : 1) << i;
}

TEST(WorkStealingShares, there_is_one_where_an_order_is_given) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < 200; ++i) order.push_back(i * 3 % 200);
  const std::vector<std::size_t> expected(order.begin(), order.end());
  EXPECT_EQ(visits({.n = 200, .order = order}), expected);
}

/// A loop that looked at the limit only once, before it, would not end in a day.
TEST(Relaxed, polls_every_time) {
  std::stop_source source;
  std::atomic<bool> running{false};
  std::thread outside([&] {
    while (!running) std::this_thread::yield();
    source.request_stop();
  });
  std::vector<float> out(1024, 0);  // nothing that a compiler could take for the limit
  const Status status = for_each_with(
      {.stop = source.get_token()}, {.n = std::size_t{1} << 50U},
      [&] {
        running = true;
        return NoContext{};
      },
      [&](NoContext&, std::size_t i) { out[i % 1024] += 1; });
  outside.join();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

TEST(Relaxed, is_a_load_in_either_syntax) {
  const std::atomic<std::size_t> word{12345};
  EXPECT_EQ(load_relaxed(word), 12345U);
  EXPECT_EQ(parallel::test::relaxed_in_intel_syntax(word), 12345U);
  EXPECT_EQ(word.load(), 12345U);
}

/// Hangs, and runs into the test's time-out, if what a busy worker has not begun were left to it.
TEST(WorkStealingShares, a_worker_that_is_busy_keeps_nothing_from_the_others) {
  for (const unsigned workers : {2U, 3U, 64U}) {
    Team team(workers);
    if (team.size() == 1) continue;
    constexpr std::size_t kItems = 64 * 100;
    std::atomic<std::size_t> done{0};
    const Status status =
        for_each({.team = &team}, {.name = "one waits", .n = kItems}, [&](std::size_t i) {
          if (i == 0)
            while (done.load() < kItems - 1) std::this_thread::yield();
          ++done;
        });
    ASSERT_TRUE(status);
    EXPECT_EQ(done.load(), kItems);
  }
}

}  // namespace
}  // namespace strake::parallel::detail
