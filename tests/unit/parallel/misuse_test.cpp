// SPDX-License-Identifier: Apache-2.0
// What is asked of the patterns by mistake, or by hostile numbers: an error, never a lost item.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// All of them in one file: names must not meet.
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/bounded_queue.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/nested.hpp"
#include "strake/parallel/optional_lock.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {
namespace {

constexpr std::size_t kLargest = std::numeric_limits<std::size_t>::max();
constexpr std::array kTeamSizes = {1U, 2U, 3U, 8U, 64U};

TEST(Misuse, a_chunk_of_any_size_runs_every_item_once) {
  for (const unsigned workers : kTeamSizes)
    for (const std::size_t chunk :
         {kLargest, kLargest / 2 + 1, kLargest / 4 + 1, kLargest - 1, std::size_t{0}}) {
      Team team(workers);
      std::vector<std::atomic<int>> runs(100);
      for (int round = 0; round < 20; ++round)
        ASSERT_TRUE(for_each({.team = &team}, {.name = "c", .n = runs.size(), .chunk = chunk},
                             [&](std::size_t i) { ++runs[i]; }));
      for (const auto& run : runs) ASSERT_EQ(run, 20) << workers << " workers, chunk " << chunk;
    }
}

TEST(Misuse, an_order_that_is_no_permutation_is_an_error) {
  Team team(3);
  const std::vector<std::uint32_t> twice(100, 7);
  std::vector<std::uint32_t> beyond(100);
  for (std::uint32_t k = 0; k < 100; ++k) beyond[k] = k + 1;
  const std::vector<std::uint32_t> few(99, 0);
  for (const std::vector<std::uint32_t>& order : {twice, beyond, few}) {
    Progress progress;
    RunReport report;
    std::atomic<int> runs{0};
    const Status status =
        for_each({.team = &team, .progress = &progress, .report = &report},
                 {.name = "o", .n = 100, .order = order}, [&](std::size_t /*i*/) { ++runs; });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().where, "o");
    EXPECT_EQ(runs, 0);
    EXPECT_TRUE(report.regions().empty());
  }
  const std::vector<std::uint32_t> order = {1, 0};
  EXPECT_FALSE(for_each_by_weight(
      {}, {.name = "w", .n = 2, .order = order}, 1, [](std::size_t /*i*/) { return 1.0; },
      [](std::size_t /*i*/) {}));
}

TEST(Misuse, blocks_at_the_end_of_all_numbers_are_run) {
  // Two blocks of which the second would end beyond what a number holds.
  constexpr std::size_t kGrain = kLargest / 2 + 2;
  const std::vector<std::uint32_t> second_first = {1, 0};
  std::optional<std::size_t> observed;
  const Status status =
      for_each({}, {.name = "h", .n = kGrain + 5, .grain = kGrain, .order = second_first},
               [&](std::size_t i) -> Status {
                 if (!observed) observed = i;
                 return Error{ErrorCode::input, "enough", {}, {}};
               });
  EXPECT_FALSE(status);
  EXPECT_EQ(observed, kGrain);
}

TEST(Misuse, more_than_can_be_counted_is_an_error) {
  const auto one = [](std::size_t /*i*/) { return std::size_t{1}; };
  const auto half = [](std::size_t /*i*/) { return kLargest / 2 + 1; };
  const auto fill = [](std::size_t /*i*/, std::span<int> /*out*/) {};
  const auto none = [](std::size_t /*row*/, std::size_t /*column*/) {};
  EXPECT_EQ(count_fill<int>({}, {.name = "h", .n = kLargest}, one, fill).error().code,
            ErrorCode::memory);
  EXPECT_EQ(count_fill<int>({}, {.name = "h", .n = 2}, half, fill).error().message,
            "more elements than can be counted");
  EXPECT_EQ(for_each_nested({}, {.name = "h"}, kLargest, one, none).error().code,
            ErrorCode::memory);
  EXPECT_EQ(for_each_nested({}, {.name = "h"}, 2, half, none).error().message,
            "more elements than can be counted");
  EXPECT_EQ(collect<int>({}, {.name = "h", .n = kLargest},
                         [](std::size_t /*i*/, std::vector<int>& /*out*/) {})
                .error()
                .code,
            ErrorCode::memory);
  EXPECT_EQ(
      transform({}, {.name = "h", .n = kLargest}, [](std::size_t i) { return i; }).error().code,
      ErrorCode::memory);
}

