// SPDX-License-Identifier: Apache-2.0
// The model of a project is the one that was read of its files, whatever was stored in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "project/model/shape_packs.hpp"
#include "strake/generate/ship.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/project.hpp"
#include "support/equal_models.hpp"
#include "support/io_files.hpp"
#include "support/io_seeds.hpp"
#include "support/rvm_writer.hpp"
#include "support/stored_models.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

class ModelStoreTest : public ::testing::Test {
 protected:
  Project make() {
    Result<Project> project = Project::create(folder_.path() / "ship.strake");
    EXPECT_TRUE(project) << (project ? "" : project.error().text());
    return std::move(*project);
  }
  [[nodiscard]] fs::path write(const std::string& name, std::string_view text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    return folder_.write(name, text);
  }
  [[nodiscard]] fs::path write_ship(const std::string& name, const generate::ShipOptions& options,
                                    bool as_obj = false) const {
    const auto ship = generate::generate_ship(options, {});
    EXPECT_TRUE(ship);
    const fs::path path = folder_.path() / name;
    const Status written = as_obj ? io::write_obj(ship->model, path, {}, {})
                                  : io::write_glb(ship->model, path, {}, {});
    EXPECT_TRUE(written) << (written ? "" : written.error().text());
    return path;
  }
  /// The project's model, opened anew, against that of the files.
  void expect_model_of(const Paths& paths) const {
    const auto read = io::read_models(paths, {}, {});
    ASSERT_TRUE(read) << read.error().text();
    auto project = Project::open(folder_.path() / "ship.strake", {});
    ASSERT_TRUE(project) << project.error().text();
    for (const unsigned workers : {1U, 3U}) {
      parallel::Team team(workers);
      const auto stored = project->model({.team = &team});
      ASSERT_TRUE(stored) << stored.error().text();
      EXPECT_EQ(test::model_difference(*read, *stored), "");
    }
    const auto files = project->files();
    ASSERT_TRUE(files) << files.error().text();
    ASSERT_EQ(files->size(), read->files.size());
    for (std::size_t f = 0; f < files->size(); ++f)
      EXPECT_TRUE(test::same_file((*files)[f].source, read->files[f]));
    EXPECT_TRUE(check_packs(project->database(), {}));
  }
  void expect_stored(Project& project, const Paths& paths) const {
    const Status stored = test::store(project, paths);
    ASSERT_TRUE(stored) << stored.error().text();
  }

  test::TemporaryFolder folder_;
};

