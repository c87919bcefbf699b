// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/pipeline.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

constexpr std::size_t kPipedItems = 500;

/// The numbers up to n.
auto counted(std::size_t n) {
  return [n, next = std::size_t{0}]() mutable -> std::optional<std::size_t> {
    return next < n ? std::optional(next++) : std::nullopt;
  };
}

/// Runs without a team, with teams, and on a host that calls one seat after another.
void everywhere(const std::function<void(const Context&, const Flow&)>& test) {
  HostExecutor in_turn(3, [](unsigned count, const HostExecutor::Body& body) {
    for (unsigned i = count; i > 0; --i) body(i - 1);
  });
  for (const std::size_t in_flight : {0U, 1U, 2U, 7U, 1000U}) {
    const Flow flow{.name = "flow", .in_flight = in_flight};
    SCOPED_TRACE(in_flight);
    test({}, flow);
    test({.team = &in_turn}, flow);
    for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
      SCOPED_TRACE(threads);
      Team team(threads);
      test({.team = &team}, flow);
    }
  }
}

TEST(Pipeline, hands_on_all_results_in_the_order_of_the_source) {
  everywhere([](const Context& context, const Flow& flow) {
    std::vector<std::size_t> got;  // plain: two sinks at a time are a TSan report
    const Status status = pipeline(
        context, flow, counted(kPipedItems),
        [](std::size_t i) {
          if (i % 7 == 3) std::this_thread::yield();
          return std::to_string(i * i);
        },
        [&](std::string&& text) { got.push_back(std::stoull(text)); });
    ASSERT_TRUE(status);
    ASSERT_EQ(got.size(), kPipedItems);
    for (std::size_t i = 0; i < kPipedItems; ++i) ASSERT_EQ(got[i], i * i);
  });
}

TEST(Pipeline, holds_no_more_items_than_it_may) {
  everywhere([](const Context& context, const Flow& flow) {
    const std::size_t workers = context.team == nullptr ? 1 : context.team->size();
    const std::size_t most = flow.in_flight == 0 ? 4 * workers : flow.in_flight;
    std::atomic<std::size_t> held{0}, highest{0};
    auto source = counted(kPipedItems);
    const Status status = pipeline(
        context, flow,
        [&] {
          const auto item = source();
          if (item) highest = std::max(highest.load(), ++held);
          return item;
        },
        [](std::size_t i) { return i; }, [&](std::size_t) { --held; });
    ASSERT_TRUE(status);
    EXPECT_EQ(held, 0U);
    EXPECT_LE(highest, most);
  });
}

TEST(Pipeline, of_nothing_is_not_an_error) {
  everywhere([](const Context& context, const Flow& flow) {
    EXPECT_TRUE(pipeline(
        context, flow, counted(0), [](std::size_t i) { return i; },
        [](std::size_t) { ADD_FAILURE(); }));
  });
}

TEST(Pipeline, items_and_results_may_be_moved_only) {
  everywhere([](const Context& context, const Flow& flow) {
    std::size_t sum = 0;
    auto source = counted(100);
    ASSERT_TRUE(pipeline(
        context, flow,
        [&]() -> std::optional<std::unique_ptr<std::size_t>> {
          const auto i = source();
          if (!i) return std::nullopt;
          return std::make_unique<std::size_t>(*i);
        },
        [](std::unique_ptr<std::size_t>&& p) { return std::move(p); },
        [&](std::unique_ptr<std::size_t>&& p) { sum += *p; }));
    EXPECT_EQ(sum, 4950U);
  });
}

/// Where items fail, by their numbers; a failing source ends what it gives.
struct Faults {
  std::size_t source = kPipedItems, work = kPipedItems, thrown = kPipedItems, sink = kPipedItems;
};

TEST(Pipeline, reports_the_lowest_failing_item_and_hands_on_all_before_it) {
  const Faults all[] = {{.source = 0},
                        {.work = 0},
                        {.sink = 0},
                        {.source = 300, .work = 211, .thrown = 250, .sink = 210},
                        {.source = 300, .work = 211, .sink = 212},
                        {.source = 40, .thrown = 39},
                        {.thrown = kPipedItems - 1},
                        {.sink = kPipedItems - 1}};
  for (const Faults& faults : all)
    everywhere([&](const Context& context, const Flow& flow) {
      const auto failed = [](std::size_t i) {
        return Error{ErrorCode::input, std::to_string(i), {}, {}};
      };
      auto numbers = counted(kPipedItems);
      std::size_t sunk = 0;
      const Status status = pipeline(
          context, flow,
          [&] {
            const auto i = numbers();
            if (i && *i == faults.source) throw std::runtime_error(std::to_string(*i));
            return i;
          },
          [&](std::size_t i) -> Result<std::size_t> {
            if (i % 5 == 0) std::this_thread::yield();
            if (i >= faults.work) return failed(i);
            if (i >= faults.thrown) throw std::runtime_error(std::to_string(i));
            return i;
          },
          [&](std::size_t i) -> Status {
            EXPECT_EQ(i, sunk++);
            if (i >= faults.sink) return failed(i);
            return {};
          });
      const std::size_t lowest = std::min({faults.source, faults.work, faults.thrown, faults.sink});
      ASSERT_FALSE(status);
      EXPECT_EQ(status.error().message, std::to_string(lowest));
      EXPECT_EQ(sunk, lowest + (faults.sink == lowest ? 1 : 0));
    });
}

TEST(Pipeline, a_stop_ends_it) {
  everywhere([](const Context& context, const Flow& flow) {
    std::stop_source stop;
    Context own = context;
    own.stop = stop.get_token();
    std::size_t sunk = 0;
    const Status status = pipeline(
        own, flow, counted(1'000'000), [](std::size_t i) { return i; },
        [&](std::size_t i) {
          EXPECT_EQ(i, sunk++);
          if (i == 20) stop.request_stop();
        });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::cancelled);
    EXPECT_EQ(sunk, 21U);
  });
}

TEST(Pipeline, inside_a_region_runs_on_its_worker) {
  Team team(4);
  const Context context{.team = &team};
  std::vector<std::size_t> sums(20, 0);
  const Status status = for_each(context, {.name = "outer", .n = sums.size()}, [&](std::size_t k) {
    return pipeline(
        context, {.name = "inner"}, counted(100), [&](std::size_t i) { return i + k; },
        [&](std::size_t i) { sums[k] += i; });
  });
  ASSERT_TRUE(status);
  for (std::size_t k = 0; k < sums.size(); ++k) EXPECT_EQ(sums[k], 4950 + 100 * k);
}

TEST(Pipeline, many_short_ones_end) {
  Team team(8);
  for (std::size_t round = 0; round < 3000; ++round) {
    std::size_t sum = 0;
    ASSERT_TRUE(pipeline(
        {.team = &team}, {.name = "short", .in_flight = 1 + round % 3}, counted(round % 5),
        [](std::size_t i) { return i; }, [&](std::size_t i) { sum += i; }));
    EXPECT_EQ(sum, round % 5 == 0 ? 0 : (round % 5 - 1) * (round % 5) / 2);
  }
}

TEST(Pipeline, has_a_report) {
  Team team(2);
  RunReport report;
  ASSERT_TRUE(pipeline(
      {.team = &team, .report = &report}, {.name = "told"}, counted(10),
      [](std::size_t i) { return i; }, [](std::size_t) {}));
  ASSERT_EQ(report.regions().size(), 1U);
  EXPECT_EQ(report.regions()[0].name, "told");
}

}  // namespace
}  // namespace strake::parallel
