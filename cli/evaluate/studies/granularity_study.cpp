// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/studies/region_times.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "cli/evaluate/studies/study_scenes.hpp"
#include "strake/clash/clash.hpp"

namespace strake::cli {

namespace {

constexpr std::size_t kCells = 7;  // between the unit of work and the note

/// A unit of work that can be run.
struct WorkUnit {
  std::string algorithm, name;
  Contender contender;
  std::size_t min_chunk = 1;
  std::vector<std::string_view> regions = {};  ///< that have these items
};

/// A unit of work that no run has, and why.
struct InadmissibleUnit {
  std::string_view algorithm, name, reason;
};

constexpr std::string_view kLocal = "local hidden lines", kGlobal = "global hidden lines",
                           kClash = "clash detection";

constexpr std::array<InadmissibleUnit, 5> kForbidden{{
    {kLocal, "reference plane",
     "all planes of an object write to the same lines, which would have to be locked for each "
     "test, or joined after"},
    {kLocal, "line and plane",
     "feedback: what one plane leaves of a line is what the next begins with; and a test takes "
     "less than to hand it out"},
    {kGlobal, "plane of an object above",
     "its planes have the same objects under them, so that each write wants their locks: those of "
     "whole objects above, as many more as an object has planes"},
    {kGlobal, "object under one object",
     "all objects under one have to be found first, and the next above begins with what this one "
     "leaves: a barrier behind each, at which all wait for the slowest"},
    {kGlobal, "plane or line under one plane",
     "feedback, as within an object: each begins with what the one before leaves"},
}};

/// Returns the seven cells of a unit that was run.
std::vector<std::string> unit_cells(const StudyRun& run, const parallel::RegionReport& region,
                                    std::string same) {
  std::vector<std::string> cells{run.text(),
                                 region.items == 0 ? "-" : std::to_string(region.items)};
  const std::vector<std::string> times = cli::cells_of(region);
  cells.insert(cells.end(), times.begin(), times.begin() + 4);
  cells.push_back(std::move(same));
  return cells;
}

void add_unit_row(std::string_view algorithm, std::string_view unit, std::vector<std::string> cells,
                  std::string note, StudyRecord& study) {
  std::vector<std::string> row{std::string(algorithm), std::string(unit)};
  cells.resize(kCells, "-");
  for (std::string& cell : cells) row.push_back(std::move(cell));
  row.push_back(std::move(note));
  study.rows.push_back(std::move(row));
}

/// Runs units of one algorithm; the results of all are that of the first.
Status run_units(const StudyInput& input, const std::vector<WorkUnit>& units, StudyRecord& study) {
  StudyRun first;
  for (const WorkUnit& unit : units) {
    input.narrate(fmt::format("granularity, {}: {}", unit.algorithm, unit.name));
    Result<StudyRun> run =
        run_for_study(input, unit.contender, {.min_chunk = unit.min_chunk, .with_regions = true});
    if (!run) return run.error();
    const bool is_first = &unit == &units.front();
    if (is_first) first = std::move(*run);
    const StudyRun& done = is_first ? first : *run;
    const parallel::RegionReport region = merged_report(done.regions, unit.regions);
    std::string same =
        is_first ? "-" : equal(done, first, unit.algorithm + ", " + unit.name, study);
    add_unit_row(unit.algorithm, unit.name, unit_cells(done, region, std::move(same)),
                 fmt::format("{}", fmt::join(unit.regions, ", ")), study);
  }
  return {};
}

/// Returns the units of hidden lines: edges in runs, finer and coarser, and whole objects.
std::vector<WorkUnit> units_of_lines(const SkewedScene& scene, hlr::Stage stage) {
  constexpr unsigned kEdges = 32;  // of an item of the engine
  const bool local = stage == hlr::Stage::local;
  const std::string algorithm(local ? kLocal : kGlobal);
  std::vector<WorkUnit> units;
  for (const std::size_t chunk : {1U, 16U, 256U})
    units.push_back({algorithm,
                     fmt::format("up to {} edges", kEdges * chunk),
                     skewed_lines(scene, stage, kWorkersOfExample),
                     chunk,
                     {"hidden lines: edges"}});
  hlr::Options push;
  push.stage = stage;
  push.solver = hlr::Solver::push;
  units.push_back({algorithm,
                   local ? "object" : "object above (push)",
                   drawing_contender(algorithm, kWorkersOfExample, scene.view.ship.scene,
                                     scene.view.view, push),
                   1,
                   {local ? "push: local step" : "push: global step"}});
  return units;
}

std::vector<WorkUnit> units_of_clashes(const SkewedScene& scene) {
  constexpr unsigned kPairs = 8;  // of a block of the engine
  std::vector<WorkUnit> units;
  for (const std::size_t chunk : {1U, 16U, 256U})
    units.push_back({std::string(kClash),
                     fmt::format("up to {} pairs of parts", kPairs * chunk),
                     skewed_clashes(scene, clash::BroadPhase::tree, kWorkersOfExample),
                     chunk,
                     {"simple pairs", "oriented boxes", "narrow phase", "depth", "distance"}});
  return units;
}

/// Adds a row for pairs of objects. The engine has no such item, as pairs of parts that stand alike
/// are evaluated once, whatever objects they belong to: their work is counted, not timed.
Status add_object_pairs(const StudyInput& input, const SkewedScene& scene, StudyRecord& study) {
  const model::Scene& placed = scene.clashing.scene;
  clash::Options options = scene.options;
  options.engine.log_pairs = true;
  const Result<clash::Report> report =
      clash::detect(placed, clash::one_set(placed), options, {.stop = input.stop});
  if (!report) return report.error();
  double all = 0, largest = 0;
  for (const clash::LoggedPair& pair : report->log) {
    const auto cost = static_cast<double>(pair.cost());
    all += cost;
    largest = std::max(largest, cost);
  }
  const double share = all / kWorkersOfExample;
  std::vector<std::string> cells(kCells, "-");
  cells[1] = std::to_string(report->log.size());
  if (largest > 0) cells[5] = fmt::format("{:.2f}", std::min(1.0, share / largest));
  add_unit_row(
      kClash, "pair of objects", std::move(cells),
      "by counted work: equal pairs of parts are evaluated once for all objects, so that no "
      "pair of objects is an item",
      study);
  return {};
}

}  // namespace

Status study_granularity(const StudyInput& input, StudyRecord& study) {
  study.columns = {"Algorithm",  "Unit",    "Wall s", "Items", "Least s",
                   "Greatest s", "Balance", "Bound",  "Equal", "Note"};
  const Result<SkewedScene> scene = place_skewed_scene(input);
  if (!scene) return scene.error();
  for (const hlr::Stage stage : {hlr::Stage::local, hlr::Stage::global}) {
    if (const Status s = run_units(input, units_of_lines(*scene, stage), study); !s) return s;
    for (const InadmissibleUnit& one : kForbidden)
      if (one.algorithm == (stage == hlr::Stage::local ? kLocal : kGlobal))
        add_unit_row(one.algorithm, one.name, {}, "not run: " + std::string(one.reason), study);
  }
  if (const Status s = run_units(input, units_of_clashes(*scene), study); !s) return s;
  return add_object_pairs(input, *scene, study);
}

}  // namespace strake::cli
