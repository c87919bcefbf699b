// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/reservations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "strake/parallel/progress.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

constexpr std::array kWorkers = {1U, 2U, 3U, 8U, 64U};

using Pair = std::array<std::uint32_t, 2>;

/// Pairs of places at random. `crowded`: a few places are in most of them.
std::vector<Pair> random_pairs(std::size_t n, std::uint32_t places, bool crowded) {
  std::mt19937 random(3);
  std::vector<Pair> pairs(n);
  for (Pair& pair : pairs)
    for (std::uint32_t& end : pair)
      end = static_cast<std::uint32_t>(random() % (crowded && random() % 4 != 0 ? 5 : places));
  return pairs;
}

/// Greedy matching: an item takes both of its places if nobody has one of them. Who has each.
std::vector<std::uint32_t> plain_matching(const std::vector<Pair>& pairs, std::uint32_t places) {
  std::vector<std::uint32_t> owner(places, 0);
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    if (owner[pairs[i][0]] == 0 && owner[pairs[i][1]] == 0)
      owner[pairs[i][0]] = owner[pairs[i][1]] = i + 1;
  return owner;
}

TEST(Reservations, gives_what_the_plain_loop_gives) {
  for (const bool crowded : {false, true}) {
    constexpr std::uint32_t kPlaces = 9000;
    const std::vector<Pair> pairs = random_pairs(30000, kPlaces, crowded);
    const std::vector<std::uint32_t> expected = plain_matching(pairs, kPlaces);
    std::set<std::array<std::uint64_t, 2>> runs;
    for (const unsigned workers : kWorkers)
      for (const std::size_t grain : {1UL, 7UL, 1000UL}) {
        Team team(workers);
        std::vector<std::uint32_t> owner(kPlaces, 0);
        const auto run = for_each_reserved(
            {.team = &team}, {.name = "matching", .n = pairs.size(), .grain = grain}, kPlaces,
            [&](std::size_t i, Claims& claims) {
              for (const std::uint32_t place : pairs[i]) claims(place);
              return owner[pairs[i][0]] == 0 && owner[pairs[i][1]] == 0;
            },
            [&](std::size_t i) {
              for (const std::uint32_t place : pairs[i])
                owner[place] = static_cast<std::uint32_t>(i) + 1;
            });
        ASSERT_TRUE(run);
        EXPECT_EQ(owner, expected);
        runs.insert({run->rounds, run->claims});
      }
    EXPECT_EQ(runs.size(), 1U) << "rounds must depend on the items alone";
  }
}

/// Where an answer may change, or hangs on what others' places stand for, the plain loop is another
/// algorithm: still one result for any team.
TEST(Reservations, what_breaks_the_rules_of_the_plain_loop_gives_one_result_all_the_same) {
  constexpr std::size_t kItems = 400;
  for (const bool reads_elsewhere : {false, true}) {
    std::set<std::vector<std::uint32_t>> results;
    for (const unsigned workers : kWorkers) {
      Team team(workers);
      std::vector<std::uint32_t> at(4, 0);
      ASSERT_TRUE(for_each_reserved(
          {.team = &team}, {.name = "odd", .n = kItems}, at.size(),
          [&](std::size_t i, Claims& claims) {
            claims(i % 4);
            // "Not yet" taken for "never", or a look at a place that is not requested.
            return reads_elsewhere ? at[(i + 1) % 4] % 3 != 2 : at[i % 4] % 3 == i % 3;
          },
          [&](std::size_t i) { at[i % 4] += 1 + static_cast<std::uint32_t>(i % 2); }));
      results.insert(at);
    }
    EXPECT_EQ(results.size(), 1U);
  }
}

TEST(Reservations, no_round_is_a_short_region) {
  constexpr std::size_t kItems = 6000;
  Team team(2);
  RunReport report;
  ASSERT_TRUE(for_each_reserved(
      {.team = &team, .report = &report}, {.name = "r", .n = kItems, .alone_below = kItems + 1},
      kItems, [](std::size_t i, Claims& claims) { claims(i); }, [](std::size_t) {}));
  for (const RegionReport& region : report.regions()) EXPECT_EQ(region.items, kItems);
}

TEST(Reservations, one_place_for_all_is_one_by_one_in_order) {
  constexpr std::size_t kItems = 20000;
  for (const unsigned workers : kWorkers) {
    Team team(workers);
    std::vector<std::size_t> log;
    const auto run = for_each_reserved(
        {.team = &team}, {.name = "log", .n = kItems}, 1,
        [](std::size_t /*i*/, Claims& claims) { claims(0); },
        [&](std::size_t i) { log.push_back(i); });
    ASSERT_TRUE(run);
    ASSERT_EQ(log.size(), kItems);
    EXPECT_TRUE(std::ranges::is_sorted(log));
    EXPECT_LT(run->claims, 5 * kItems) << "rounds in vain must become short";
  }
}

