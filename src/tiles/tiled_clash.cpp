// SPDX-License-Identifier: Apache-2.0
#include "tiles/tiled_clash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "clash/detect.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "clash/tiles/join_tiles.hpp"
#include "clash/tiles/some_objects.hpp"
#include "project/codec/blob.hpp"
#include "project/stored_report/report_codec.hpp"
#include "strake/parallel/for_each.hpp"
#include "tiles/blob_file.hpp"
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

/// Writes tiles section by section.
class TileWriter {
 public:
  TileWriter(const CutRun& run, FileReader& reader, const std::filesystem::path& folder,
             std::span<const std::size_t> tiles, const parallel::Context& context)
      : run_(run), reader_(reader), folder_(folder), tiles_(tiles), context_(context) {
    sections_.resize(tiles.size());
  }

  Status run() {
    for (std::uint32_t f = 0; f < run_.outline.files.size(); ++f)
      if (Status s = write_file(f); !s) return s;
    return parallel::for_each(context_, {.name = "write tiles", .n = tiles_.size()},
                              [&](std::size_t k) { return write_head_of(k); });
  }

 private:
  Status write_file(std::uint32_t f) {
    const Outline::File& file = run_.outline.files[f];
    const Result<const model::Model*> model = reader_.read(file.given, context_);
    if (!model) return model.error();
    const bool several = run_.outline.files.size() > 1;
    if ((*model)->objects.size() != file.objects || (several && hash_of_ids(**model) != file.names))
      return Error{ErrorCode::input, "changed while it was cut",
                   reader_.files()[file.given].path.string(), "run the test again"};
    return parallel::for_each(
        context_, {.name = "cut a file", .n = tiles_.size()}, [&](std::size_t k) -> Status {
          const std::vector<std::uint32_t>& all = run_.cells[tiles_[k]].objects;
          const auto first = std::ranges::lower_bound(all, file.first);
          const auto last = std::ranges::lower_bound(all, file.first + file.objects);
          if (first == last) return {};
          std::vector<std::uint32_t> objects(first, last);
          for (std::uint32_t& o : objects) o -= file.first;
          Result<Section> section =
              write_section(tile_file(folder_, tiles_[k]), f, **model, objects);
          if (!section) return section.error();
          section->first = static_cast<std::uint32_t>(first - all.begin());
          section->last = static_cast<std::uint32_t>(last - all.begin());
          sections_[k].push_back(*section);
          return {};
        });
  }

  [[nodiscard]] Status write_head_of(std::size_t k) const {
    const CutCell& cell = run_.cells[tiles_[k]];
    Tile tile;
    tile.cell = cell.cell;
    tile.scene = run_.scene;
    tile.objects = cell.objects;
    tile.tests = tests_of(run_.plan, cell.objects);
    tile.sections = sections_[k];
    tile.model.files = run_.outline.model.files;
    return write_head(tile_file(folder_, tiles_[k]), tile);
  }

  const CutRun& run_;
  FileReader& reader_;
  const std::filesystem::path& folder_;
  std::span<const std::size_t> tiles_;
  const parallel::Context& context_;
  std::vector<std::vector<Section>> sections_;
};

Hash128 hash_of(std::span<const std::uint32_t> objects) {
  return hash_bytes(std::as_bytes(objects));
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

std::filesystem::path tile_file(const std::filesystem::path& folder, std::size_t tile) {
  return folder / fmt::format("tile{:06}.strake-tile", tile);
}

void cut(CutRun& run, std::uint64_t most_bytes) {
  const std::vector<std::int64_t> reach = reaches(run);
  std::vector<Extent> grown = run.outline.extents;
  for (std::size_t o = 0; o < grown.size(); ++o)
    if (!grown[o].box.empty()) grown[o].box = grown[o].box.inflated(reach[o]);
  run.cells = cut_space(grown, most_bytes);
}

Status write_tiles(const CutRun& run, FileReader& reader, const std::filesystem::path& folder,
                   std::span<const std::size_t> tiles, const parallel::Context& context) {
  return TileWriter(run, reader, folder, tiles, context).run();
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
  for (const rules::PlannedTest& test : read->tests) {
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
