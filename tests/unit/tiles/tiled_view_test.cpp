// SPDX-License-Identifier: Apache-2.0
// A drawing by tiles is the drawing of the whole model, to the last bit; what is lost is reported.
#include "tiles/tiled_view.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "strake/generate/ship.hpp"
#include "strake/io/writer.hpp"
#include "support/changing_model.hpp"
#include "support/drawing_cases.hpp"
#include "support/io_files.hpp"
#include "tiles/kept/blob_file.hpp"

namespace strake::tiles {
namespace {

constexpr std::int64_t kMm = 1000;

/// Files of a model, drawn whole and by tiles.
class TiledDrawing {
 public:
  /// The later a model, the earlier the label of its file.
  explicit TiledDrawing(const std::vector<model::Model>& models) {
    for (std::size_t i = 0; i < models.size(); ++i) {
      const auto file = folder_.path() / ("part" + std::to_string(9 - i) + ".glb");
      EXPECT_TRUE(io::write_glb(models[i], file, {.keep_all = true}, {}));
      files_.push_back({file, {}});
    }
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

  [[nodiscard]] hlr::Drawing whole(const hlr::View& view, const hlr::Options& options) const {
    const model::Model model = io::read_models(files_, {}).value();
    const model::Scene scene = make_scene(model, {}, {}).value();
    return hlr::draw(scene, drawn_of(model), view, options, {}).value();
  }

  /// Cuts the files and writes all tiles.
  void cut(CutView& cut, std::uint64_t max_bytes) const {
    FileReader reader(files_, io::import_settings_of_environment());
    cut.outline = outline_of(reader, cut.scene, kept_for(cut.view).value(),
                             [](const model::Scene&, std::size_t) { return Status{}; }, {})
                      .value();
    cut.drawn = drawn_of(cut.outline.model);
    EXPECT_TRUE(cut_view(cut, max_bytes, {}));
    EXPECT_TRUE(write_view_tiles(cut, reader, folder(), tiles_of(cut), {}));
  }

  [[nodiscard]] std::vector<std::filesystem::path> solved(const CutView& cut) const {
    std::vector<std::filesystem::path> files;
    for (const std::size_t tile : tiles_of(cut))
      files.push_back(folder() / ("solved" + std::to_string(tile)));
    return files;
  }

  [[nodiscard]] hlr::Drawing by_tiles(const CutView& cut) const {
    const auto files = solved(cut);
    for (std::size_t tile = 0; tile < files.size(); ++tile)
      EXPECT_TRUE(solve_tile(tile_file(folder(), tile), files[tile], {}));
    return join_solved(cut, files, {}).value();
  }

 private:
  static std::vector<std::size_t> tiles_of(const CutView& cut) {
    std::vector<std::size_t> tiles(cut.parts.size());
    std::iota(tiles.begin(), tiles.end(), std::size_t{0});
    return tiles;
  }

  /// Some objects are neither drawn nor hide anything.
  static std::vector<bool> drawn_of(const model::Model& model) {
    std::vector<bool> drawn(model.objects.size());
    for (std::size_t o = 0; o < drawn.size(); ++o) drawn[o] = o % 17 != 5;
    return drawn;
  }

  test::TemporaryFolder folder_;
  std::vector<io::FileToRead> files_;
};

/// Two corridors of primitives, meshes and lines, one of them beside the other.
std::vector<model::Model> corridors() {
  std::vector<model::Model> models;
  for (const std::uint64_t seed : {3U, 8U}) {
    model::Model model = test::ChangingModel(seed, 90).build();
    for (model::Body& body : model.bodies)
      body.placement.translation.y += 5.0 * (seed == 3 ? 0 : 1);
    model::finish(model);
    models.push_back(std::move(model));
  }
  return models;
}

std::vector<hlr::View> views() {
  const geometry::Vec3l target{80 * kMm, 4 * kMm, 4 * kMm}, eye{50 * kMm, -20 * kMm, 9 * kMm};
  return {{.direction = {1, -2, 1}},
          {.direction = {0, 0, 1},
           .limits = geometry::Box3l{{20 * kMm, -kMm, kMm}, {90 * kMm, 9 * kMm, 7 * kMm}}},
          {.direction = {1, -1, 1},
           .sections = {{{0, 1, 0}, {0, 4 * kMm + 1, 0}}, {{1, -2, 9}, {60 * kMm, 0, 5 * kMm}}}},
          {.direction = eye - target,
           .perspective = hlr::Perspective{.eye = eye, .target = target, .near_mm = 1}}};
}

TEST(TiledView, DrawsWhatIsDrawnOfTheWholeModel) {
  const TiledDrawing files(corridors());
  std::size_t tiles = 0;
  for (const hlr::View& view : views()) {
    for (const double sag_mm : {0.0, 0.02}) {
      const hlr::Options options{.sag_mm = sag_mm, .hidden = sag_mm == 0};
      const hlr::Drawing whole = files.whole(view, options);
      ASSERT_GT(whole.pieces.size(), 300U);
      for (const std::uint64_t most : {std::uint64_t{1} << 40U, std::uint64_t{200'000}}) {
        CutView cut;
        cut.view = view;
        cut.options = options;
        files.cut(cut, most);
        ASSERT_TRUE(cut.parts.size() == 1 || most < 1'000'000'000);
        tiles += cut.parts.size();
        EXPECT_EQ(test::difference(whole, files.by_tiles(cut)), "") << cut.parts.size();
      }
    }
  }
  EXPECT_GT(tiles, 60U);
}

TEST(TiledView, DrawsShipsOfSharedMeshes) {
  std::vector<model::Model> ships;
  for (const std::uint64_t seed : {1U, 2U})
    ships.push_back(generate::generate_ship({.objects = 500, .seed = seed}, {}).value().model);
  const TiledDrawing files(ships);
  CutView cut;
  cut.view.direction = {1, -1, 1};
  const hlr::Drawing whole = files.whole(cut.view, cut.options);
  files.cut(cut, 900'000);
  ASSERT_GT(cut.parts.size(), 5U);
  EXPECT_EQ(test::difference(whole, files.by_tiles(cut)), "");
}

TEST(TiledView, ReportsTheObjectThatTheEyeLiesIn) {
  model::Model model;
  model.files.push_back({.label = "boxes", .format = "hand", .unit = "mm", .up_axis = "z"});
  for (int i = 0; i < 60; ++i) {
    const double x = 100.0 * i;
    model::Object& object = model.objects.emplace_back();
    object.id = "box" + std::to_string(i);
    object.name = "Box " + std::to_string(i);
    object.first_body = static_cast<std::uint32_t>(i);
    object.body_count = 1;
    model.bodies.emplace_back().shape = model::ShapeId{static_cast<std::uint32_t>(i)};
    model.shapes.emplace_back(test::box_mesh({x, 0, 0}, {x + 90, 90, 90}));
  }
  model::finish(model);
  const TiledDrawing files({model});
  CutView cut;
  const geometry::Vec3l eye{1050 * kMm, 50 * kMm, 50 * kMm}, target{0, 50 * kMm, 50 * kMm};
  cut.view = {.direction = {1, 0, 0},
              .perspective = hlr::Perspective{.eye = eye, .target = target, .near_mm = 1}};
  const hlr::Drawing whole = files.whole(cut.view, cut.options);
  ASSERT_EQ(whole.diagnostics.count("eye-in-solid"), 1U);
  files.cut(cut, 100'000);
  ASSERT_GT(cut.parts.size(), 2U);
  EXPECT_EQ(test::difference(whole, files.by_tiles(cut)), "");
}

TEST(TiledView, ReportsTilesAndResultsThatAreLost) {
  const TiledDrawing files(corridors());
  CutView cut;
  cut.view.direction = {1, -2, 1};
  files.cut(cut, 200'000);
  const auto solved = files.solved(cut);
  ASSERT_GT(solved.size(), 2U);
  const hlr::Drawing drawing = files.by_tiles(cut);
  std::filesystem::copy_file(solved[1], solved[0],
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(join_solved(cut, solved, {}).error().message, kLost);
  const auto tile = tile_file(files.folder(), 0);
  for (const auto& entry : std::filesystem::directory_iterator(files.folder())) {
    const auto path = entry.path();
    if (path.stem() != tile.stem()) continue;
    const auto size = std::filesystem::file_size(path);
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
        .seekp(static_cast<std::streamoff>(size / 2))
        .put('\x5a')
        .put('\xa5');
    EXPECT_EQ(solve_tile(tile, solved[0], {}).error().message, kLost) << path;
    std::filesystem::remove(path);
    EXPECT_EQ(solve_tile(tile, solved[0], {}).error().message, kLost) << path;
    files.cut(cut, 200'000);
  }
  EXPECT_TRUE(solve_tile(tile, solved[0], {}));
  std::filesystem::resize_file(solved[1], std::filesystem::file_size(solved[1]) - 3);
  EXPECT_EQ(join_solved(cut, solved, {}).error().message, kLost);
  EXPECT_TRUE(solve_tile(tile_file(files.folder(), 1), solved[1], {}));
  EXPECT_EQ(test::difference(drawing, join_solved(cut, solved, {}).value()), "");
}

TEST(TiledView, RefusesWhatNeedsTheWhole) {
  hlr::Options options;
  EXPECT_TRUE(check_tiled_view(options));
  options.flush_seams = false;
  EXPECT_EQ(check_tiled_view(options).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace strake::tiles