TEST(Reservations, items_that_share_nothing_need_few_rounds) {
  constexpr std::size_t kItems = 100000;
  Team team(2);
  std::vector<int> observed(kItems, 0);
  const auto run = for_each_reserved(
      {.team = &team}, {.name = "apart", .n = kItems, .grain = 64}, kItems,
      [](std::size_t i, Claims& claims) { claims(i); }, [&](std::size_t i) { ++observed[i]; });
  ASSERT_TRUE(run);
  EXPECT_EQ(run->claims, kItems);
  EXPECT_LT(run->rounds, 10U);
  EXPECT_EQ(std::ranges::count(observed, 1), static_cast<std::ptrdiff_t>(kItems));
}

/// Trees of a forest by pointers to parents: what an item requests changes with what others did.
std::size_t root(const std::vector<std::uint32_t>& parent, std::size_t node) {
  while (parent[node] != node) node = parent[node];
  return node;
}

TEST(Reservations, claims_that_change_give_one_result_too) {
  constexpr std::uint32_t kNodes = 5000;
  const std::vector<Pair> edges = random_pairs(20000, kNodes, false);
  std::set<std::vector<std::uint32_t>> forests;
  for (const unsigned workers : kWorkers) {
    Team team(workers);
    std::vector<std::uint32_t> parent(kNodes);
    std::iota(parent.begin(), parent.end(), 0U);
    std::vector<std::uint8_t> in_forest(edges.size(), 0);
    ASSERT_TRUE(for_each_reserved(
        {.team = &team}, {.name = "forest", .n = edges.size()}, kNodes,
        [&](std::size_t i, Claims& claims) {
          const std::size_t a = root(parent, edges[i][0]), b = root(parent, edges[i][1]);
          claims(a);
          claims(b);
          return a != b;
        },
        [&](std::size_t i) {
          const std::size_t a = root(parent, edges[i][0]), b = root(parent, edges[i][1]);
          parent[std::max(a, b)] = static_cast<std::uint32_t>(std::min(a, b));
          in_forest[i] = 1;
        }));
    // A forest that spans: as many edges as nodes less trees, and every edge is within a tree.
    std::size_t trees = 0;
    for (std::uint32_t node = 0; node < kNodes; ++node) trees += parent[node] == node ? 1U : 0U;
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(in_forest, 1)), kNodes - trees);
    for (const Pair& edge : edges) EXPECT_EQ(root(parent, edge[0]), root(parent, edge[1]));
    forests.insert(parent);
  }
  EXPECT_EQ(forests.size(), 1U);
}

struct Fault {
  std::size_t item;
  bool in_claim, throws;
};

void expect_error(unsigned workers, const std::vector<Fault>& faults, const std::string& expected) {
  constexpr std::size_t kItems = 10000;
  Team team(workers);
  std::vector<std::uint32_t> last(10, 0);
  const auto fail = [&](std::size_t i, bool in_claim) -> Status {
    for (const Fault& fault : faults) {
      if (fault.item != i || fault.in_claim != in_claim) continue;
      if (fault.throws) throw std::runtime_error("item " + std::to_string(i));
      return Error{ErrorCode::input, "item " + std::to_string(i), {}, {}};
    }
    return {};
  };
  // Ten places, so items go ten at a time at most: 9999 acts first of its round's many in vain.
  const auto run = for_each_reserved(
      {.team = &team}, {.name = "faulty", .n = kItems}, 10,
      [&](std::size_t i, Claims& claims) {
        if (!fail(i, true)) throw std::logic_error("claims do not return errors");
        claims(i % 10);
      },
      [&](std::size_t i) -> Status {
        EXPECT_LT(last[i % 10], i + 1);
        last[i % 10] = static_cast<std::uint32_t>(i) + 1;
        return fail(i, false);
      });
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().message, expected) << workers << " workers";
  // All below the one that failed have acted, as in a plain loop.
  const auto failed = static_cast<std::uint32_t>(std::stoul(expected.substr(5)));
  for (std::uint32_t place = 0; place < 10; ++place) {
    const std::uint32_t before = failed / 10 * 10 + place - (place < failed % 10 ? 0 : 10);
    EXPECT_GE(last[place], before + 1);
  }
}

