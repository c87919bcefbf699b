// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/progress.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

/// Uses CPU time until the calling thread has spent `seconds` of it.
void burn(double seconds) {
  const double until = thread_cpu_s() + seconds;
  while (thread_cpu_s() < until) {
  }
}

TEST(Progress, is_of_the_outermost_phase) {
  Progress progress;
  EXPECT_EQ(progress.snapshot().phase, "");
  ASSERT_TRUE(progress.begin("load", 10));
  EXPECT_FALSE(progress.begin("nested", 99));
  progress.add(4);
  const Progress::Snapshot now = progress.snapshot();
  EXPECT_EQ(now.phase, "load");
  EXPECT_EQ(now.done, 4U);
  EXPECT_EQ(now.total, 10U);
  progress.add(100);
  EXPECT_EQ(progress.snapshot().done, 10U) << "never beyond the total";
  progress.end();
  EXPECT_EQ(progress.snapshot().phase, "");
  EXPECT_EQ(progress.snapshot().phases_ended, 1U);
}

TEST(Progress, regions_report_how_far_they_are) {
  Team team(3);
  for (Team* const who : {static_cast<Team*>(nullptr), &team})
    for (const std::size_t grain : {1U, 10U}) {
      Progress progress;
      std::atomic<std::uint64_t> most{0};
      const Status status = for_each(
          {.team = who, .progress = &progress}, {.name = "work", .n = 100, .grain = grain},
          [&](std::size_t) {
            const Progress::Snapshot now = progress.snapshot();
            EXPECT_EQ(now.phase, "work");
            EXPECT_EQ(now.total, 100U);
            std::uint64_t observed = most;
            while (now.done > observed && !most.compare_exchange_weak(observed, now.done)) {
            }
          });
      ASSERT_TRUE(status);
      EXPECT_GT(most, 0U);
      EXPECT_LT(most, 100U) << "the running block is not done yet";
      EXPECT_EQ(progress.snapshot().phases_ended, 1U);
    }
}

TEST(Report, adds_up_runs_of_one_name) {
  Team team(2);
  RunReport report;
  const Context context{.team = &team, .report = &report};
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(for_each(context, {.name = "burn", .n = 8}, [](std::size_t) { burn(0.001); }));
    ASSERT_TRUE(for_each(context, {.name = "other", .n = 5, .grain = 2}, [](std::size_t) {}));
  }
  const std::vector<RegionReport> regions = report.regions();
  ASSERT_EQ(regions.size(), 2U);
  const RegionReport& burned = regions[0];
  EXPECT_EQ(burned.name, "burn");
  EXPECT_EQ(burned.runs, 3U);
  EXPECT_EQ(burned.items, 24U);
  ASSERT_EQ(burned.busy_s.size(), 2U);
  EXPECT_GE(burned.total_busy_s(), 0.024);
  EXPECT_GE(burned.longest_s, 0.001);
  EXPECT_GT(burned.wall_s, 0.0);
  EXPECT_GT(burned.load_balance(), 0.49);
  EXPECT_LE(burned.load_balance(), 1.0);
  EXPECT_GT(burned.bound(), 0.0);
  EXPECT_LE(burned.bound(), 1.0);
  EXPECT_EQ(regions[1].items, 15U);
}

TEST(Report, keeps_nested_runs_apart) {
  Team team(3);
  RunReport report;
  const Context context{.team = &team, .report = &report};
  ASSERT_TRUE(for_each(context, {.name = "outer", .n = 6}, [&](std::size_t) {
    EXPECT_TRUE(for_each(context, {.name = "inner", .n = 4}, [](std::size_t) { burn(0.0001); }));
  }));
  const std::vector<RegionReport> regions = report.regions();
  ASSERT_EQ(regions.size(), 2U);
  const RegionReport& inner = regions[0];
  EXPECT_EQ(inner.name, "inner");
  EXPECT_EQ(inner.runs, 0U);
  EXPECT_EQ(inner.nested_runs, 6U);
  EXPECT_EQ(inner.items, 24U);
  EXPECT_GE(inner.nested_cpu_s, 0.0024);
  EXPECT_TRUE(inner.busy_s.empty());
  EXPECT_EQ(regions[1].runs, 1U);
}

