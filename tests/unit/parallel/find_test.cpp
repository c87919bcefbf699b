// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/find.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

#include "strake/parallel/host_executor.hpp"
#include "support/every_schedule.hpp"
#include "support/reversed_executor.hpp"

namespace strake::parallel {
namespace {

using test::everywhere;

TEST(Find, the_lowest_is_found_and_all_below_it_are_requested) {
  for (const std::size_t step :
       {std::size_t{1}, std::size_t{97}, std::size_t{500}, test::kEverywhereItems})
    for (const std::size_t grain : {1U, 16U, 2000U})
      everywhere(grain, [&](const Context& context, const Region& region) {
        std::vector<std::uint8_t> calls(test::kEverywhereItems, 0);
        const auto found = find_first(context, region, [&](std::size_t i) {
          ++calls[i];
          return i % step == step - 1;
        });
        ASSERT_TRUE(found);
        ASSERT_TRUE(found->has_value());
        EXPECT_EQ(**found, step - 1);
        for (std::size_t i = 0; i < test::kEverywhereItems; ++i)
          ASSERT_TRUE(i < step ? calls[i] == 1 : calls[i] <= 1) << i;
      });
}

TEST(Find, nothing_is_found_where_nothing_is) {
  everywhere(16, [](const Context& context, const Region& region) {
    const auto found = find_first(context, region, [](std::size_t) { return false; });
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->has_value());
  });
  const auto none = find_first({}, {.name = "none"}, [](std::size_t) { return true; });
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->has_value());
}

TEST(Find, workers_have_contexts) {
  everywhere(4, [](const Context& context, const Region& region) {
    const auto found = find_first_with(
        context, region, [] { return std::string("scratch"); },
        [](std::string& scratch, std::size_t i) {
          scratch = std::to_string(i);
          return scratch == "123";
        });
    ASSERT_TRUE(found);
    EXPECT_EQ(found->value(), 123U);
  });
}

TEST(Find, what_is_far_above_is_left_out) {
  // Sequential: nothing above is asked. A team: what is in hand at that moment at most.
  for (const unsigned threads : {1U, 4U}) {
    Team team(threads);
    constexpr std::size_t kMany = std::size_t{1} << 40U;  // would take a day
    const auto found = find_first({.team = &team}, {.name = "many", .n = kMany, .grain = 64},
                                  [](std::size_t i) { return i == 1000; });
    ASSERT_TRUE(found);
    EXPECT_EQ(found->value(), 1000U);
  }
}

TEST(Find, all_workers_go_from_below) {
  HostExecutor host = test::second_first();  // what one alone would ask
  std::size_t calls = 0;
  const auto found =
      find_first({.team = &host}, {.name = "low", .n = 1'000'000}, [&](std::size_t i) {
        ++calls;
        return i == 10;
      });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value(), 10U);
  EXPECT_EQ(calls, 11U);
}

TEST(Find, the_counter_does_not_come_round_again) {
  // 64 workers and more than 2^64 items that they could take: one after the other, each once.
  HostExecutor host(64, [](unsigned, const HostExecutor::Body&) {});
  constexpr std::size_t kMany = std::size_t{1} << 60U;
  std::size_t calls = 0;
  const auto found =
      find_first({.team = &host}, {.name = "wide", .n = kMany, .chunk = kMany}, [&](std::size_t i) {
        ++calls;
        return i == 5;
      });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value(), 5U);
  EXPECT_EQ(calls, 6U);
}

TEST(Find, an_exception_counts_only_below_the_found) {
  for (const std::size_t throws : {10U, 500U})
    everywhere(7, [&](const Context& context, const Region& region) {
      const auto found = find_first(context, region, [&](std::size_t i) {
        if (i == throws) throw std::runtime_error("item " + std::to_string(i));
        return i == 100;
      });
      ASSERT_EQ(found.has_value(), throws > 100);
      if (found)
        EXPECT_EQ(found->value(), 100U);
      else
        EXPECT_EQ(found.error().message, "item 10");
    });
}

TEST(Find, cancelled_is_not_found) {
  everywhere(4, [](Context context, const Region& region) {
    std::stop_source source;
    context.stop = source.get_token();
    const auto found = find_first(context, region, [&](std::size_t i) {
      if (i == 50) source.request_stop();
      return i == 60;
    });
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::cancelled);
  });
}

TEST(AllOf, is_true_of_none_and_of_all) {
  EXPECT_TRUE(*all_of({}, {.name = "none"}, [](std::size_t) { return false; }));
  everywhere(16, [](const Context& context, const Region& region) {
    EXPECT_TRUE(*all_of(context, region, [](std::size_t) { return true; }));
    for (const std::size_t odd :
         {std::size_t{0}, test::kEverywhereItems / 2, test::kEverywhereItems - 1})
      EXPECT_FALSE(*all_of(context, region, [&](std::size_t i) { return i != odd; }));
  });
}

TEST(TransformUntil, results_end_with_the_last_that_is_wanted) {
  for (const std::size_t last :
       {std::size_t{0}, std::size_t{333}, test::kEverywhereItems - 1, test::kEverywhereItems + 5})
    everywhere(8, [&](const Context& context, const Region& region) {
      const auto squares = transform_until(
          context, region, [](std::size_t i) { return i * i; },
          [&](std::size_t square) { return square >= last * last; });
      ASSERT_TRUE(squares);
      ASSERT_EQ(squares->size(), std::min(test::kEverywhereItems, last + 1));
      for (std::size_t i = 0; i < squares->size(); ++i) ASSERT_EQ((*squares)[i], i * i);
    });
}

TEST(TransformUntil, a_failing_item_below_the_last_is_an_error) {
  everywhere(8, [](const Context& context, const Region& region) {
    const auto run = [&](std::size_t throws) {
      return transform_until(
          context, region,
          [&](std::size_t i) {
            if (i >= throws) throw std::runtime_error("item " + std::to_string(i));
            return i;
          },
          [](std::size_t i) { return i == 400; });
    };
    EXPECT_EQ(run(300).error().message, "item 300");
    EXPECT_EQ(run(401)->size(), 401U);
  });
}

}  // namespace
}  // namespace strake::parallel