/// An RVM file with most kinds of primitives, some of them twice, and groups in groups.
std::string plant(float at) {
  test::RvmWriter w;
  w.head().modl().cntb("/SITE").cntb("/PIPE 1").cntb("BRANCH 1");
  for (int i = 0; i < 3; ++i)
    w.prim(8, {50, 400}, test::RvmWriter::at(at, static_cast<float>(i), 0.123456F));
  w.prim(4, {100, 20, 1.5F}).cnte().cnte().cntb("/BOX");
  w.prim(2, {10, 20, 30}).prim(1, {100, 90, 80, 70, 5, -5, 60}).prim(3, {100, 150, 20, 1.5F});
  w.prim(5, {100, 40}).prim(7, {50, 40, 100, 5, 6, 0.1F, 0, 0, 0}).prim(9, {80});
  w.volume("INSU", 50, 8, {25, 300}).prim(10, {5, 100});
  w.facets({{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {{2, 2, 0}, {2, 4, 0}, {4, 4, 0}}}});
  w.cnte().cnte().finish();
  const auto& bytes = w.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

constexpr std::string_view kAttributes =
    "CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&\n"
    "NEW /SITE\nType := SITE\nNEW /PIPE 1\nName := /PIPE 1 &end& DN := 150mm\nNEW BRANCH 1\n"
    "Owner := yard\nEND\nEND\nNEW /BOX\nRefNo := =1/2\nEND\nEND\n";

TEST_F(ModelStoreTest, SeedsOfAllFormatsComeBack) {
  Paths paths;
  for (const auto& seeds : {test::obj_seeds(), test::stl_seeds(), test::gltf_seeds()})
    for (const test::Seed& seed : seeds) {
      const fs::path path = write("seeds/" + seed.name, seed.bytes);
      if (io::read_models(std::array{path}, {}, {})) paths.push_back(path);
    }
  ASSERT_GT(paths.size(), 4U);
  paths.push_back(write("seeds/plant.rvm", plant(1)));
  static_cast<void>(write("seeds/plant.att", kAttributes));
  Project project = make();
  expect_stored(project, paths);
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, ShipsOfAllKindsComeBack) {
  Paths paths;
  std::uint64_t seed = 1;
  for (const bool turned : {false, true})
    for (std::size_t kind = 0; kind < generate::kShipKinds.size(); ++kind, ++seed)
      paths.push_back(write_ship("ship" + std::to_string(seed) + (turned ? ".obj" : ".glb"),
                                 {.objects = 300 + seed,
                                  .seed = seed,
                                  .turned = turned,
                                  .imported_detail = turned ? 1U : 0U,
                                  .imported_triangles = 2000,
                                  .kind = static_cast<generate::ShipKind>(kind)},
                                 turned));
  Project project = make();
  expect_stored(project, paths);
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, LabelsDependOnAllFilesTogether) {
  const Paths paths{write("fore/b/hull.rvm", plant(1)), write("aft/b/hull.rvm", plant(2)),
                    write("aft/pipes.rvm", plant(3)), write("aft/c/hull.rvm", plant(4))};
  Project project = make();
  // One by one, so that each changes the labels of those before it.
  for (std::size_t n = 0; n < paths.size(); ++n) {
    expect_stored(project, {paths[n]});
    expect_model_of({paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(n) + 1});
  }
  const auto files = project.files();
  ASSERT_TRUE(files);
  EXPECT_EQ((*files)[0].source.label, "aft/b/hull.rvm");
  EXPECT_EQ((*files)[0].path, paths[1]);
}

TEST_F(ModelStoreTest, RepeatedIdsAreCountedAsWhenTheyWereRead) {
  // More of them than are kept word for word, in two files.
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 90; ++i)
    for (int k = 0; k < 3; ++k)
      text += "o part " + std::to_string(i) + "\nf 1 2 3\n" + (k == 1 ? "f 1 2 7\n" : "");
  const Paths paths{write("z/a.obj", text), write("y/a.obj", text + "o last\nf 3 2 1\n")};
  Project project = make();
  expect_stored(project, paths);
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, AFileThatChangedTakesItsPlace) {
  const Paths paths{write("a.rvm", plant(1)), write("b.obj", test::obj_seeds()[1].bytes),
                    write_ship("c.glb", {.objects = 200})};
  Project project = make();
  expect_stored(project, paths);
  const auto id_of_b = test::number(project, "SELECT id FROM file WHERE name = 'b.obj'");
  static_cast<void>(write_ship("c.glb", {.objects = 220, .seed = 7}));
  static_cast<void>(write("b.obj", test::obj_seeds()[2].bytes));
  expect_stored(project, {paths[2], paths[1]});
  expect_model_of(paths);
  EXPECT_EQ(test::number(project, "SELECT id FROM file WHERE name = 'b.obj'"), id_of_b);
}

