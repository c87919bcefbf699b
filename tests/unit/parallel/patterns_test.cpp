// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <thread>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"
#include "support/parallel_results.hpp"

namespace strake::parallel {
namespace {

using test::results;
using test::Results;
using test::value;

TEST(Patterns, same_bytes_for_any_team_schedule_chunk_and_order) {
  constexpr unsigned kSeed = 20250117;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const std::size_t grain : {1U, 7U, 100U, 5000U}) {
    Region region{.name = "test", .n = test::kResultItems, .grain = grain};
    const Results expected = results({}, region, 0);
    ASSERT_EQ(expected.item_runs, test::kResultItems);
    std::vector<std::uint32_t> shuffled =
        longest_first(region.blocks(), [](std::size_t i) { return value(i); });
    std::shuffle(shuffled.begin(), shuffled.end(), std::minstd_rand(kSeed));
    for (const unsigned threads : {1U, 2U, 3U, 5U, 8U, 16U, 33U, 64U}) {
      Team team(threads);
      for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks})
        for (const std::size_t chunk : {1U, 3U, 50U})
          for (const bool ordered : {false, true}) {
            region.schedule = schedule;
            region.chunk = chunk;
            region.order = ordered ? std::span<const std::uint32_t>(shuffled)
                                   : std::span<const std::uint32_t>();
            EXPECT_EQ(results({.team = &team}, region, kSeed + threads), expected)
                << "threads " << threads << ", grain " << grain << ", chunk " << chunk
                << ", static " << (schedule == Schedule::static_blocks) << ", ordered " << ordered;
          }
    }
  }
}

TEST(Patterns, that_order_their_items_themselves_give_the_same_bytes_too) {
  for (const std::size_t grain : {1U, 7U, 5000U}) {
    Region region{.name = "test", .n = test::kResultItems, .grain = grain};
    const test::OwnResults expected = test::own_results({}, region, 0);
    for (const std::size_t size :
         {expected.nested.size(), expected.by_weight.size(), expected.kinds.size(),
          expected.precomputed.size(), expected.owners.size(), expected.by_piece.size(),
          expected.piped.size()})
      ASSERT_GT(size, 50U) << "every pattern has a result";
    for (const unsigned threads : {1U, 2U, 3U, 8U, 17U, 64U}) {
      Team team(threads);
      for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks}) {
        region.schedule = schedule;
        region.chunk = threads % 3 + 1;
        EXPECT_EQ(test::own_results({.team = &team}, region, threads), expected)
            << "threads " << threads << ", grain " << grain << ", static "
            << (schedule == Schedule::static_blocks);
      }
    }
  }
}

TEST(Patterns, sum_is_that_of_blocks_folded_in_order) {
  const Region region{.name = "sum", .n = test::kResultItems, .grain = 64};
  double expected = 0;
  for (std::size_t first = 0; first < test::kResultItems; first += 64) {
    double partial = 0;
    for (std::size_t i = first; i < std::min(test::kResultItems, first + 64); ++i)
      partial += value(i);
    expected += partial;
  }
  const auto got = reduce(
      {}, region, 0.0, [](double& partial, std::size_t i) { partial += value(i); },
      [](double& into, const double& partial) { into += partial; });
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*got), std::bit_cast<std::uint64_t>(expected));
}

TEST(Patterns, nothing_to_do_is_not_an_error) {
  Team team(3);
  const Context context{.team = &team};
  EXPECT_TRUE(transform(context, {.name = "none"}, [](std::size_t i) { return i; })->empty());
  EXPECT_TRUE(
      collect<int>(context, {.name = "none"}, [](std::size_t, std::vector<int>&) {})->empty());
  const auto packed = count_fill<int>(
      context, {.name = "none"}, [](std::size_t) { return std::size_t{1}; },
      [](std::size_t, std::span<int>) {});
  EXPECT_EQ(packed->size(), 0U);
  const auto total =
      reduce(context, {.name = "none"}, 5, [](int&, std::size_t) {}, [](int& a, int b) { a += b; });
  EXPECT_EQ(*total, 5);
}

