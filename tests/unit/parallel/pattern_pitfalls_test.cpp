// SPDX-License-Identifier: Apache-2.0
// Parallel code as it is often written, what is wrong with it, and the pattern that is not. The
// pages in docs/patterns have a section "Wrong, and right" for each.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

#include "strake/parallel/bounded_queue.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"
#include "support/queue_handover.hpp"

namespace strake::parallel {
namespace {

using test::End;
using test::Handover;

/// A producer that locks to wait for room, and once more to push.
[[noreturn]] void produce_with_two_locks() {
  std::mutex mutex;
  std::vector<int> queue;
  alarm(1);  // ends the process, not the hang: nothing else ever would
  const std::unique_lock waiting(mutex);
  mutex.lock();
  queue.push_back(1);
  mutex.unlock();
  std::_Exit(0);
}

TEST(WrongQueue, locking_what_a_unique_lock_holds_hangs) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(produce_with_two_locks(), testing::KilledBySignal(SIGALRM), "");
}

TEST(WrongQueue, a_flag_raised_outside_the_lock_is_missed) {
  for (const unsigned items : {1U, 2U, 3U})
    EXPECT_TRUE(Handover(End::flag_outside_lock, items).explored().can_hang) << items;
}

TEST(WrongQueue, a_count_that_passes_its_end_leaves_a_consumer_asleep) {
  EXPECT_FALSE(Handover(End::count_of_items, 1).explored().can_hang) << "right for one item only";
  for (const unsigned items : {2U, 3U, 4U})
    EXPECT_TRUE(Handover(End::count_of_items, items).explored().can_hang) << items;
}

TEST(RightQueue, a_flag_raised_under_the_lock_never_hangs) {
  for (const unsigned items : {1U, 2U, 3U, 4U, 9U}) {
    const test::Interleavings all = Handover(End::flag_under_lock, items).explored();
    EXPECT_FALSE(all.can_hang) << items;
    EXPECT_GT(all.states, 40U * items) << "schedules were tried";
  }
}

TEST(RightQueue, the_bounded_queue_ends_with_everything_consumed) {
  constexpr unsigned kProducers = 3, kConsumers = 2, kItems = 500;
  for (int round = 0; round < 20; ++round) {
    BoundedQueue<unsigned> queue(2);
    std::atomic<unsigned> producing{kProducers}, sum{0};
    std::vector<std::jthread> threads;
    for (unsigned p = 0; p < kProducers; ++p)
      threads.emplace_back([&] {
        for (unsigned i = 1; i <= kItems; ++i) EXPECT_TRUE(queue.push(unsigned{i}));
        if (--producing == 0) queue.close();
      });
    for (unsigned c = 0; c < kConsumers; ++c)
      threads.emplace_back([&] {
        while (const auto item = queue.pop()) sum += *item;
      });
    threads.clear();
    EXPECT_EQ(sum, kProducers * kItems * (kItems + 1) / 2);
  }
}

TEST(WrongLoop, the_product_of_two_counts_does_not_fit_an_int) {
  int product = 0;
  EXPECT_TRUE(__builtin_mul_overflow(50'000, 50'000, &product));
  EXPECT_LT(product, 0) << "a loop up to it does nothing at all";
  const Shape2 shape{50'000, 50'000};
  EXPECT_EQ(shape.size(), 2'500'000'000U);
  EXPECT_EQ(shape.index(shape.size() - 1), (Shape2::Index{49'999, 49'999}));
}

struct Observation {
  double depth = 0;
  unsigned id = 0;
};

/// The nearest first, in the manner of qsort; never says "equal".
int compare_depths(const Observation& a, const Observation& b) {
  return a.depth >= b.depth ? -1 : 1;
}

bool wrong_before(const Observation& a, const Observation& b) { return compare_depths(a, b) < 0; }

bool right_before(const Observation& a, const Observation& b) {
  return a.depth != b.depth ? a.depth > b.depth : a.id < b.id;
}

/// What std::sort, qsort and every sorted container ask of an order.
template <class Before>
bool is_strict_weak_order(const std::vector<Observation>& values, Before&& before) {
  const auto equivalent = [&](const Observation& a, const Observation& b) {
    return !before(a, b) && !before(b, a);
  };
  for (const Observation& a : values)
    for (const Observation& b : values) {
      if (before(a, a) || (before(a, b) && before(b, a))) return false;
      for (const Observation& c : values)
        if ((before(a, b) && before(b, c) && !before(a, c)) ||
            (equivalent(a, b) && equivalent(b, c) && !equivalent(a, c)))
          return false;
    }
  return true;
}

/// By insertion, which ends whatever the order says: std::sort may read past its ends with the
/// wrong one.
template <class Before>
std::vector<unsigned> sorted_ids(std::vector<Observation> values, Before&& before) {
  for (std::size_t i = 1; i < values.size(); ++i)
    for (std::size_t k = i; k > 0 && before(values[k], values[k - 1]); --k)
      std::swap(values[k], values[k - 1]);
  std::vector<unsigned> ids;
  for (const Observation& value : values) ids.push_back(value.id);
  return ids;
}

TEST(WrongOrder, a_comparison_that_never_states_equal_is_no_order) {
  const std::vector<Observation> came{{5, 0}, {7, 1}, {5, 2}, {7, 3}, {1, 4}, {5, 5}};
  const std::vector<Observation> came_otherwise(came.rbegin(), came.rend());
  EXPECT_FALSE(is_strict_weak_order(came, wrong_before));
  EXPECT_NE(sorted_ids(came, wrong_before), sorted_ids(came_otherwise, wrong_before));
  EXPECT_TRUE(is_strict_weak_order(came, right_before));
  EXPECT_EQ(sorted_ids(came, right_before), (std::vector<unsigned>{1, 3, 0, 2, 5, 4}));
  EXPECT_EQ(sorted_ids(came_otherwise, right_before), sorted_ids(came, right_before));
}

struct Span {
  double lo = 0, hi = 0;
  friend bool operator==(const Span&, const Span&) = default;
};

void widen(Span& into, const Span& other) {
  into.lo = std::min(into.lo, other.lo);
  into.hi = std::max(into.hi, other.hi);
}

/// A result per worker, begun with the first item of the worker's range, all of them put together.
/// Reads outside the items are counted, not made.
Span span_by_worker(const std::vector<Span>& items, std::size_t workers, int& reads_outside) {
  std::vector<Span> of_worker(workers);
  for (std::size_t w = 0; w < workers; ++w) {
    const std::size_t share = (items.size() + workers - 1) / workers;
    const std::size_t from = w * share, to = std::min(from + share, items.size());
    if (from >= items.size()) {
      ++reads_outside;  // of_worker[w] stays as it was made
      continue;
    }
    of_worker[w] = items[from];
    for (std::size_t i = from + 1; i < to; ++i) widen(of_worker[w], items[i]);
  }
  Span all = items[0];
  for (const Span& span : of_worker) widen(all, span);
  return all;
}

TEST(WrongFold, workers_without_items_fold_garbage) {
  const std::vector<Span> items{{100, 110}, {104, 120}, {90, 95}, {101, 102}, {108, 130}};
  const Span right{90, 130};
  int outside = 0;
  EXPECT_EQ(span_by_worker(items, 5, outside), right);
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(span_by_worker(items, 4, outside), (Span{0, 130})) << "the origin, where nothing is";
  EXPECT_EQ(outside, 1);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  for (const unsigned workers : {1U, 2U, 4U, 8U, 64U}) {
    Team team(workers);
    const auto whole = reduce(
        {.team = &team}, {.name = "span", .n = items.size()}, Span{kFar, -kFar},
        [&](Span& span, std::size_t i) { widen(span, items[i]); }, widen);
    ASSERT_TRUE(whole);
    EXPECT_EQ(*whole, right) << workers;
  }
}

constexpr std::size_t kTerms = 1000;

double term(std::size_t i) { return 1.0 / static_cast<double>(i + 1); }

/// What a worker each has put together, worker after worker. Worker of item i: of(i).
template <class Of>
std::vector<std::size_t> joined_by_worker(unsigned workers, Of&& of) {
  std::vector<std::size_t> order;
  for (unsigned w = 0; w < workers; ++w)
    for (std::size_t i = 0; i < kTerms; ++i)
      if (of(i) == w) order.push_back(i);
  return order;
}

template <class Of>
double sum_by_worker(unsigned workers, Of&& of) {
  std::vector<double> sums(workers, 0.0);
  for (std::size_t i = 0; i < kTerms; ++i) {
    const std::size_t worker = of(i);
    sums[worker] += term(i);
  }
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

TEST(WrongFold, what_is_joined_by_worker_depends_on_who_did_what) {
  // Three schedules that a counter may give the same three workers.
  const auto ranges = [](std::size_t i) { return i * 3 / kTerms; };
  const auto in_turn = [](std::size_t i) { return i % 3; };
  const auto one_was_late = [](std::size_t i) { return i < 10 ? i % 2 : i % 3; };
  const std::set<std::vector<std::size_t>> lists{
      joined_by_worker(3, ranges), joined_by_worker(3, in_turn), joined_by_worker(3, one_was_late)};
  EXPECT_EQ(lists.size(), 3U);
  const std::set<double> sums{sum_by_worker(3, ranges), sum_by_worker(3, in_turn),
                              sum_by_worker(3, one_was_late)};
  EXPECT_GT(sums.size(), 1U);
  std::set<std::vector<std::size_t>> right_lists;
  std::set<std::uint64_t> right_sums;
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const auto list = collect<std::size_t>(
        {.team = &team}, {.name = "list", .n = kTerms},
        [](std::size_t i, std::vector<std::size_t>& out) { out.push_back(i); });
    const auto sum = reduce(
        {.team = &team}, {.name = "sum", .n = kTerms, .grain = 64}, 0.0,
        [](double& partial, std::size_t i) { partial += term(i); },
        [](double& into, double partial) { into += partial; });
    ASSERT_TRUE(list && sum);
    right_lists.insert(*list);
    right_sums.insert(std::bit_cast<std::uint64_t>(*sum));
  }
  EXPECT_EQ(right_lists.size(), 1U);
  EXPECT_TRUE(std::ranges::is_sorted(*right_lists.begin()));
  EXPECT_EQ(right_sums.size(), 1U);
}

/// Items that each add to one place, one at a time but in any order: all sums and all logs that
/// schedules can leave there.
struct Left {
  std::set<double> sums;
  std::set<std::vector<std::size_t>> logs;
};

constexpr std::array kAdded = {1e16, 1.0, -1e16, 1.0};

Left left_by_all_orders() {
  std::vector<std::size_t> order(kAdded.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Left left;
  do {
    double sum = 0;
    for (const std::size_t i : order) sum += kAdded[i];
    left.sums.insert(sum);
    left.logs.insert(order);
  } while (std::ranges::next_permutation(order).found);
  return left;
}

TEST(WrongFlag, one_writer_at_a_time_still_leaves_the_order_to_timing) {
  const Left left = left_by_all_orders();
  EXPECT_EQ(left.sums.size(), 3U) << "0, 1 and 2";
  EXPECT_EQ(left.logs.size(), 24U);
  // The items take the place in their order, or the place asks the items.
  std::set<double> sums;
  std::set<std::vector<std::size_t>> logs;
  for (const unsigned workers : {1U, 2U, 4U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team};
    double reserved = 0;
    std::vector<std::size_t> log;
    ASSERT_TRUE(for_each_reserved(
        context, {.name = "reserved", .n = kAdded.size()}, 1,
        [](std::size_t, Claims& claims) { claims(0); },
        [&](std::size_t i) {
          reserved += kAdded[i];
          log.push_back(i);
        }));
    const auto gathered = transform(context, {.name = "gathered", .n = 1}, [](std::size_t) {
      double sum = 0;
      for (const double added : kAdded) sum += added;
      return sum;
    });
    ASSERT_TRUE(gathered);
    sums.insert({reserved, gathered->front()});
    logs.insert(log);
  }
  EXPECT_EQ(sums, std::set<double>{1.0}) << "that of the plain loop";
  EXPECT_EQ(logs.size(), 1U);
}

}  // namespace
}  // namespace strake::parallel