[[noreturn]] void complain() { throw std::runtime_error("my own words"); }

TEST(Misuse, exceptions_of_everything_that_is_called_are_errors_with_their_place) {
  for (const unsigned workers : kTeamSizes) {
    Team team(workers);
    const Context context{.team = &team};
    const auto at = [](const auto& result) {
      EXPECT_FALSE(result);
      EXPECT_EQ(result.error().message, "my own words");
      return result.error().where;
    };
    for (const std::size_t alone_below : {0UL, 1000UL})
      EXPECT_EQ(at(reduce(
                    context, {.name = "r", .n = 100, .grain = 10, .alone_below = alone_below}, 0,
                    [](int& partial, std::size_t i) { partial += static_cast<int>(i); },
                    [&](int& into, int partial) {
                      // The fourth block of ten, or all of a hundred.
                      if (partial == 345 || partial == 4950) complain();
                      into += partial;
                    })),
                alone_below == 0 ? "region 'r', item 30" : "region 'r', item 0");
    EXPECT_EQ(at(for_each_nested(
                  context, {.name = "n"}, 5,
                  [](std::size_t row) {
                    if (row == 3) complain();
                    return row;
                  },
                  [](std::size_t /*row*/, std::size_t /*column*/) {})),
              "region 'n', item 3");
    EXPECT_EQ(at(pieces(
                  5,
                  [](std::size_t i) {
                    if (i == 2) complain();
                    return i;
                  },
                  3)),
              "region 'pieces', item 2");
    EXPECT_EQ(at(for_each_by_weight(
                  context, {.name = "w", .n = 9}, 1,
                  [](std::size_t i) {
                    if (i == 4) complain();
                    return i;
                  },
                  [](std::size_t /*i*/) {})),
              "region 'w', item 4");
    EXPECT_EQ(at(distinct(
                  context, "d", 1000, [](std::size_t i) { return mixed(0, i / 2); },
                  [](std::size_t i, std::size_t j) {
                    if (i == 500 || j == 500) complain();
                    return true;
                  })),
              "region 'd', item 501");
  }
}

/// The items of distinct() go through lots by their hashes, which must not show.
TEST(Misuse, the_lowest_that_cannot_be_compared_is_reported_whatever_the_hash) {
  for (const unsigned workers : kTeamSizes) {
    Team team(workers);
    for (const std::uint64_t salt : {0U, 1U, 2U, 3U}) {
      const auto kinds = distinct(
          {.team = &team}, "d", 3000, [&](std::size_t i) { return mixed(salt, i / 10); },
          [](std::size_t /*i*/, std::size_t j) {
            if (j > 700 && j % 7 == 0) complain();
            return true;
          });
      ASSERT_FALSE(kinds);
      EXPECT_EQ(kinds.error().where, "region 'd', item 707");
    }
  }
}

TEST(Misuse, items_of_one_hash_can_be_stopped) {
  Team team(2);
  std::stop_source source;
  std::atomic<std::uint64_t> calls{0};
  const auto kinds = distinct(
      {.team = &team, .stop = source.get_token()}, "d", 30000,
      [](std::size_t) { return std::uint64_t{7}; },
      [&](std::size_t, std::size_t) {
        if (++calls == 1000) source.request_stop();
        return false;
      });
  ASSERT_FALSE(kinds);
  EXPECT_EQ(kinds.error().code, ErrorCode::cancelled);
  EXPECT_LT(calls, 10000U) << "of some 450 million";
}

TEST(Misuse, a_cost_that_throws_names_its_key) {
  Precomputed<int> table(300);
  const std::array<std::uint32_t, 3> wanted = {100, 200, 250};
  const Status status = table.fill_by_weight(
      {}, {.name = "p"}, 1, wanted,
      [](std::size_t key) {
        if (key == 200) complain();
        return 1.0;
      },
      [](std::size_t) { return 0; });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().where, "region 'p', item 200");
}

