// SPDX-License-Identifier: Apache-2.0
// What is found by tiles is what is found in the whole model, to the last bit; what is lost is
// told.
#include "tiles/tiled_clash.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "rules/object_facts.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/writer.hpp"
#include "strake/parallel/team.hpp"
#include "support/io_files.hpp"
#include "support/same_reports.hpp"
#include "tiles/kept/blob_file.hpp"

namespace strake::tiles {
namespace {

constexpr const char* kRules = R"toml(
[sets]
pipes = "PIP*"

[[discipline]]
name = "piping"
select = "set(pipes)"

[[discipline]]
name = "steel"
select = "BEA* or PLA* or FRA*"

[matrix]
name = "by disciplines"

[matrix.cells.piping]
piping = "not checked"
steel = { clearance = "40mm" }

[[test]]
name = "pipes against the rest"
a = "set(pipes)"
b = "not set(pipes)"
clearance = "30mm"

[[test]]
name = "large hits"
clearance = "5mm"
min_volume = "1cm3"

[[exempt]]
name = "beams and meshes"
a = "BEA*"
b = "type = mesh"

[[same_assembly]]
name = "one room"
level = 4

[[same_assembly]]
name = "one room again"
level = 4

[[connected]]
name = "joints"
ends_within = "5mm"
among = "set(pipes)"

[[allowed]]
name = "pipes through anything"
a = "PIP*"
b = "*"
max_depth = "1m"

[[allowed]]
name = "pipes again"
a = "PIP*"
b = "*"
max_depth = "1m"
)toml";

struct Request {
  std::string rules = kRules;
  bool counts_contacts = false;
};

/// A run over files that were generated, whole and by tiles.
class TiledRun {
 public:
  explicit TiledRun(const std::vector<std::uint64_t>& seeds, Request request = {})
      : request_(std::move(request)) {
    for (const std::uint64_t seed : seeds) {
      const auto ship = generate::generate_ship({.objects = 700, .seed = seed}, {}).value();
      // Names are not in the order in which files are given.
      const auto file = folder_.path() / ("ship" + std::to_string(9 - seed) + ".glb");
      EXPECT_TRUE(io::write_glb(ship.model, file, {}, {}));
      files_.push_back({file, {}});
    }
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] const std::vector<io::FileToRead>& files() const { return files_; }

  [[nodiscard]] clash::Findings whole() const {
    const model::Model model = io::read_models(files_, {}).value();
    const rules::Rules rules = parsed();
    const model::Scene scene = make_scene(model, rules.scene_options(), {}).value();
    const rules::Plan plan = with_engine(rules.plan(scene, {}).value());
    clash::Findings findings;
    findings.diagnostics = plan.diagnostics;
    for (const rules::PlannedTest& test : plan.tests) {
      findings.tests.push_back(
          clash::detect(scene, test.sets, test.options, test.policy, {}).value());
      findings.tests.back().name = test.name;
    }
    findings.diagnostics.append(rules::idle_rules(plan, findings.tests));
    return findings;
  }

  /// Cuts the files and writes all tiles.
  [[nodiscard]] CutRun cut(std::uint64_t max_bytes) const {
    FileReader reader = this->reader();
    CutRun run = outlined(reader);
    tiles::cut(run, max_bytes);
    EXPECT_TRUE(write_tiles(run, reader, folder(), tiles_of(run), {}));
    return run;
  }

  [[nodiscard]] FileReader reader() const {
    return {files_, io::import_settings_of_environment(), folder()};
  }

  /// Reads the files.
  [[nodiscard]] CutRun outlined(FileReader& reader) const {
    const rules::Rules rules = parsed();
    CutRun run;
    run.scene = rules.scene_options();
    std::vector<rules::ObjectFacts> facts(files_.size());
    run.outline = outline_of(reader, run.scene, {},
                             [&](const model::Scene& scene, std::size_t given) -> Status {
                               facts[given] = rules.facts(scene, {}).value();
                               return {};
                             },
                             {})
                      .value();
    rules::ObjectFacts all;
    for (const Outline::File& file : run.outline.files) all.append(facts[file.given]);
    model::Scene names;
    names.model = &run.outline.model;
    run.plan = with_engine(rules.plan(names, std::move(all), {}).value());
    return run;
  }

  static std::vector<std::size_t> tiles_of(const CutRun& run) {
    std::vector<std::size_t> tiles(run.cells.size());
    std::iota(tiles.begin(), tiles.end(), std::size_t{0});
    return tiles;
  }

  [[nodiscard]] std::vector<std::filesystem::path> found(const CutRun& run) const {
    std::vector<std::filesystem::path> files;
    for (const std::size_t tile : tiles_of(run))
      files.push_back(folder() / ("found" + std::to_string(tile)));
    return files;
  }

  [[nodiscard]] clash::Findings by_tiles(const CutRun& run) const {
    const auto files = found(run);
    for (std::size_t tile = 0; tile < files.size(); ++tile)
      EXPECT_TRUE(find_in_tile(tile_file(folder(), tile), files[tile], {}));
    return join_found(run, files, {}).value();
  }

 private:
  [[nodiscard]] rules::Rules parsed() const {
    Result<rules::Rules> rules = rules::Rules::parse(request_.rules, "rules.toml");
    EXPECT_TRUE(rules) << rules.error().text();
    return *rules;
  }

