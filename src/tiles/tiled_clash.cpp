// SPDX-License-Identifier: Apache-2.0
#include "tiles/tiled_clash.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clash/detect.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "clash/tiles/join_tiles.hpp"
#include "clash/tiles/some_objects.hpp"
#include "project/codec/blob.hpp"
#include "project/stored_report/report_codec.hpp"
#include "tiles/blob_file.hpp"
#include "tiles/test_codec.hpp"
#include "tiles/tile.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// Returns by how much the boxes of each object are to grow so that those of two meet where a test
/// looks at the two.
std::vector<std::int64_t> reaches(const CutRun& run) {
  std::vector<double> most(run.outline.extents.size(), 0);
  for (const rules::PlannedTest& test : run.plan.tests) {
    const clash::SearchReach reach =
        clash::search_reach(clash::all_tolerances(test.policy, test.options));
    for (std::size_t o = 0; o < most.size(); ++o) {
      const double own = reach.of_object.empty() ? 0 : reach.of_object[o];
      most[o] = std::max(most[o], reach.of_all / 2 + own);
    }
  }
  std::vector<std::int64_t> units(most.size());
  for (std::size_t o = 0; o < most.size(); ++o)
    units[o] = static_cast<std::int64_t>(std::ceil(most[o])) + 1;
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

/// How many results a tile has of each test.
struct FoundCounts {
  std::uint64_t pairs = 0, regions = 0;
};

/// Encodes the report of a tile: one blob with what joins it, one for the head, then its parts.
Status append_found(const clash::TileReport& tile, std::size_t objects, std::vector<Blob>& blobs) {
  const std::vector<std::int64_t> rows(tile.report.pairs.size(), 0);
  const project::ReportRows report(tile.report, rows);
  Result<Blob> head = project::encode_head(tile.report);
  if (!head) return head.error();
  std::vector<Blob> parts;
  std::vector<Hash128> hashes;
  for (const project::PartRange& range : project::parts_of(tile.report, objects)) {
    Result<Blob> part = project::encode_part(report, range);
    if (!part) return part.error();
    hashes.push_back(hash_bytes(*part));
    parts.push_back(std::move(*part));
  }
  BlobWriter out;
  out.hash(tile.hash_sum);
  for (const std::uint64_t n : {tile.hashed, tile.box_pairs, tile.parts}) out.number(n);
  out.column(std::span(tile.unknown_sag));
  out.number(parts.size());
  out.hash(project::seal_of(*head, {}, hashes));
  Result<Blob> start = out.finish();
  if (!start) return start.error();
  blobs.push_back(std::move(*start));
  blobs.push_back(std::move(*head));
  std::ranges::move(parts, std::back_inserter(blobs));
  return {};
}

/// Takes the reports of a tile out of their blobs, in order.
class FoundReader {
 public:
  /// The path must outlive this. Errors: input (kLost).
  static Result<FoundReader> open(const std::filesystem::path& file,
                                  const parallel::Context& context) {
    Result<std::vector<Blob>> blobs = read_blobs(file, 1, context);
    if (!blobs) return blobs.error();
    return FoundReader(std::move(*blobs), file);
  }

  /// Returns how much it has of each test. Errors: input where it is not of that tile.
  Result<std::vector<FoundCounts>> counts(std::span<const std::uint32_t> objects,
                                          std::size_t tests) {
    Result<BlobReader> in = next();
    if (!in) return in.error();
    const bool fits = in->number() == objects.size() && in->hash() == hash_of(objects);
    std::vector<FoundCounts> counts(tests);
    for (FoundCounts& of_test : counts) {
      of_test.pairs = in->number();
      of_test.regions = in->number();
    }
    if (!fits || !in->finish()) return lost(file_);
    return counts;
  }

  Result<clash::TileReport> report(std::size_t objects, const parallel::Context& context) {
    Result<BlobReader> in = next();
    if (!in) return in.error();
    clash::TileReport tile;
    tile.hash_sum = in->hash();
    for (std::uint64_t* const n : {&tile.hashed, &tile.box_pairs, &tile.parts}) *n = in->number();
    tile.unknown_sag = in->column<std::uint8_t>();
    const std::uint64_t parts = in->number();
    project::EncodedReport encoded;
    encoded.seal = in->hash();
    if (!in->finish() || at_ >= blobs_.size() || parts > blobs_.size() - at_ - 1)
      return lost(file_);
    const Blob head = std::move(blobs_[at_++]);
    encoded.head = head;
    for (std::uint64_t p = 0; p < parts; ++p) encoded.parts.push_back(std::move(blobs_[at_++]));
    Result<project::RememberedReport> report =
        project::decode_report(encoded, objects, file_.string(), context);
    if (!report) return report.error().code == ErrorCode::input ? lost(file_) : report.error();
    tile.report = std::move(report->report);
    return tile;
  }

 private:
  FoundReader(std::vector<Blob> blobs, const std::filesystem::path& file)
      : blobs_(std::move(blobs)), file_(file) {}

  Result<BlobReader> next() {
    if (at_ >= blobs_.size()) return lost(file_);
    Result<BlobReader> in = BlobReader::open(blobs_[at_++], file_.string());
    if (!in && in.error().code == ErrorCode::input) return lost(file_);
    return in;
  }

  std::vector<Blob> blobs_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

}  // namespace

void cut(CutRun& run, std::uint64_t most_bytes) {
  const std::vector<std::int64_t> reach = reaches(run);
  std::vector<Extent> grown = run.outline.extents;
  for (std::size_t o = 0; o < grown.size(); ++o)
    if (!grown[o].box.empty()) grown[o].box = grown[o].box.inflated(reach[o]);
  run.cells = cut_space(grown, most_bytes);
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
  BlobWriter out;
  out.number(read->objects.size());
  out.hash(hash_of(read->objects));
  std::vector<Blob> blobs(1);
  for (const Blob& task : read->tasks) {
    const auto decoded = decode_test(task, read->objects.size(), tile.string());
    if (!decoded) return lost(tile);
    const rules::PlannedTest& test = *decoded;
    const Result<clash::TileReport> report =
        clash::detect_tile(*scene, test.sets, test.options, test.policy, read->cell, context);
    if (!report) return report.error();
    out.number(report->report.pairs.size());
    out.number(report->report.regions.size());
    if (Status s = append_found(*report, read->objects.size(), blobs); !s) return s;
  }
  Result<Blob> start = out.finish();
  if (!start) return start.error();
  blobs.front() = std::move(*start);
  return write_blobs(found, blobs);
}

Result<clash::Findings> join_found(const CutRun& run, std::span<const std::filesystem::path> found,
                                   const parallel::Context& context) {
  std::vector<clash::TileJoin> joins;
  std::vector<clash::WholeTest> tests;
  for (const rules::PlannedTest& test : run.plan.tests)
    tests.push_back({run.outline.model, run.outline.lacking, run.scene.weld_mm, test.sets,
                     test.options, test.policy});
  for (const clash::WholeTest& test : tests) joins.emplace_back(test);
  std::vector<FoundCounts> all(joins.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    Result<FoundReader> reader = FoundReader::open(found[k], context);
    if (!reader) return reader.error();
    const auto counts = reader->counts(run.cells[k].objects, joins.size());
    if (!counts) return counts.error();
    for (std::size_t t = 0; t < joins.size(); ++t) {
      all[t].pairs += (*counts)[t].pairs;
      all[t].regions += (*counts)[t].regions;
    }
  }
  for (std::size_t t = 0; t < joins.size(); ++t) joins[t].make_room(all[t].pairs, all[t].regions);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::vector<std::uint32_t>& objects = run.cells[k].objects;
    Result<FoundReader> reader = FoundReader::open(found[k], context);
    if (!reader) return reader.error();
    if (const auto counts = reader->counts(objects, joins.size()); !counts) return counts.error();
    for (clash::TileJoin& join : joins) {
      Result<clash::TileReport> report = reader->report(objects.size(), context);
      if (!report) return report.error();
      if (!join.fits(*report)) return lost(found[k]);
      join.add(std::move(*report), objects);
    }
  }
  clash::Findings findings;
  findings.diagnostics = run.plan.diagnostics;
  for (std::size_t t = 0; t < joins.size(); ++t) {
    Result<clash::Report> report = std::move(joins[t]).finish(context);
    if (!report) return report.error();
    report->name = run.plan.tests[t].name;
    findings.tests.push_back(std::move(*report));
  }
  findings.diagnostics.append(rules::idle_rules(run.plan, findings.tests));
  return findings;
}

}  // namespace strake::tiles
