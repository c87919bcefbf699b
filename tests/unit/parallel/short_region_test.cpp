// SPDX-License-Identifier: Apache-2.0
// Regions that are too short for a team: Region::alone_below.
#include <gtest/gtest.h>

#include <bit>
#include <stdexcept>
#include <string>
#include <thread>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"
#include "support/parallel_results.hpp"

namespace strake::parallel {
namespace {

TEST(ShortRegion, results_are_those_of_one_block) {
  Team team(3);
  const auto one_block =
      test::results({}, {.name = "one", .n = test::kResultItems, .grain = test::kResultItems}, 0);
  const auto few = test::results(
      {.team = &team},
      {.name = "few", .n = test::kResultItems, .grain = 16, .alone_below = test::kResultItems + 1},
      0);
  EXPECT_EQ(few, one_block);
  // From as many on it is a region as any: with its grain.
  const auto region = test::results(
      {.team = &team},
      {.name = "enough", .n = test::kResultItems, .grain = 16, .alone_below = test::kResultItems},
      0);
  EXPECT_EQ(region, test::results({}, {.name = "any", .n = test::kResultItems, .grain = 16}, 0));
}

TEST(ShortRegion, runs_on_the_caller_and_is_not_reported) {
  Team team(3);
  RunReport report;
  const Context context{.team = &team, .report = &report};
  const Region region{.name = "few", .n = 100, .alone_below = 101};
  const auto caller = std::this_thread::get_id();
  EXPECT_TRUE(for_each(context, region,
                       [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); }));
  EXPECT_TRUE(
      *all_of(context, region, [&](std::size_t) { return std::this_thread::get_id() == caller; }));
  EXPECT_TRUE(report.regions().empty());
}

TEST(ShortRegion, makes_one_context_and_none_for_no_items) {
  int made = 0;
  const auto make = [&] { return ++made; };
  const auto count = [](int&, std::size_t) {};
  EXPECT_TRUE(for_each_with({}, {.name = "none", .alone_below = 10}, make, count));
  EXPECT_EQ(made, 0);
  EXPECT_TRUE(for_each_with({}, {.name = "few", .n = 9, .alone_below = 10}, make, count));
  EXPECT_EQ(made, 1);
}

TEST(ShortRegion, errors_and_exceptions_end_it_at_their_item) {
  const Region region{.name = "few", .n = 100, .alone_below = 101};
  std::size_t ran = 0;
  const Status failed = for_each({}, region, [&](std::size_t i) -> Status {
    ++ran;
    if (i >= 7) return Error{ErrorCode::input, "item " + std::to_string(i), {}, {}};
    return {};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "item 7");
  EXPECT_EQ(ran, 8U);
  const auto throws = [](std::size_t i) {
    if (i >= 7) throw std::runtime_error("item " + std::to_string(i));
  };
  const auto check = [](const Error& error) {
    EXPECT_EQ(error.message, "item 7");
    EXPECT_EQ(error.where, "region 'few', item 7");
  };
  check(for_each({}, region, throws).error());
  check(collect<int>({}, region, [&](std::size_t i, std::vector<int>&) { throws(i); }).error());
  check(reduce({}, region, 0, [&](int&, std::size_t i) { throws(i); }, [](int&, int) {}).error());
  check(find_first({}, region, [&](std::size_t i) {
          throws(i);
          return false;
        }).error());
  const Status no_context = for_each_with(
      {}, region, []() -> int { throw std::runtime_error("no scratch"); },
      [](int&, std::size_t) { FAIL(); });
  ASSERT_FALSE(no_context);
  EXPECT_EQ(no_context.error().message, "no scratch");
}

}  // namespace
}  // namespace strake::parallel
