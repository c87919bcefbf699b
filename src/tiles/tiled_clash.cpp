// SPDX-License-Identifier: Apache-2.0
#include "tiles/tiled_clash.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clash/detect.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "clash/tiles/join_tiles.hpp"
#include "clash/tiles/some_objects.hpp"
#include "tiles/found_file.hpp"
#include "tiles/found_merge.hpp"
#include "tiles/kept/blob_file.hpp"
#include "tiles/test_codec.hpp"
#include "tiles/tile.hpp"

namespace strake::tiles {
namespace {

/// Returns by how much the boxes of each object are to grow so that those of two meet where a test
/// looks at the two.
std::vector<std::int64_t> reaches(const CutRun& run) {
  std::vector<double> largest(run.outline.extents.size(), 0);
  for (const rules::PlannedTest& test : run.plan.tests) {
    const clash::SearchReach reach =
        clash::search_reach(clash::all_tolerances(test.policy, test.options));
    for (std::size_t o = 0; o < largest.size(); ++o) {
      const double own = reach.of_object.empty() ? 0 : reach.of_object[o];
      largest[o] = std::max(largest[o], reach.of_all / 2 + own);
    }
  }
  std::vector<std::int64_t> units(largest.size());
  for (std::size_t o = 0; o < largest.size(); ++o)
    units[o] = static_cast<std::int64_t>(std::ceil(largest[o])) + 1;
  return units;
}

/// Returns what a plan says of the objects of a tile.
std::vector<rules::PlannedTest> tests_of(const rules::Plan& plan,
                                         std::span<const std::uint32_t> objects) {
  std::vector<rules::PlannedTest> tests;
  for (const rules::PlannedTest& test : plan.tests)
    tests.push_back({test.name, clash::options_of(test.options, objects),
                     clash::sets_of(test.sets, objects), clash::policy_of(test.policy, objects)});
  return tests;
}

/// Puts together what one test found in all tiles; its results there are used up.
Result<clash::Report> join_test(const CutRun& run, std::vector<FoundFile>& files, std::size_t t,
                                const parallel::Context& context) {
  const rules::PlannedTest& test = run.plan.tests[t];
  const clash::WholeTest whole{run.outline.model, run.outline.lacking, run.scene.weld_mm,
                               test.sets,         test.options,        test.policy};
  clash::TileJoin join(whole);
  std::uint64_t pairs = 0, regions = 0;
  for (const FoundFile& file : files) {
    const FoundTest& of_file = file.test(t);
    if (!join.fits(of_file.tile)) return lost(file.path());
    pairs += of_file.pairs;
    regions += of_file.regions;
  }
  join.make_room(pairs, regions);
  if (const Status s = merge_found(files, t, join, context); !s) return s.error();
  for (FoundFile& file : files) {
    file.test(t).parts = {};
    join.add(std::move(file.test(t).tile), file.objects());
  }
  Result<clash::Report> report = std::move(join).finish(context);
  if (report) report->name = test.name;
  return report;
}

}  // namespace

void cut(CutRun& run, std::uint64_t max_bytes) {
  const std::vector<std::int64_t> reach = reaches(run);
  std::vector<Extent> grown = run.outline.extents;
  for (std::size_t o = 0; o < grown.size(); ++o)
    if (!grown[o].box.empty()) grown[o].box = grown[o].box.inflated(reach[o]);
  run.cells = cut_space(grown, max_bytes);
}

Status write_tiles(const CutRun& run, FileReader& reader, const std::filesystem::path& folder,
                   std::span<const std::size_t> tiles, const parallel::Context& context) {
  const auto objects_of = [&](std::size_t k) {
    return std::span<const std::uint32_t>(run.cells[k].objects);
  };
  const auto head_of = [&](std::size_t k) -> Result<Tile> {
    Tile tile;
    tile.cell = run.cells[k].cell;
    tile.scene = run.scene;
    for (const rules::PlannedTest& test : tests_of(run.plan, run.cells[k].objects)) {
      Result<Blob> blob = encode_test(test);
      if (!blob) return blob.error();
      tile.tasks.push_back(std::move(*blob));
    }
    return tile;
  };
  return write_tiles(TilesToWrite{run.outline, reader, folder, tiles, objects_of, head_of},
                     context);
}

Status find_in_tile(const std::filesystem::path& tile, const std::filesystem::path& found,
                    const parallel::Context& context) {
  Result<Tile> read = read_tile(tile, context);
  if (!read) return read.error();
  const Result<model::Scene> scene = model::make_scene(read->model, read->scene, context);
  if (!scene) return scene.error();
  FoundWriter out(read->objects);
  for (const Blob& task : read->tasks) {
    const auto decoded = decode_test(task, read->objects.size(), tile.string());
    if (!decoded) return lost(tile);
    const rules::PlannedTest& test = *decoded;
    const Result<clash::TileReport> report =
        clash::detect_tile(*scene, test.sets, test.options, test.policy, read->cell, context);
    if (!report) return report.error();
    if (Status s = out.add(*report); !s) return s;
  }
  return std::move(out).write(found);
}

Result<clash::Findings> join_found(const CutRun& run, std::span<const std::filesystem::path> found,
                                   const parallel::Context& context) {
  std::vector<FoundFile> files;
  for (std::size_t k = 0; k < found.size(); ++k) {
    Result<FoundFile> file =
        FoundFile::open(found[k], run.cells[k].objects, run.plan.tests.size(), context);
    if (!file) return file.error();
    files.push_back(std::move(*file));
  }
  clash::Findings findings;
  findings.diagnostics = run.plan.diagnostics;
  for (std::size_t t = 0; t < run.plan.tests.size(); ++t) {
    Result<clash::Report> report = join_test(run, files, t, context);
    if (!report) return report.error();
    findings.tests.push_back(std::move(*report));
  }
  findings.diagnostics.append(rules::idle_rules(run.plan, findings.tests));
  return findings;
}

}  // namespace strake::tiles
