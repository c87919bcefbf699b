// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"
#include "support/every_schedule.hpp"

namespace strake::parallel {
namespace {

using test::everywhere;

Error failure(std::size_t i) { return {ErrorCode::input, "item " + std::to_string(i), {}, {}}; }

TEST(Errors, the_lowest_failing_item_is_reported_and_all_below_it_ran) {
  struct Case {
    const char* name;
    std::size_t lowest;
    std::function<bool(std::size_t)> fails;
  };
  const Case cases[] = {
      {"first", 0, [](std::size_t i) { return i == 0; }},
      {"last", test::kEverywhereItems - 1,
       [](std::size_t i) { return i == test::kEverywhereItems - 1; }},
      {"every 97th", 96, [](std::size_t i) { return i % 97 == 96; }},
      {"all", 0, [](std::size_t) { return true; }},
      {"second half", test::kEverywhereItems / 2,
       [](std::size_t i) { return i >= test::kEverywhereItems / 2; }},
  };
  for (const Case& one : cases)
    for (const std::size_t grain : {1U, 16U, 2000U})
      everywhere(grain, [&](const Context& context, const Region& region) {
        SCOPED_TRACE(one.name);
        std::vector<std::uint8_t> ran(test::kEverywhereItems, 0);
        const Status status = for_each(context, region, [&](std::size_t i) -> Status {
          ran[i] = 1;
          if (one.fails(i)) return failure(i);
          return {};
        });
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().message, failure(one.lowest).message);
        for (std::size_t i = 0; i < one.lowest; ++i) ASSERT_EQ(ran[i], 1) << i;
        const Status thrown = for_each(context, region, [&](std::size_t i) {
          if (one.fails(i)) throw std::runtime_error(failure(i).message);
        });
        ASSERT_FALSE(thrown);
        EXPECT_EQ(thrown.error().code, ErrorCode::internal);
        EXPECT_EQ(thrown.error().message, failure(one.lowest).message);
        EXPECT_NE(thrown.error().where.find("'failing'"), std::string::npos);
      });
}

TEST(Errors, every_pattern_reports_the_lowest) {
  everywhere(8, [](const Context& context, const Region& region) {
    const auto fails = [](std::size_t i) { return i % 97 == 96; };
    const auto transformed = transform(context, region, [&](std::size_t i) -> Result<int> {
      if (fails(i)) return failure(i);
      return 1;
    });
    ASSERT_FALSE(transformed);
    EXPECT_EQ(transformed.error().message, "item 96");
    const auto collected =
        collect<int>(context, region, [&](std::size_t i, std::vector<int>& out) -> Status {
          out.push_back(1);
          if (fails(i)) return failure(i);
          return {};
        });
    ASSERT_FALSE(collected);
    EXPECT_EQ(collected.error().message, "item 96");
    const auto reduced = reduce(
        context, region, 0,
        [&](int&, std::size_t i) {
          if (fails(i)) throw std::runtime_error(failure(i).message);
        },
        [](int& a, int b) { a += b; });
    ASSERT_FALSE(reduced);
    EXPECT_EQ(reduced.error().message, "item 96");
    const auto filled = count_fill<int>(
        context, region, [](std::size_t) { return std::size_t{1}; },
        [&](std::size_t i, std::span<int>) -> Status {
          if (fails(i)) return failure(i);
          return {};
        });
    ASSERT_FALSE(filled);
    EXPECT_EQ(filled.error().message, "item 96");
  });
}

TEST(Errors, a_context_that_cannot_be_made_is_an_error) {
  everywhere(4, [](const Context& context, const Region& region) {
    const Status status = for_each_with(
        context, region, []() -> int { throw std::runtime_error("no scratch"); },
        [](int&, std::size_t) { FAIL(); });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "no scratch");
  });
}

TEST(Errors, whatever_is_thrown_is_caught) {
  Team team(3);
  const Region region{.name = "odd", .n = 10};
  const Status odd = for_each({.team = &team}, region, [](std::size_t) { throw 42; });
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().code, ErrorCode::internal);
  const Status memory =
      for_each({.team = &team}, region, [](std::size_t) { throw std::bad_alloc(); });
  ASSERT_FALSE(memory);
  EXPECT_EQ(memory.error().code, ErrorCode::memory);
  EXPECT_EQ(memory.error().text(), out_of_memory().text());
}

TEST(Errors, too_many_slots_are_an_error) {
  const auto result =
      transform({}, {.name = "huge", .n = std::size_t{1} << 60U}, [](std::size_t i) { return i; });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::memory);
}

TEST(Cancel, before_the_start_nothing_runs) {
  std::stop_source source;
  source.request_stop();
  everywhere(4, [&](Context context, const Region& region) {
    context.stop = source.get_token();
    const Status status = for_each(context, region, [](std::size_t) { FAIL(); });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::cancelled);
  });
}

TEST(Cancel, from_the_body_stops_the_rest) {
  everywhere(1, [](Context context, const Region& region) {
    std::stop_source source;
    context.stop = source.get_token();
    std::atomic<std::size_t> ran{0}, after{0};
    std::atomic<bool> requested{false};  // set once request_stop has returned
    const Status status = for_each(context, region, [&](std::size_t) {
      if (requested) ++after;
      if (++ran == 100) {
        source.request_stop();
        requested = true;
      }
      // The request and its effect are two steps: nobody runs ahead between them.
      while (source.stop_requested() && !requested) std::this_thread::yield();
    });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::cancelled);
    // One item per worker may have passed its check just before.
    EXPECT_LE(after, context.team != nullptr ? context.team->size() : 0);
    EXPECT_LT(ran, test::kEverywhereItems);
  });
}

TEST(Cancel, from_outside_ends_within_the_running_items) {
  Team team(4);
  for (const std::size_t grain : {std::size_t{1}, std::size_t{1} << 40U}) {
    std::stop_source source;
    std::atomic<bool> running{false};
    std::thread outside([&] {
      while (!running) std::this_thread::yield();
      source.request_stop();
    });
    // Endless but for the cancellation: the test's time-out is the failure.
    const Status status =
        for_each({.team = &team, .stop = source.get_token()},
                 {.name = "endless", .n = std::size_t{1} << 40U, .grain = grain}, [&](std::size_t) {
                   running = true;
                   std::this_thread::sleep_for(std::chrono::microseconds(20));
                 });
    outside.join();
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::cancelled);
  }
}

TEST(Cancel, an_error_does_not_hide_it) {
  std::stop_source source;
  const Status status = for_each({.stop = source.get_token()}, {.name = "both", .n = 10},
                                 [&](std::size_t i) -> Status {
                                   source.request_stop();
                                   return failure(i);
                                 });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::parallel
