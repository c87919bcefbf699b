// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/studies/region_times.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "cli/evaluate/studies/study_scenes.hpp"

namespace strake::cli {

namespace {

using parallel::Distribution;
using parallel::RegionReport;

/// A way to share work out, as a study names it.
struct SharingMode {
  std::string_view name;
  Distribution distribution;
};

/// A stage that is shared out in two ways; the first is what the engine does.
struct SharingComparison {
  const Contender& stage;
  std::string title;
  std::array<SharingMode, 2> ways;
  /// The region that is shown besides all of them; empty: the one that takes longest as planned.
  std::string_view region = {};
};

BarChart chart_of(const std::string& title) {
  BarChart chart{title + ": busy time of each worker", "s", {}, {}};
  for (unsigned w = 1; w <= kWorkersOfExample; ++w)
    chart.names.push_back(fmt::format("worker {}", w));
  return chart;
}

std::vector<double> of_all_workers(const RegionReport& region) {
  std::vector<double> busy_s = region.busy_s;
  busy_s.resize(kWorkersOfExample);
  return busy_s;
}

void add_region_row(const std::string& stage, const std::string& region, std::string_view way,
                    const RegionReport& times, std::string seconds, std::string same,
                    StudyRecord& study) {
  std::vector<std::string> row{stage, region, std::string(way), std::move(seconds)};
  for (std::string& cell : cells_of(times)) row.push_back(std::move(cell));
  row.push_back(std::move(same));
  study.rows.push_back(std::move(row));
}

/// Runs a stage in both ways and adds a row for all its regions and for one of them, each way, and
/// a chart of all.
Status compare_ways(const StudyInput& input, const SharingComparison& comparison,
                    StudyRecord& study) {
  std::array<StudyRun, 2> runs;
  for (std::size_t w = 0; w < runs.size(); ++w) {
    const SharingMode& way = comparison.ways[w];
    input.narrate(fmt::format("{}, {}: {}", study.name, comparison.title, way.name));
    Result<StudyRun> run = run_for_study(input, comparison.stage,
                                         {.distribution = way.distribution, .with_regions = true});
    if (!run) return run.error();
    runs[w] = std::move(*run);
  }
  const std::string region =
      comparison.region.empty() ? longest_of(runs[0].regions).name : std::string(comparison.region);
  BarChart chart = chart_of(comparison.title);
  for (std::size_t w = 0; w < runs.size(); ++w) {
    const std::string same = w == 0 ? "-" : equal(runs[w], runs[0], comparison.title, study);
    const std::string_view way = comparison.ways[w].name;
    const RegionReport whole = merged_report(runs[w].regions);
    add_region_row(comparison.title, "all", way, whole, runs[w].text(), same, study);
    add_region_row(comparison.title, region, way, region_named(runs[w].regions, region), "-", same,
                   study);
    chart.series.push_back({std::string(way), of_all_workers(whole)});
  }
  study.charts.push_back(std::move(chart));
  return {};
}

std::vector<std::string> columns_of_ways() {
  std::vector<std::string> names{"Stage", "Region", "Distribution", "Wall s"};
  for (std::string& name : region_columns()) names.push_back(std::move(name));
  names.emplace_back("Equal");
  return names;
}

}  // namespace

Status study_distribution(const StudyInput& input, StudyRecord& study) {
  constexpr std::array<SharingMode, 2> kWays{
      {{"competitive", Distribution::planned}, {"equal ranges", Distribution::equal_ranges}}};
  study.columns = columns_of_ways();
  const Result<SkewedScene> scene = place_skewed_scene(input);
  if (!scene) return scene.error();
  for (const Contender& stage : skewed_stages(*scene, kWorkersOfExample))
    if (const Status s = compare_ways(input, {stage, stage.name, kWays}, study); !s) return s;
  const Contender all_pairs =
      skewed_clashes(*scene, clash::BroadPhase::all_pairs, kWorkersOfExample);
  return compare_ways(
      input, {all_pairs, all_pairs.name + ", all pairs of boxes", kWays, "broad phase, all pairs"},
      study);
}

Status study_longest_first(const StudyInput& input, StudyRecord& study) {
  constexpr std::array<SharingMode, 2> kWays{
      {{"longest first", Distribution::planned}, {"as it comes", Distribution::in_order}}};
  study.columns = columns_of_ways();
  const Result<SkewedScene> scene = place_skewed_scene(input);
  if (!scene) return scene.error();
  for (const Contender& stage : skewed_stages(*scene, kWorkersOfExample))
    if (const Status s = compare_ways(input, {stage, stage.name, kWays}, study); !s) return s;
  return {};
}

}  // namespace strake::cli