TEST_F(ModelStoreTest, RenamedFilesTakePlaces) {
  Paths paths{write("a.rvm", plant(1)), write("b.rvm", plant(2)), write("c.rvm", plant(3))};
  Project project = make();
  expect_stored(project, paths);
  const auto id = [&](const char* name) {
    return test::number(project, std::string("SELECT id FROM file WHERE name = '") + name + "'");
  };
  // The first two change their names with each other.
  std::vector<FileToStore> files;
  for (const auto& [path, old] : {std::pair{paths[1], id("a.rvm")}, {paths[0], id("b.rvm")}}) {
    auto file = read_file({path, {}}, {});
    ASSERT_TRUE(file);
    file->replaces = old;
    files.push_back(std::move(*file));
  }
  {
    auto transaction = Transaction::begin(project.database());
    ASSERT_TRUE(transaction);
    const Status stored = store_files(project, files, {});
    ASSERT_TRUE(stored) << stored.error().text();
    ASSERT_TRUE(transaction->commit());
  }
  std::swap(paths[0], paths[1]);
  expect_model_of(paths);

  const auto refuses = [&](std::vector<FileToStore> wrong) {
    auto transaction = Transaction::begin(project.database());
    ASSERT_TRUE(transaction);
    const Status stored = store_files(project, wrong, {});
    ASSERT_FALSE(stored);
    EXPECT_EQ(stored.error().code, ErrorCode::usage) << stored.error().text();
  };
  const FileToStore twice = files[0];
  refuses({twice, twice});
  FileToStore other = files[0];  // would be where another one is
  other.replaces = id("c.rvm");
  refuses({other});
  other.replaces = 999;
  refuses({other});
  FileToStore none = files[0];
  none.model.files.clear();
  refuses({none});
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, FilesThatLieOtherwiseOnAMapAreReported) {
  Project project = make();
  std::vector<FileToStore> files;
  for (const char* const name : {"b.rvm", "a.rvm", "c.rvm", "d.rvm"}) {
    auto file = read_file({write(name, plant(1)), {}}, {});
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_FALSE(file->map);
    files.push_back(std::move(*file));
  }
  io::MapPlace place{.crs = "EPSG:25832", .to_map = {}};
  place.to_map.translation = {463'000'500.125, 5'428'000'250, -0.0};
  for (const std::size_t f : {0U, 1U, 3U}) files[f].map = place;
  files[0].map->to_map.translation.x += 0.125;
  files[3].map->crs = "EPSG:1";
  const auto put = [&](std::span<const FileToStore> some) {
    auto transaction = Transaction::begin(project.database());
    ASSERT_TRUE(transaction);
    const Status stored = store_files(project, some, {});
    ASSERT_TRUE(stored) << stored.error().text();
    ASSERT_TRUE(transaction->commit());
  };
  put(files);
  const auto reported = [&] {
    auto reader = Project::open(folder_.path() / "ship.strake", {});
    EXPECT_TRUE(reader);
    const auto model = reader->model({});
    EXPECT_TRUE(model) << model.error().text();
    std::vector<Diagnostic> notes;
    for (const Diagnostic& one : model->diagnostics.kept())
      if (one.code == "map-place-differs") notes.push_back(one);
    return notes;
  };
  // The others lie as the first by name does, on another map, and nowhere.
  ASSERT_EQ(reported().size(), 1U);
  EXPECT_EQ(reported()[0].where, files[0].given);
  EXPECT_NE(reported()[0].message.find(files[1].given), std::string::npos) << reported()[0].message;
  // A file that is read again lies where it says then.
  files[0].map = files[1].map;
  put(std::span(files).first(1));
  EXPECT_TRUE(reported().empty());
  files[1].map.reset();
  files[0].map->to_map.linear.row[0].x = 2;
  put(std::span(files).first(2));
  EXPECT_TRUE(reported().empty()) << "it is the only one on its map";
  EXPECT_EQ(test::number(project, "SELECT count(*) FROM map_place"), 2);
  const std::int64_t id = test::number(project, "SELECT id FROM file WHERE name = 'b.rvm'");
  ASSERT_TRUE(test::take_out(project, std::array{id}));
  EXPECT_EQ(test::number(project, "SELECT count(*) FROM map_place"), 1);
}

TEST_F(ModelStoreTest, APlaceOnAMapThatNobodyStoredIsDamage) {
  Project project = make();
  auto file = read_file({write("a.rvm", plant(1)), {}}, {});
  ASSERT_TRUE(file);
  file->map = io::MapPlace{.crs = "EPSG:25832", .to_map = {}};
  {
    auto transaction = Transaction::begin(project.database());
    ASSERT_TRUE(transaction);
    ASSERT_TRUE(store_files(project, std::span(&*file, 1), {}));
    ASSERT_TRUE(transaction->commit());
  }
  ASSERT_TRUE(project.model({}));
  for (const char* const damage :
       {"DELETE FROM map_place", "UPDATE map_place SET crs = 'EPSG:1'",
        "UPDATE map_place SET crs = char(27) || '[2J'", "UPDATE map_place SET to_map = x''",
        "UPDATE map_place SET to_map = zeroblob(128)",
        "UPDATE map_place SET to_map = randomblob(128)",
        "UPDATE map_place SET crs = hex(zeroblob(5000))"}) {
    auto transaction = Transaction::begin(project.database());
    ASSERT_TRUE(transaction);
    ASSERT_TRUE(project.database().execute(damage)) << damage;
    const auto model = project.model({});
    ASSERT_FALSE(model) << damage;
    EXPECT_EQ(model.error().code, ErrorCode::input);
    EXPECT_FALSE(project.files()) << damage;
  }
  EXPECT_TRUE(project.model({})) << "nothing of it was kept";
}

TEST_F(ModelStoreTest, FilesThatAreTakenOutLeaveTheOthersAsTheyAre) {
  const Paths paths{write("x/a.rvm", plant(1)), write_ship("b.glb", {.objects = 400}),
                    write("y/a.rvm", plant(2)), write_ship("c.glb", {.objects = 300, .seed = 2})};
  Project project = make();
  expect_stored(project, paths);
  const auto files = project.files();
  ASSERT_TRUE(files);
  const auto id_of = [&](const fs::path& path) {
    return std::ranges::find(*files, path, &StoredFile::path)->id;
  };
  ASSERT_TRUE(test::take_out(project, std::array{id_of(paths[0]), id_of(paths[3])}));
  expect_model_of({paths[1], paths[2]});
  EXPECT_FALSE(test::take_out(project, std::array{id_of(paths[0])}));
  ASSERT_TRUE(test::take_out(project, std::array{id_of(paths[1]), id_of(paths[2])}));
  EXPECT_EQ(test::number(project, "SELECT count(*) FROM shape_pack"), 0);
  EXPECT_EQ(test::number(project, "SELECT count(*) FROM file_block"), 0);
  const auto model = project.model({});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_TRUE(model->objects.empty());
}

TEST_F(ModelStoreTest, AShapeThatFilesShareIsStoredOnce) {
  const Paths paths{write_ship("a.glb", {.objects = 500}), write_ship("b.glb", {.objects = 500})};
  Project project = make();
  expect_stored(project, {paths[0]});
  const auto once = test::number(project, "SELECT sum(shapes) FROM shape_pack");
  ASSERT_GT(once, 0);
  expect_stored(project, {paths[1]});
  EXPECT_EQ(test::number(project, "SELECT sum(shapes) FROM shape_pack"), once);
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, HashesOfShapesAreThoseOfWhatTheyAreNow) {
  const fs::path path = write_ship("a.obj", {.objects = 300}, true);
  Project project = make();
  expect_stored(project, {path});
  const auto hashes_of = [&] {
    const auto stored = project.signed_model({});
    EXPECT_TRUE(stored);
    std::vector<Hash128> expected;
    for (const model::Shape& shape : stored->model.shapes)
      expected.push_back(is_shared(shape) ? shape_hash(shape) : Hash128());
    EXPECT_EQ(stored->shape_hashes, expected);
    return stored->shape_hashes;
  };
  const std::vector<Hash128> before = hashes_of();
  // One vertex in the middle moves by less than the grid has, and nothing else.
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  in.close();
  const std::size_t line = text.find("\nv ", text.size() / 2);
  const std::size_t point = text.find('.', line);
  ASSERT_NE(point, std::string::npos);
  const std::size_t end = text.find_first_not_of("0123456789", point + 1);
  text.insert(end, end - point > 4 ? "7" : "000007");
  expect_stored(project, {write("a.obj", text)});
  const std::vector<Hash128> now = hashes_of();
  ASSERT_EQ(now.size(), before.size());
  std::size_t changed = 0;
  for (std::size_t s = 0; s < now.size(); ++s) changed += now[s] == before[s] ? 0U : 1U;
  EXPECT_EQ(changed, 1U);
}

TEST_F(ModelStoreTest, WhatNoFileUsesGoes) {
  // All in one pack: half of it goes when the second file does, and can come again.
  const Paths paths{write("a.obj", test::obj_seeds()[2].bytes),
                    write_ship("b.glb", {.objects = 300})};
  Project project = make();
  expect_stored(project, paths);
  const auto all = test::number(project, "SELECT sum(shapes) FROM shape_pack");
  const auto files = project.files();
  ASSERT_TRUE(files);
  ASSERT_TRUE(test::take_out(project, std::array{files->back().id}));
  EXPECT_LT(test::number(project, "SELECT sum(shapes) FROM shape_pack"), all);
  expect_model_of({paths[0]});
  expect_stored(project, {paths[1]});
  EXPECT_EQ(test::number(project, "SELECT sum(shapes) FROM shape_pack"), all);
  expect_model_of(paths);
}

TEST_F(ModelStoreTest, BytesDoNotDependOnTheNumberOfWorkers) {
  const fs::path path = write_ship("a.glb", {.objects = 2000});
  std::set<std::string> known;
  for (const unsigned workers : {1U, 2U, 7U}) {
    const fs::path file = folder_.path() / ("p" + std::to_string(workers) + ".strake");
    auto project = Project::create(file);
    ASSERT_TRUE(project);
    parallel::Team team(workers);
    ASSERT_TRUE(test::store(*project, std::array{path}, {.team = &team}));
    auto rows = project->database().prepare(
        "SELECT data FROM file_block UNION ALL SELECT data FROM shape_pack");
    ASSERT_TRUE(rows);
    Hasher hasher;
    while (rows->step().value()) hasher.add(rows->bytes(0));
    known.insert(hasher.value().text());
  }
  EXPECT_EQ(known.size(), 1U);
}

TEST_F(ModelStoreTest, TheContentOfAFileIsThatOfAllFilesReadWithIt) {
  const fs::path rvm = write("m/plant.rvm", plant(1));
  const fs::path obj = write("m/part.obj", "mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const fs::path gltf =
      write("m/part.gltf",
            R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"my%20.bin"}]})");
  const auto content = [](const fs::path& path) {
    const auto hash = content_hash(path, {});
    EXPECT_TRUE(hash);
    return hash ? *hash : Hash128();
  };
  const std::array before{content(rvm), content(obj), content(gltf)};
  static_cast<void>(write("m/other.att", "of another file"));
  EXPECT_EQ((std::array{content(rvm), content(obj), content(gltf)}), before);
  static_cast<void>(write("m/plant.att", kAttributes));
  static_cast<void>(write("m/b.mtl", "newmtl a\n"));
  static_cast<void>(write("m/my .bin", std::string(36, '\0')));
  const std::array after{content(rvm), content(obj), content(gltf)};
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NE(before[i], after[i]) << i;
  static_cast<void>(write("m/plant.att", std::string(kAttributes) + " "));
  EXPECT_NE(content(rvm), after[0]);
  EXPECT_FALSE(content_hash(folder_.path() / "none.rvm", {}));
}

TEST_F(ModelStoreTest, RealModelsComeBack) {
  const auto data = test::data_folder();
  if (!data) GTEST_SKIP() << "STRAKE_DATA is not set";
  constexpr std::uintmax_t kLargest = std::uintmax_t{64} << 20U;
  std::map<std::string, Paths> by_ending;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(*data)) {
    std::string ending = entry.path().extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool model = ending == ".rvm" || ending == ".glb" || ending == ".obj" || ending == ".stl";
    if (model && entry.is_regular_file() && entry.file_size() < kLargest &&
        by_ending[ending].size() < 6 && io::read_models(std::array{entry.path()}, {}, {}))
      by_ending[ending].push_back(entry.path());
  }
  Paths all;
  for (const auto& [ending, paths] : by_ending) all.insert(all.end(), paths.begin(), paths.end());
  if (all.empty()) GTEST_SKIP() << "no models there";
  Project project = make();
  expect_stored(project, all);
  expect_model_of(all);
}

}  // namespace
}  // namespace strake::project