TEST(Reservations, the_error_is_that_of_the_lowest_failing_item) {
  for (const unsigned workers : kWorkers) {
    expect_error(workers, {{5000, false, false}}, "item 5000");
    expect_error(workers, {{5000, false, true}, {7000, false, false}}, "item 5000");
    expect_error(workers, {{5000, true, true}}, "item 5000");
    // Item 31 is alone in asking for place 1 in the first round after 21; 30 has to wait.
    expect_error(workers, {{31, false, false}, {40, false, true}, {2000, true, true}}, "item 31");
    expect_error(workers, {{60, true, true}, {50, false, false}}, "item 50");
    expect_error(workers, {{50, true, true}, {60, false, false}}, "item 50");
  }
}

TEST(Reservations, a_lower_item_that_had_to_wait_still_has_the_last_word) {
  // Item 2 fails in the first round; item 1, in vain in that round, fails in the second.
  for (const unsigned workers : kWorkers) {
    Team team(workers);
    const auto run = for_each_reserved(
        {.team = &team}, {.name = "late", .n = 3}, 2,
        [](std::size_t i, Claims& claims) { claims(i / 2); },
        [](std::size_t i) -> Status {
          if (i == 0) return {};
          return Error{ErrorCode::input, "item " + std::to_string(i), {}, {}};
        });
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().message, "item 1");
  }
}

TEST(Reservations, wrong_use_is_an_error) {
  const auto claim_of = [](std::size_t place) {
    return [place](std::size_t /*i*/, Claims& claims) { claims(place); };
  };
  const auto nothing = [](std::size_t /*i*/) {};
  const auto beyond = for_each_reserved({}, {.name = "beyond", .n = 5}, 3, claim_of(3), nothing);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().message, "place 3 of 3");
  EXPECT_EQ(beyond.error().where, "region 'beyond', item 0");
  const std::vector<std::uint32_t> order = {1, 0};
  EXPECT_FALSE(for_each_reserved({}, {.n = 2, .order = order}, 3, claim_of(1), nothing));
  EXPECT_FALSE(for_each_reserved({}, {.n = SIZE_MAX}, 3, claim_of(1), nothing));
  EXPECT_EQ(for_each_reserved({}, {.n = 5}, SIZE_MAX / 2, claim_of(1), nothing).error().code,
            ErrorCode::memory);
}

TEST(Reservations, no_items_no_places_and_no_claims_are_fine) {
  Team team(3);
  const auto none = [](std::size_t /*i*/, Claims& /*claims*/) {};
  std::vector<int> observed(100, 0);
  const auto act = [&](std::size_t i) { ++observed[i]; };
  EXPECT_EQ(for_each_reserved({.team = &team}, {.n = 0}, 0, none, act)->rounds, 0U);
  EXPECT_EQ(for_each_reserved({.team = &team}, {.n = 100}, 0, none, act)->rounds, 1U);
  EXPECT_EQ(observed, std::vector<int>(100, 1));
}

TEST(Reservations, stops_when_it_is_requested_to) {
  for (const unsigned workers : kWorkers) {
    Team team(workers);
    std::stop_source source;
    const Context context{.team = &team, .stop = source.get_token()};
    const auto claim = [](std::size_t /*i*/, Claims& claims) { claims(0); };
    const auto run = for_each_reserved(context, {.n = 1'000'000}, 1, claim, [&](std::size_t i) {
      EXPECT_LE(i, 500U);
      if (i == 500) source.request_stop();
    });
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().code, ErrorCode::cancelled);
    EXPECT_FALSE(for_each_reserved(context, {.n = 0}, 1, claim, [](std::size_t /*i*/) {}));
  }
}

TEST(Reservations, progress_counts_the_items_and_reports_distinguish_claims) {
  Team team(2);
  Progress progress;
  RunReport report;
  std::uint64_t most = 0;
  const auto run = for_each_reserved(
      {.team = &team, .progress = &progress, .report = &report}, {.name = "log", .n = 500}, 1,
      [](std::size_t /*i*/, Claims& claims) { claims(0); },
      [&](std::size_t i) {
        const Progress::Snapshot now = progress.snapshot();
        EXPECT_EQ(now.phase, "log");
        EXPECT_EQ(now.total, 500U);
        EXPECT_EQ(now.done, i);
        most = now.done;
      });
  ASSERT_TRUE(run);
  EXPECT_EQ(most, 499U);
  EXPECT_EQ(progress.snapshot().phases_ended, 1U);
  ASSERT_EQ(report.regions().size(), 2U);
  EXPECT_EQ(report.regions()[0].name, "log, claims");
  EXPECT_EQ(report.regions()[1].name, "log");
}

}  // namespace
}  // namespace strake::parallel