// What is inside a region of one block has the team, and is no part of that region's balance.
TEST(Report, keeps_heavy_items_apart) {
  Team team(2);
  RunReport report;
  const Context context{.team = &team, .report = &report};
  ASSERT_TRUE(for_each_by_weight(
      context, {.name = "outer", .n = 41}, 10, [](std::size_t i) { return i == 7 ? 1000.0 : 1.0; },
      [&](std::size_t i) {
        return for_each(context, {.name = "inner", .n = i == 7 ? 40U : 1U},
                        [](std::size_t) { burn(0.0005); });
      }));
  const std::vector<RegionReport> regions = report.regions();
  ASSERT_EQ(regions.size(), 2U);
  const bool inner_first = regions[0].name == "inner";
  const RegionReport& inner = regions[inner_first ? 0 : 1];
  const RegionReport& outer = regions[inner_first ? 1 : 0];
  EXPECT_EQ(outer.items, 41U);
  EXPECT_EQ(outer.runs, 1U) << "of the light ones";
  EXPECT_EQ(outer.nested_runs, 1U) << "of the heavy one";
  EXPECT_EQ(inner.runs, 1U) << "inside the heavy one";
  EXPECT_EQ(inner.nested_runs, 40U);
  EXPECT_GE(inner.total_busy_s(), 40 * 0.0005);
  EXPECT_LT(outer.total_busy_s(), 2 * 40 * 0.0005) << "that of the heavy one is not in it";
}

TEST(Progress, of_items_by_weight_is_one_phase) {
  Team team(2);
  Progress progress;
  const Context context{.team = &team, .progress = &progress};
  std::atomic<std::uint64_t> total{0};
  ASSERT_TRUE(for_each_by_weight(
      context, {.name = "outer", .n = 41}, 10, [](std::size_t i) { return i == 7 ? 1000.0 : 1.0; },
      [&](std::size_t i) {
        if (i == 7) total = progress.snapshot().total;
        return for_each(context, {.name = "inner", .n = 3}, [](std::size_t) {});
      }));
  EXPECT_EQ(total, 41U);
  EXPECT_EQ(progress.snapshot().phases_ended, 1U);
}

TEST(Report, stages_add_up_by_name) {
  RunReport report;
  for (int i = 0; i < 2; ++i) {
    const StageTimer timer(&report, "first");
    burn(0.001);
  }
  {
    const StageTimer timer(&report, "second");
  }
  {
    const StageTimer nobody(nullptr, "asked");
  }
  const std::vector<StageReport> stages = report.stages();
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0].name, "first");
  EXPECT_GE(stages[0].cpu_s, 0.002);
  EXPECT_GE(stages[0].wall_s, 0.002);
  EXPECT_EQ(stages[1].name, "second");
}

TEST(Report, figures_follow_their_definitions) {
  RegionReport region;
  region.busy_s = {1.0, 3.0};
  region.longest_s = 2.5;
  EXPECT_DOUBLE_EQ(region.load_balance(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(RegionReport().load_balance(), 1.0);
  EXPECT_DOUBLE_EQ(RegionReport().bound(), 1.0);
  const auto bound_of = [](const std::vector<RegionReport>& runs) {
    RunReport report;
    for (const RegionReport& run : runs) report.add(run);
    return report.regions().front().bound();
  };
  EXPECT_DOUBLE_EQ(bound_of({region}), 4.0 / (2 * 2.5));
  // Ten runs that are bound by a block each are bound as one is.
  EXPECT_DOUBLE_EQ(bound_of(std::vector(10, region)), 4.0 / (2 * 2.5));
  RegionReport even = region;
  even.longest_s = 0.1;
  EXPECT_DOUBLE_EQ(bound_of({even}), 1.0);
  EXPECT_DOUBLE_EQ(bound_of({even, region}), (2.0 + 2.0) / (2.0 + 2.5));
}

}  // namespace
}  // namespace strake::parallel