TEST(Patterns, contexts_belong_to_one_worker_and_one_region) {
  struct Scratch {
    std::thread::id made_on = std::this_thread::get_id();
    std::size_t used = 0;
  };
  Team team(4);
  for (int round = 0; round < 20; ++round) {
    std::atomic<unsigned> made{0};
    std::atomic<std::size_t> fresh{0};
    const Status status = for_each_with(
        {.team = &team}, {.name = "scratch", .n = 500},
        [&] {
          ++made;
          return Scratch();
        },
        [&](Scratch& scratch, std::size_t) {
          EXPECT_EQ(scratch.made_on, std::this_thread::get_id());
          if (scratch.used++ == 0) ++fresh;
        });
    ASSERT_TRUE(status);
    EXPECT_GE(made, 1U);
    EXPECT_LE(made, 4U);
    EXPECT_EQ(fresh, made);
  }
}

TEST(Patterns, contexts_are_made_only_for_workers_that_get_an_item) {
  Team team(8);
  std::atomic<int> made{0};
  ASSERT_TRUE(for_each_with(
      {.team = &team}, {.name = "two items", .n = 2},
      [&] {
        ++made;
        return 0;
      },
      [](int&, std::size_t) {}));
  EXPECT_LE(made, 2);
}

TEST(Patterns, results_may_be_moved_only) {
  Team team(3);
  auto boxes = transform({.team = &team}, {.name = "boxes", .n = 20},
                         [](std::size_t i) { return std::make_unique<std::size_t>(i); });
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(*(*boxes)[i], i);
  auto some = collect<std::unique_ptr<std::size_t>>(
      {.team = &team}, {.name = "some", .n = 20},
      [](std::size_t i, std::vector<std::unique_ptr<std::size_t>>& out) {
        if (i % 2 == 0) out.push_back(std::make_unique<std::size_t>(i));
      });
  ASSERT_EQ(some->size(), 10U);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(*(*some)[k], 2 * k);
}

TEST(Order, longest_first_is_a_permutation_with_ties_by_index) {
  const std::vector<double> costs{1, 5, 5, 0, std::nan(""), 7, 1};
  EXPECT_EQ(longest_first(costs), (std::vector<std::uint32_t>{5, 1, 2, 0, 6, 3, 4}));
  EXPECT_TRUE(longest_first(std::span<const double>()).empty());
}

TEST(Order, many_are_sorted_as_few_are) {
  std::vector<double> costs{1e-320, -1, std::nan(""), HUGE_VAL, 1e300, 1e301, -HUGE_VAL, 0.5, 0};
  for (std::size_t i = 0; costs.size() < 5000; ++i) costs.push_back(std::fabs(value(i % 3000)));
  std::vector<std::uint32_t> expected(costs.size());
  std::iota(expected.begin(), expected.end(), 0U);
  const auto cost = [&](std::uint32_t i) {
    return costs[i] > 0 ? static_cast<float>(std::min(costs[i], 3e38)) : 0.0F;
  };
  std::ranges::sort(expected, [&](std::uint32_t a, std::uint32_t b) {
    return cost(a) != cost(b) ? cost(a) > cost(b) : a < b;
  });
  EXPECT_EQ(longest_first(costs), expected);
  for (const std::size_t few : {std::size_t{1}, std::size_t{9}, std::size_t{1023}}) {
    std::vector<std::uint32_t> those;
    std::ranges::copy_if(expected, std::back_inserter(those),
                         [&](std::uint32_t i) { return i < few; });
    EXPECT_EQ(longest_first(std::span(costs).first(few)), those);
  }
}

TEST(Order, of_the_wrong_length_is_refused) {
  const std::vector<std::uint32_t> order{0, 1};
  const Status status =
      for_each({}, {.name = "three", .n = 3, .order = order}, [](std::size_t) { FAIL(); });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::internal);
}

TEST(Heavy, what_cannot_be_shared_out_evenly_is_apart) {
  using Items = std::vector<std::uint32_t>;
  const std::vector<double> one{1, 100, 1, 2};
  EXPECT_EQ(heavy_items(one, 10, 2), Items{1});
  EXPECT_EQ(heavy_items(one, 101, 2), Items());  // not worth a team
  EXPECT_EQ(heavy_items(one, 10, 1), Items());   // nobody else waits
  const std::vector<double> equal{100, 100, 1, 2};
  EXPECT_EQ(heavy_items(equal, 10, 2), Items());
  EXPECT_EQ(heavy_items(equal, 10, 3), (Items{0, 1}));
  // One of three for two workers: the two others go side by side.
  EXPECT_EQ(heavy_items(std::vector<double>{50, 60, 50}, 10, 2), Items{1});
  EXPECT_EQ(heavy_items(std::vector<double>{std::nan(""), 60, -1, 0}, 10, 2), Items{1});
  EXPECT_EQ(heavy_items({}, 10, 2), Items());
  const std::vector<double> many(1000, 100);
  EXPECT_EQ(heavy_items(many, 10, 64), Items());
}