/// Cannot be made where it is to be put.
struct Unborn {
  Unborn() { throw 7; }
};

TEST(Misuse, values_that_cannot_begin_are_an_error) {
  EXPECT_FALSE(slots<Unborn>(3));
  Precomputed<Unborn> table(3);
  const std::array<std::uint32_t, 1> wanted = {1};
  EXPECT_FALSE(table.fill({}, {.name = "p"}, wanted, [](std::size_t) { return Unborn(); }));
  EXPECT_EQ(table.find(1), nullptr);
}

TEST(Misuse, a_short_region_is_short_by_weight_too) {
  Team team(3);
  const std::stop_source source;
  source.request_stop();
  RunReport report;
  int runs = 0;
  EXPECT_TRUE(for_each_by_weight(
      {.team = &team, .stop = source.get_token(), .report = &report},
      {.name = "w", .n = 5, .alone_below = 6}, 1, [](std::size_t i) { return i == 2 ? 1e6 : 1.0; },
      [&](std::size_t) { ++runs; }));
  EXPECT_EQ(runs, 5);
  EXPECT_TRUE(report.regions().empty());
}

TEST(Misuse, what_is_left_beside_a_heavy_item_is_not_short) {
  Team team(2);
  RunReport report;
  ASSERT_TRUE(for_each_by_weight(
      {.team = &team, .report = &report}, {.name = "w", .n = 6, .alone_below = 6}, 1,
      [](std::size_t i) { return i == 2 ? 1e6 : 1.0; }, [](std::size_t) {}));
  ASSERT_EQ(report.regions().size(), 1U);
  EXPECT_EQ(report.regions().front().items, 6U) << "all of them are reported";
}

TEST(Misuse, a_stop_before_the_start_is_reported_before_a_cost_or_length_that_throws) {
  const std::stop_source source;
  source.request_stop();
  const Context context{.stop = source.get_token()};
  const auto throws = [](std::size_t) -> std::size_t { complain(); };
  const Status by_weight =
      for_each_by_weight(context, {.name = "w", .n = 3}, 1, throws, [](std::size_t) {});
  const Status nested =
      for_each_nested(context, {.name = "n"}, 3, throws, [](std::size_t, std::size_t) {});
  ASSERT_FALSE(by_weight || nested);
  EXPECT_EQ(by_weight.error().code, ErrorCode::cancelled);
  EXPECT_EQ(nested.error().code, ErrorCode::cancelled);
}

TEST(Misuse, a_stop_that_meets_an_error_is_reported_as_a_stop) {
  // The stop comes from another thread, at any moment of the error's way out.
  Team team(2);
  for (int round = 0; round < 600; ++round) {
    std::stop_source source;
    const Context context{.team = &team, .stop = source.get_token()};
    std::atomic<bool> begun{false};
    const std::jthread other([&] {
      while (!begun) std::this_thread::yield();
      source.request_stop();
    });
    const auto fails = [&](std::size_t i) -> Status {
      begun = true;
      if (i % 4 != 0) return {};
      return Error{ErrorCode::input, "item " + std::to_string(i), {}, {}};
    };
    const Status status = round % 2 == 0
                              ? for_each_by_weight(
                                    context, {.name = "w", .n = 9}, 1,
                                    [](std::size_t i) { return i == 8 ? 100.0 : 1.0; }, fails)
                              : [&]() -> Status {
      auto run = for_each_reserved(
          context, {.name = "r", .n = 9}, 9,
          [](std::size_t i, Claims& claims) { claims(i < 5 ? 0 : i); }, fails);
      return run ? Status() : Status(std::move(run).error());
    }();
    ASSERT_FALSE(status);
    if (status.error().code != ErrorCode::cancelled) {
      EXPECT_EQ(status.error().message, "item 0");
    }
  }
}

