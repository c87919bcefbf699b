// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/team.hpp"
#include "support/parallel_results.hpp"

namespace strake::parallel {
namespace {

constexpr std::array kAll{Distribution::planned, Distribution::in_order,
                          Distribution::equal_ranges};

std::string named(Distribution distribution, unsigned threads) {
  return "distribution " + std::to_string(static_cast<int>(distribution)) + ", threads " +
         std::to_string(threads);
}

TEST(Distribution, of_a_run_leaves_the_bytes_of_all_patterns_as_they_are) {
  for (const std::size_t grain : {1U, 7U, 5000U}) {
    const Region region{.name = "test", .n = test::kResultItems, .grain = grain};
    const test::Results expected = test::results({}, region, 0);
    const test::OwnResults own = test::own_results({}, region, 0);
    const auto order = longest_first(region.blocks(), [](std::size_t i) { return test::value(i); });
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      Team team(threads);
      for (const Distribution distribution : kAll) {
        const Context context{.team = &team, .distribution = distribution};
        Region ordered = region;
        ordered.order = order;
        EXPECT_EQ(test::results(context, ordered, threads), expected)
            << named(distribution, threads) << ", grain " << grain;
        EXPECT_EQ(test::own_results(context, region, threads), own)
            << named(distribution, threads) << ", grain " << grain;
      }
    }
  }
}

TEST(Distribution, coarser_chunks_leave_the_bytes_as_they_are) {
  const Region region{.name = "test", .n = test::kResultItems, .grain = 7};
  const test::Results expected = test::results({}, region, 0);
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    Team team(threads);
    for (const std::size_t chunk : {std::size_t{0}, std::size_t{16}, SIZE_MAX})
      EXPECT_EQ(test::results({.team = &team, .min_chunk = chunk}, region, threads), expected)
          << threads << " threads, chunks of " << chunk;
  }
}

/// Returns who ran each of the items.
std::vector<std::thread::id> workers_of(const Context& context, const Region& region) {
  std::vector<std::thread::id> workers(region.n);
  EXPECT_TRUE(
      for_each(context, region, [&](std::size_t i) { workers[i] = std::this_thread::get_id(); }));
  return workers;
}

TEST(Distribution, equal_ranges_are_each_one_workers) {
  constexpr std::size_t kItems = 1000;
  std::vector<std::uint32_t> backwards(kItems);
  std::iota(backwards.rbegin(), backwards.rend(), 0U);
  for (const unsigned threads : {2U, 4U, 8U}) {
    Team team(threads);
    const Context context{.team = &team, .distribution = Distribution::equal_ranges};
    const auto workers =
        workers_of(context, {.name = "test", .n = kItems, .chunk = 3, .order = backwards});
    const std::size_t range = kItems / threads;
    for (std::size_t i = 0; i < kItems; ++i)
      EXPECT_EQ(workers[i], workers[i / range * range]) << "item " << i;
    std::vector<std::thread::id> owners;
    for (unsigned w = 0; w < threads; ++w) owners.push_back(workers[w * range]);
    std::ranges::sort(owners);
    EXPECT_EQ(std::unique(owners.begin(), owners.end()) - owners.begin(), threads);
  }
}

TEST(Distribution, items_come_as_they_are_numbered_where_no_order_is_heeded) {
  constexpr std::size_t kItems = 100;
  std::vector<std::uint32_t> backwards(kItems);
  std::iota(backwards.rbegin(), backwards.rend(), 0U);
  for (const Distribution distribution : kAll) {
    std::vector<std::size_t> visited;
    const Context context{.distribution = distribution};
    ASSERT_TRUE(for_each(context, {.name = "test", .n = kItems, .order = backwards},
                         [&](std::size_t i) { visited.push_back(i); }));
    EXPECT_EQ(visited.size(), kItems);
    EXPECT_EQ(visited.front(), distribution == Distribution::planned ? kItems - 1 : 0U);
    EXPECT_EQ(std::ranges::is_sorted(visited), distribution != Distribution::planned);
  }
}

TEST(Distribution, an_order_that_is_no_permutation_is_an_error_all_the_same) {
  const std::vector<std::uint32_t> twice{0, 0, 1};
  for (const Distribution distribution : kAll)
    EXPECT_FALSE(for_each({.distribution = distribution}, {.name = "test", .n = 3, .order = twice},
                          [](std::size_t) {}));
}

TEST(Distribution, equal_ranges_set_no_heavy_item_apart) {
  constexpr std::size_t kItems = 400, kHeavy = 250;
  Team team(4);
  for (const Distribution distribution : kAll) {
    std::atomic<unsigned> with_team{0};
    std::atomic<std::size_t> runs{0};
    ASSERT_TRUE(for_each_by_weight(
        {.team = &team, .distribution = distribution}, {.name = "test", .n = kItems}, 1000,
        [](std::size_t i) { return i == kHeavy ? 1e6 : 1.0; },
        [&](std::size_t) {
          ++runs;
          if (team.run([](Seat) {})) ++with_team;
        }));
    EXPECT_EQ(runs, kItems);
    EXPECT_EQ(with_team, distribution == Distribution::equal_ranges ? 0U : 1U);
  }
}

}  // namespace
}  // namespace strake::parallel