TEST(Heavy, every_item_runs_once_and_heavy_ones_have_the_team) {
  constexpr std::size_t kHeavy = 500;
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    Team team(threads);
    const Context context{.team = &team};
    for (const std::size_t grain : {1U, 7U}) {
      std::vector<int> runs(test::kResultItems, 0);
      std::vector<std::uint64_t> sums(test::kResultItems, 0);
      std::atomic<unsigned> with_team{0};
      const Status status = for_each_by_weight(
          context, {.name = "outer", .n = test::kResultItems, .grain = grain}, 1000,
          [](std::size_t i) { return i == kHeavy ? 1e6 : 1.0; },
          [&](std::size_t i) -> Status {
            ++runs[i];
            if (team.run([](Seat) {}) && threads > 1) ++with_team;
            const auto sum = reduce(
                context, {.name = "inner", .n = i, .grain = 16}, std::uint64_t{0},
                [](std::uint64_t& partial, std::size_t k) { partial += k; },
                [](std::uint64_t& into, const std::uint64_t& partial) { into += partial; });
            if (!sum) return sum.error();
            sums[i] = *sum;
            return {};
          });
      ASSERT_TRUE(status);
      for (std::size_t i = 0; i < test::kResultItems; ++i) {
        EXPECT_EQ(runs[i], 1);
        EXPECT_EQ(sums[i], i == 0 ? 0 : i * (i - 1) / 2);
      }
      EXPECT_EQ(with_team, threads > 1 ? 1U : 0U);
    }
  }
}

TEST(Heavy, errors_of_either_lot_end_it) {
  Team team(2);
  const Context context{.team = &team};
  for (const std::size_t bad : {3U, 5U}) {
    const Status status = for_each_by_weight(
        context, {.name = "outer", .n = 9}, 10, [](std::size_t i) { return i == 5 ? 100.0 : 1.0; },
        [&](std::size_t i) -> Status {
          if (i == bad) return Error{ErrorCode::internal, "item " + std::to_string(i), {}, {}};
          return {};
        });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "item " + std::to_string(bad));
  }
}

TEST(Shape2, products_do_not_overflow) {
  constexpr Shape2 kShape{50'000, 50'000};
  static_assert(kShape.size() == 2'500'000'000ULL);
  static_assert(kShape.index(2'499'999'999ULL) == Shape2::Index{49'999, 49'999});
  constexpr Shape2 kHuge{0xffffffffU, 0xffffffffU};
  static_assert(kHuge.index(kHuge.size() - 1) == Shape2::Index{0xfffffffeU, 0xfffffffeU});
  constexpr Shape2 kNone{10, 0};
  static_assert(kNone.size() == 0);
  std::uint64_t flat = 0;
  constexpr Shape2 kSmall{3, 4};
  for (std::uint32_t row = 0; row < 3; ++row)
    for (std::uint32_t column = 0; column < 4; ++column, ++flat) {
      EXPECT_EQ(kSmall.index(flat), (Shape2::Index{row, column}));
      EXPECT_EQ(kSmall.flat({row, column}), flat);
    }
}

TEST(Distinct, NumbersKindsByTheirFirstItemsForAnyTeam) {
  constexpr std::size_t kMany = 50'000;
  const auto key = [](std::size_t i) { return (i * i) % 7919; };
  std::map<std::size_t, std::uint32_t> known;
  Distinct expected;
  for (std::size_t i = 0; i < kMany; ++i) {
    const auto next = static_cast<std::uint32_t>(known.size());
    const auto [place, is_new] = known.try_emplace(key(i), next);
    if (is_new) expected.first.push_back(static_cast<std::uint32_t>(i));
    expected.of.push_back(place->second);
  }
  const auto same = [&](std::size_t i, std::size_t j) { return key(i) == key(j); };
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team, .stop = {}};
    // A good hash, and one that puts very different items side by side.
    for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{7} << 58U}) {
      const auto kinds = distinct(
          context, "kinds", kMany, [&](std::size_t i) { return mixed(0, key(i)) & mask; }, same);
      ASSERT_TRUE(kinds);
      EXPECT_EQ(kinds->of, expected.of);
      EXPECT_EQ(kinds->first, expected.first);
    }
  }
  const auto none = distinct({}, "none", 0, [](std::size_t) { return std::uint64_t{0}; }, same);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->of.empty() && none->first.empty());
}

}  // namespace
}  // namespace strake::parallel