TEST(Misuse, a_heavy_item_fails_as_any_other_does) {
  const auto error_of = [](Executor* team, const std::vector<std::size_t>& failing,
                           std::size_t heavy, bool throws) {
    std::vector<std::atomic<int>> runs(6);
    const Status status = for_each_by_weight(
        {.team = team}, {.name = "w", .n = runs.size()}, 1,
        [&](std::size_t i) { return i == heavy ? 100.0 : 1.0; },
        [&](std::size_t i) -> Status {
          ++runs[i];
          if (std::ranges::find(failing, i) == failing.end()) return {};
          if (throws) complain();
          return Error{ErrorCode::input, {}, "region 'w', item " + std::to_string(i), {}};
        });
    const std::size_t lowest = *std::ranges::min_element(failing);
    for (std::size_t i = 0; i <= lowest; ++i) EXPECT_EQ(runs[i], 1) << "item " << i;
    EXPECT_FALSE(status);
    return status.error().where;
  };
  for (const unsigned workers : kTeamSizes) {
    Team team(workers);
    for (Executor* const who : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&team)})
      for (const bool throws : {false, true})
        for (std::size_t heavy = 0; heavy < 6; ++heavy) {
          EXPECT_EQ(error_of(who, {1, 3}, heavy, throws), "region 'w', item 1");
          EXPECT_EQ(error_of(who, {4, 2, 5}, heavy, throws), "region 'w', item 2");
          EXPECT_EQ(error_of(who, {0}, heavy, throws), "region 'w', item 0");
        }
  }
}

TEST(Misuse, nothing_at_all_is_reduced_to_the_identity) {
  for (const std::size_t alone_below : {0UL, 10UL})
    EXPECT_EQ(*reduce(
                  {}, {.name = "none", .n = 0, .alone_below = alone_below}, 5,
                  [](int& /*partial*/, std::size_t /*i*/) {},
                  [](int& into, int partial) { into += partial; }),
              5);
}

/// Asks for a stop when it goes, once.
class Stopper {
 public:
  explicit Stopper(std::stop_source& source) : source_(&source) {}
  Stopper(Stopper&& other) noexcept : source_(std::exchange(other.source_, nullptr)) {}
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;
  Stopper& operator=(Stopper&&) = delete;
  ~Stopper() {
    if (source_ != nullptr) source_->request_stop();
  }

 private:
  std::stop_source* source_;
};

TEST(Misuse, what_passes_a_pipeline_may_stop_it_as_it_goes) {
  // Neither items nor results can be assigned; both end with the pipeline's lock open.
  for (const bool result_stops : {false, true})
    for (const unsigned workers : kTeamSizes) {
      Team team(workers);
      std::stop_source source;
      std::size_t fetched = 0;
      const Context context{.team = &team, .stop = source.get_token()};
      const auto fetch = [&]() -> std::optional<Stopper> {
        if (++fetched > 100000) return std::nullopt;
        return Stopper(source);
      };
      const Status status =
          result_stops ? pipeline(
                             context, {.name = "p"}, fetch,
                             [](Stopper&& item) { return Stopper(std::move(item)); },
                             [](Stopper&& /*result*/) {})
                       : pipeline(
                             context, {.name = "p"}, fetch, [](Stopper&& /*item*/) { return 1; },
                             [](int&& /*result*/) {});
      ASSERT_FALSE(status);
      EXPECT_EQ(status.error().code, ErrorCode::cancelled);
      EXPECT_LT(fetched, 10000U);
    }
}

TEST(MisuseDeathTest, a_body_that_throws_on_a_hosts_thread_ends_the_program) {
  HostExecutor host(3, [](unsigned count, const HostExecutor::Body& body) {
    for (unsigned i = 0; i < count; ++i) body(i);
  });
  EXPECT_DEATH(host.run([](Seat seat) {
    if (seat.index == 1) complain();
  }),
               "");
}

TEST(Misuse, progress_is_free_again_after_an_error) {
  Team team(3);
  Progress progress;
  const Context context{.team = &team, .progress = &progress};
  EXPECT_FALSE(for_each(context, {.name = "x", .n = 10}, [](std::size_t i) {
    if (i == 3) complain();
  }));
  EXPECT_EQ(progress.snapshot().phase, "");
  EXPECT_TRUE(progress.begin("y", 1));
}

}  // namespace
}  // namespace strake::parallel