  [[nodiscard]] rules::Plan with_engine(rules::Plan plan) const {
    for (rules::PlannedTest& test : plan.tests) {
      test.options.engine.volumes = clash::Volumes::on;
      test.policy.list_exempted = true;
      if (request_.counts_contacts) test.options.engine.contacts = clash::Contacts::count;
    }
    return plan;
  }

  Request request_;
  test::TemporaryFolder folder_;
  std::vector<io::FileToRead> files_;
};

void expect_same(const clash::Findings& whole, const clash::Findings& tiled) {
  ASSERT_EQ(whole.tests.size(), tiled.tests.size());
  for (std::size_t t = 0; t < whole.tests.size(); ++t)
    EXPECT_EQ(test::ReportDifference::of(whole.tests[t], tiled.tests[t]), "")
        << whole.tests[t].name;
  const auto stated = [](const clash::Findings& findings) {
    const Diagnostics diagnostics = findings.all_diagnostics();
    std::string all;
    for (const Diagnostic& d : diagnostics.kept())
      all += d.code + ": " + d.message + " (" + d.where + ")\n";
    return all;
  };
  EXPECT_EQ(stated(whole), stated(tiled));
}

TEST(TiledClash, finds_what_is_found_in_the_whole_model) {
  for (const bool counts : {false, true}) {
    const TiledRun files({1, 2}, {.rules = kRules, .counts_contacts = counts});
    const clash::Findings whole = files.whole();
    std::size_t pairs = 0;
    for (const clash::Report& report : whole.tests) pairs += report.pairs.size();
    ASSERT_GT(pairs, 500U);
    for (const std::uint64_t bytes :
         {std::uint64_t{1} << 40U, std::uint64_t{400'000}, std::uint64_t{100'000}}) {
      const CutRun run = files.cut(bytes);
      ASSERT_EQ(run.cells.size() == 1, bytes > 1'000'000'000);
      expect_same(whole, files.by_tiles(run));
      for (const unsigned workers : {2U, 3U, 8U}) {
        parallel::Team team(workers);
        expect_same(whole, join_found(run, files.found(run), {.team = &team}).value());
      }
    }
  }
}

/// What is kept of files in a folder.
std::vector<std::filesystem::path> kept_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> kept;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".strake-kept") kept.push_back(entry.path());
  return kept;
}

TEST(TiledClash, reads_several_files_once) {
  const TiledRun files({1, 2});
  const clash::Findings whole = files.whole();
  FileReader reader = files.reader();
  CutRun run = files.outlined(reader);
  cut(run, 200'000);
  const auto away = [](const io::FileToRead& file) { return file.path.string() + ".away"; };
  for (const io::FileToRead& file : files.files()) std::filesystem::rename(file.path, away(file));
  const auto write = [&] {
    reader.forget();
    return write_tiles(run, reader, files.folder(), TiledRun::tiles_of(run), {});
  };
  ASSERT_TRUE(write());
  expect_same(whole, files.by_tiles(run));
  // What is lost is read again, as long as it is what it was.
  const auto kept = kept_in(files.folder());
  ASSERT_EQ(kept.size(), 2U);
  std::filesystem::resize_file(kept[0], std::filesystem::file_size(kept[0]) - 3);
  std::filesystem::remove(kept[1]);
  EXPECT_EQ(write().error().code, ErrorCode::input);
  for (const io::FileToRead& file : files.files()) std::filesystem::rename(away(file), file.path);
  ASSERT_TRUE(write());
  expect_same(whole, files.by_tiles(run));
  std::filesystem::copy_file(files.files()[0].path, files.files()[1].path,
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(write().error().message, "changed while it was cut");
}

TEST(TiledClash, reports_tiles_and_results_that_are_lost) {
  const TiledRun files({3});
  const CutRun run = files.cut(200'000);
  const auto found = files.found(run);
  ASSERT_GT(found.size(), 2U);
  expect_same(files.whole(), files.by_tiles(run));
  std::filesystem::copy_file(found[1], found[0], std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(join_found(run, found, {}).error().message, kLost);
  std::filesystem::remove(found[0]);
  EXPECT_EQ(join_found(run, found, {}).error().message, kLost);
  const auto tile = tile_file(files.folder(), 0);
  for (const auto& entry : std::filesystem::directory_iterator(files.folder())) {
    const auto path = entry.path();
    if (path.stem() != tile.stem()) continue;
    const auto size = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, size - 3);
    EXPECT_EQ(find_in_tile(tile, found[0], {}).error().message, kLost) << path;
    static_cast<void>(files.cut(200'000));
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
        .seekp(static_cast<std::streamoff>(size / 2))
        .put('\x5a')
        .put('\xa5');
    EXPECT_EQ(find_in_tile(tile, found[0], {}).error().message, kLost) << path;
    std::filesystem::remove(path);
    EXPECT_EQ(find_in_tile(tile, found[0], {}).error().message, kLost) << path;
    static_cast<void>(files.cut(200'000));
  }
  EXPECT_TRUE(find_in_tile(tile, found[0], {}));
  expect_same(files.whole(), join_found(run, found, {}).value());
}

}  // namespace
}  // namespace strake::tiles
