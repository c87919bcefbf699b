// SPDX-License-Identifier: Apache-2.0
// Views of a project: what is stored is found again, whole or not at all.
#include "project/views/stored_views.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "project/views/drawing_codec.hpp"
#include "project/views/number_columns.hpp"
#include "strake/generate/ship.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/project/project.hpp"
#include "support/clash_model.hpp"
#include "support/stored_models.hpp"

namespace strake::project {
namespace {

class StoredViews : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::path(testing::TempDir()) / ("strake_stored_views_" + test);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    auto made = Project::create(folder_ / "p.strake");
    ASSERT_TRUE(made) << made.error().text();
    project_.emplace(std::move(*made));
    test::ClashModel m;
    m.object("pipe").body(geometry::Primitive{geometry::CylinderPrimitive{300, 2000}});
    m.box("box", {200, -500, -500}, {700, 500, 500});
    model_ = std::move(m.model);
    const auto scene = model::make_scene(model_, {}, {});
    ASSERT_TRUE(scene);
    auto drawing = hlr::draw(*scene, {}, {}, {}, {});
    ASSERT_TRUE(drawing);
    drawing_ = std::move(*drawing);
    made_from_ = {{1, 2}, {7, 8}, {{3, 4}, {5, 6}}};
    boxes_ = {{{-1, -2, -3}, {4, 5, 6}}, geometry::empty_box<std::int64_t>()};
  }
  void TearDown() override {
    project_.reset();
    std::filesystem::remove_all(folder_);
  }

  Database& database() { return project_->database(); }
  Status store(std::string_view name, std::string_view settings) {
    ViewToStore view;
    view.name = name;
    view.settings = settings;
    view.drawing = &drawing_;
    view.made_from = &made_from_;
    view.boxes = &boxes_;
    view.model = &model_;
    view.far_objects = far_objects_;
    view.edges_solved = 11;
    view.seconds = 0.25;
    view.stored = stored_ ? &*stored_ : nullptr;
    view.touched = touched_.empty() ? nullptr : &touched_;
    return store_view(database(), view, {});
  }
  /// Takes a ship of three parts in place of the two objects.
  void take_ship() {
    auto ship = generate::generate_ship({.objects = 600}, {});
    ASSERT_TRUE(ship);
    model_ = std::move(ship->model);
    const auto scene = model::make_scene(model_, {}, {});
    ASSERT_TRUE(scene);
    auto drawing = hlr::draw(*scene, {}, {}, {}, {});
    ASSERT_TRUE(drawing);
    drawing_ = std::move(*drawing);
    made_from_ = {{1, 2}, {}, {}};
    boxes_.clear();
    for (std::uint64_t o = 0; o < model_.objects.size(); ++o) {
      made_from_.identities.push_back(o * 7);
      made_from_.signatures.push_back({o, 3 * o});
      const auto at = static_cast<std::int64_t>(o);
      boxes_.push_back({{at, 0, 0}, {at + 5, 5, 5}});
    }
  }
  /// Loads the drawing that is stored, and sees to it that it is this one.
  void expect_stored(std::string_view name) {
    auto stored = load_drawing(database(), name, {1, 2}, {});
    ASSERT_TRUE(stored) << stored.error().text();
    ASSERT_TRUE(*stored);
    EXPECT_EQ((*stored)->made_from, made_from_);
    EXPECT_EQ((*stored)->boxes, boxes_);
    const auto equal = are_equal((*stored)->drawing, drawing_);
    ASSERT_TRUE(equal);
    EXPECT_TRUE(*equal);
    stored_ = std::move(*stored);
  }
  /// Returns the rows of the parts of a view, in order: a part that is written anew is another row.
  std::vector<std::int64_t> rows_of(std::string_view name) {
    auto rows = database().prepare(
        "SELECT p.rowid FROM drawing_part p JOIN view v ON v.id = p.view WHERE v.name = ?1 "
        "ORDER BY part");
    EXPECT_TRUE(rows);
    rows->bind(1, name);
    std::vector<std::int64_t> numbers;
    while (rows->step().value()) numbers.push_back(rows->integer(0));
    return numbers;
  }
  /// Whether two views have the same parts, byte by byte.
  bool have_same_parts(const char* one, const char* other) {
    return test::number(*project_,
                        std::string("SELECT count(*) FROM drawing_part p JOIN view v ON v.id = "
                                    "p.view JOIN drawing_part q ON q.part = p.part AND q.lines = "
                                    "p.lines AND q.made_from = p.made_from JOIN view w ON w.id = "
                                    "q.view WHERE v.name = '") +
                            one + "' AND w.name = '" + other + "'") ==
           static_cast<std::int64_t>(rows_of(one).size());
  }
  /// Makes of the drawing that is stored what versions of the tables before 5 stored of it.
  void store_in_one_row(std::string_view name) {
    BlobWriter lines, state;
    write(lines, drawing_);
    write(state, made_from_);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::int64_t> corners;
      for (const geometry::Box3l& box : boxes_) {
        corners.push_back(box.lo[axis]);
        corners.push_back(box.hi[axis]);
      }
      write_numbers(state, corners);
    }
    const auto of_lines = lines.finish(), of_state = state.finish();
    ASSERT_TRUE(of_lines && of_state);
    auto update = database().prepare(
        "UPDATE drawing SET lines = ?2, made_from = ?3 WHERE view = (SELECT id FROM view WHERE "
        "name = ?1)");
    ASSERT_TRUE(update);
    update->bind(1, name).bind(2, std::span<const std::byte>(*of_lines));
    ASSERT_TRUE(update->bind(3, std::span<const std::byte>(*of_state)).run());
    ASSERT_TRUE(database().execute("DELETE FROM drawing_part"));
  }

  std::filesystem::path folder_;
  std::optional<Project> project_;
  model::Model model_;
  hlr::Drawing drawing_;
  Snapshot made_from_;
  std::vector<geometry::Box3l> boxes_;
  std::vector<model::ObjectId> far_objects_{model::ObjectId{1}};
  std::optional<StoredDrawing> stored_;  ///< what the next store() is told is stored
  std::vector<bool> touched_;            ///< and what it is told may be another; empty: any
};

TEST_F(StoredViews, AreFoundAgain) {
  ASSERT_TRUE(store("deck 4", R"({"view":"top"})"));
  ASSERT_TRUE(store("a'b\"", "{}"));
  const auto views = list_views(database());
  ASSERT_TRUE(views);
  ASSERT_EQ(views->size(), 2U);
  EXPECT_EQ((*views)[0].name, "a'b\"");
  EXPECT_EQ((*views)[1].settings, R"({"view":"top"})");
  const auto one = find_view(database(), "deck 4");
  ASSERT_TRUE(one);
  ASSERT_TRUE(one->last);
  EXPECT_EQ(one->last->edges_solved, 11U);
  EXPECT_EQ(one->last->pieces, drawing_.pieces.size());
  EXPECT_EQ(one->last->objects, 2U);
  EXPECT_EQ(one->created.size(), std::string("2026-01-31T08:00:00Z").size());

  const auto stored = load_drawing(database(), "deck 4", {1, 2}, {});
  ASSERT_TRUE(stored) << stored.error().text();
  ASSERT_TRUE(*stored);
  EXPECT_EQ((*stored)->made_from, made_from_);
  EXPECT_EQ((*stored)->boxes, boxes_);
  const auto equal = are_equal((*stored)->drawing, drawing_);
  ASSERT_TRUE(equal);
  EXPECT_TRUE(*equal);
  const auto damaged = check_views(database(), {});
  ASSERT_TRUE(damaged);
  EXPECT_TRUE(damaged->empty());
}

/// By the names of then, whatever the model and the view are now.
TEST_F(StoredViews, ReportWhatTheyShowedByName) {
  ASSERT_TRUE(store("deck", R"({"view":"top"})"));
  const auto former = former_drawing(database(), "deck", {});
  ASSERT_TRUE(former) << former.error().text();
  const auto equal = are_equal(former->drawing, drawing_);
  ASSERT_TRUE(equal);
  EXPECT_TRUE(*equal);
  EXPECT_EQ(former->far_objects, far_objects_);
  ASSERT_EQ(former->model.objects.size(), model_.objects.size());
  for (std::size_t o = 0; o < model_.objects.size(); ++o) {
    EXPECT_EQ(former->model.objects[o].id, model_.objects[o].id);
    EXPECT_EQ(former->model.objects[o].name, model_.objects[o].name);
  }
  ASSERT_TRUE(database().execute("UPDATE drawing_objects SET names = x'00'"));
  EXPECT_FALSE(former_drawing(database(), "deck", {}));
  const auto damaged = check_views(database(), {});
  ASSERT_TRUE(damaged);
  EXPECT_EQ(damaged->size(), 1U);
  ASSERT_TRUE(database().execute("DELETE FROM drawing_objects"));
  EXPECT_FALSE(former_drawing(database(), "deck", {})) << "of an earlier version";
  EXPECT_FALSE(former_drawing(database(), "hull", {}));
}

TEST_F(StoredViews, TheirObjectsFollowFilesThatExchangeTheirNames) {
  ASSERT_TRUE(store("deck", "{}"));
  ASSERT_TRUE(store("hull", "{}"));
  ASSERT_TRUE(rename_objects_of_drawings(database(), {{7, 8}, {8, 7}}));
  for (const std::string_view name : {"deck", "hull"}) {
    const auto stored = load_drawing(database(), name, {1, 2}, {});
    ASSERT_TRUE(stored && *stored);
    EXPECT_EQ((*stored)->made_from.identities, (std::vector<std::uint64_t>{8, 7}));
    EXPECT_EQ((*stored)->made_from.signatures, made_from_.signatures);
    EXPECT_EQ((*stored)->boxes, boxes_);
  }
}

TEST_F(StoredViews, ADamagedDrawingDoesNotKeepFilesFromTheirNames) {
  ASSERT_TRUE(store("deck", "{}"));
  ASSERT_TRUE(database().execute("UPDATE drawing SET made_from = x'00'"));
  EXPECT_TRUE(rename_objects_of_drawings(database(), {{7, 9}}));
}

TEST_F(StoredViews, LinesOfAnotherSignatureAreNone) {
  ASSERT_TRUE(store("deck", "{}"));
  for (const Hash128 whole : {Hash128{1, 3}, Hash128{2, 2}}) {
    const auto stored = load_drawing(database(), "deck", whole, {});
    ASSERT_TRUE(stored);
    EXPECT_FALSE(*stored);
  }
  ASSERT_TRUE(database().execute("UPDATE drawing SET program = 'another'"));
  const auto stored = load_drawing(database(), "deck", {1, 2}, {});
  ASSERT_TRUE(stored);
  EXPECT_FALSE(*stored) << "another version of the program may solve otherwise";
}

TEST_F(StoredViews, ThatAreNotThereAreReported) {
  const auto none = find_view(database(), "deck");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  ASSERT_TRUE(store("hull", "{}"));
  const auto other = find_view(database(), "deck");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().text().find("'hull'"), std::string::npos);
  const auto lines = load_drawing(database(), "deck", {1, 2}, {});
  ASSERT_TRUE(lines);
  EXPECT_FALSE(*lines);
}

TEST_F(StoredViews, SettingsAndLinesAreStoredApart) {
  ViewToStore settings;
  settings.name = "deck";
  settings.settings = "{}";
  ASSERT_TRUE(store_view(database(), settings, {}));
  EXPECT_FALSE(find_view(database(), "deck")->last);
  ASSERT_TRUE(store("deck", R"({"view":"front"})"));
  settings.settings = R"({"view":"iso"})";
  ASSERT_TRUE(store_view(database(), settings, {}));
  const auto view = find_view(database(), "deck");
  ASSERT_TRUE(view);
  EXPECT_EQ(view->settings, R"({"view":"iso"})");
  EXPECT_TRUE(view->last) << "signatures tell whether the lines hold, not the settings";
}

TEST_F(StoredViews, DamageIsReported) {
  for (const char* const damage :
       {"UPDATE drawing SET lines = x'00'", "UPDATE drawing SET made_from = x''",
        "UPDATE drawing SET lines = made_from", "UPDATE drawing SET made_from = lines"}) {
    for (const char* const name : {"deck", "hull", "pumps"}) ASSERT_TRUE(store(name, "{}"));
    ASSERT_TRUE(database().execute(std::string(damage) +
                                   " WHERE view IN (SELECT id FROM view WHERE name <> 'hull')"));
    const auto stored = load_drawing(database(), "deck", {1, 2}, {});
    ASSERT_FALSE(stored) << damage;
    EXPECT_EQ(stored.error().code, ErrorCode::input);
    const auto damaged = check_views(database(), {});
    ASSERT_TRUE(damaged) << damage;
    ASSERT_EQ(damaged->size(), 2U) << damage;
    for (const DamagedView& view : *damaged)
      EXPECT_NE(view.error.text().find(view.view), std::string::npos) << view.error.text();
    EXPECT_EQ((*damaged)[0].view, "deck");
    EXPECT_EQ((*damaged)[1].view, "pumps");
  }
}

TEST_F(StoredViews, StatesOfOtherObjectsAreRefused) {
  made_from_ = {{1, 2}, {7, 8, 9}, {{3, 4}, {5, 6}, {7, 8}}};
  boxes_.push_back({{0, 0, 0}, {1, 1, 1}});
  const Status refused = store("deck", "{}");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::internal);
  EXPECT_FALSE(load_drawing(database(), "deck", {1, 2}, {}).value());
}

/// Whatever is told of what may have changed: what is stored is the drawing, in the parts that
/// storing all of it would have made, and only those parts are written that differ.
TEST_F(StoredViews, APartIsWrittenWhereItDiffers) {
  take_ship();
  ASSERT_TRUE(store("deck", "{}"));
  expect_stored("deck");
  const std::vector<std::int64_t> before = rows_of("deck");
  ASSERT_EQ(before.size(), 3U);
  // One object has other lines and another signature; another has no other lines after all.
  const auto piece = std::ranges::find_if(drawing_.pieces, [](const hlr::EdgePiece& p) {
    return model::index(p.object) >= 256 && model::index(p.object) < 512;
  });
  ASSERT_NE(piece, drawing_.pieces.end());
  piece->b.z += 1;
  ++made_from_.signatures[model::index(piece->object)].low;
  touched_.assign(600, false);
  touched_[model::index(piece->object)] = touched_[3] = true;
  ASSERT_TRUE(store("deck", "{}"));
  std::vector<std::int64_t> after = rows_of("deck");
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[0], before[0]);
  EXPECT_NE(after[1], before[1]);
  EXPECT_EQ(after[2], before[2]);
  expect_stored("deck");
  // Without a word about it the parts are compared.
  drawing_.pieces.back().a.x += 1;
  touched_.clear();
  ASSERT_TRUE(store("deck", "{}"));
  EXPECT_EQ(rows_of("deck")[1], after[1]);
  EXPECT_NE(rows_of("deck")[2], after[2]);
  expect_stored("deck");
  // And a signature alone counts, too.
  touched_.assign(600, false);
  ++made_from_.signatures[0].high;
  ++boxes_[599].hi.x;
  after = rows_of("deck");
  ASSERT_TRUE(store("deck", "{}"));
  EXPECT_NE(rows_of("deck")[0], after[0]);
  EXPECT_EQ(rows_of("deck")[1], after[1]);
  EXPECT_NE(rows_of("deck")[2], after[2]);
  expect_stored("deck");
  stored_.reset();
  touched_.clear();
  ASSERT_TRUE(store("all of it", "{}"));
  EXPECT_TRUE(have_same_parts("deck", "all of it"));
}

TEST_F(StoredViews, ObjectsThatComeAndGoBringAndTakeParts) {
  take_ship();
  const hlr::Drawing ship = drawing_;
  const Snapshot made_from = made_from_;
  const std::vector<geometry::Box3l> boxes = boxes_;
  const model::Model model = model_;
  for (const std::size_t objects : {600U, 256U, 257U, 600U, 1U, 512U}) {
    drawing_ = ship;
    drawing_.account.fates.resize(objects);
    drawing_.counted.resize(objects);
    std::erase_if(drawing_.pieces, [&](const hlr::EdgePiece& piece) {
      return model::index(piece.object) >= objects || model::index(piece.other) >= objects;
    });
    std::erase_if(drawing_.curves.edges, [&](const hlr::CurvedEdge& edge) {
      return model::index(edge.object) >= objects;
    });
    std::uint32_t curves = 0;
    for (const hlr::CurvedEdge& edge : drawing_.curves.edges)
      curves = std::max(curves, edge.curve + 1);
    drawing_.curves.all.resize(curves);
    drawing_.account.defects.clear();
    made_from_ = made_from;
    made_from_.identities.resize(objects);
    made_from_.signatures.resize(objects);
    boxes_ = boxes;
    boxes_.resize(objects);
    model_ = model;
    model_.objects.resize(objects);
    far_objects_.clear();
    ASSERT_TRUE(store("deck", "{}"));
    EXPECT_EQ(rows_of("deck").size(), (objects + 255) / 256);
    expect_stored("deck");
    EXPECT_TRUE(check_views(database(), {}).value().empty());
    EXPECT_EQ(former_drawing(database(), "deck", {}).value().model.objects.size(), objects);
  }
}

TEST_F(StoredViews, WhatAnotherProcessStoredIsNotMixedWithTheirs) {
  take_ship();
  ASSERT_TRUE(store("deck", "{}"));
  expect_stored("deck");
  // Meanwhile somebody stores another drawing of the same objects.
  std::optional<StoredDrawing> then = std::move(stored_);
  stored_.reset();
  const hlr::Drawing drawing = drawing_;
  for (hlr::EdgePiece& piece : drawing_.pieces) ++piece.a.z;
  made_from_.signatures[599].low = 77;
  ASSERT_TRUE(store("deck", "{}"));
  drawing_ = drawing;
  made_from_ = then->made_from;
  made_from_.signatures[1].low = 99;
  touched_.assign(600, false);
  touched_[1] = true;
  stored_ = std::move(then);
  ASSERT_TRUE(store("deck", "{}"));
  expect_stored("deck");
}

TEST_F(StoredViews, DrawingsOfOneRowAreReadRenamedAndStoredInParts) {
  take_ship();
  ASSERT_TRUE(store("deck", "{}"));
  store_in_one_row("deck");
  expect_stored("deck");
  EXPECT_TRUE(check_views(database(), {}).value().empty());
  EXPECT_TRUE(former_drawing(database(), "deck", {}));
  ASSERT_TRUE(rename_objects_of_drawings(database(), {{7, 8}}));
  EXPECT_TRUE(rows_of("deck").empty());
  made_from_.identities[1] = 8;
  expect_stored("deck");
  touched_.assign(600, false);
  ASSERT_TRUE(store("deck", "{}"));
  EXPECT_EQ(rows_of("deck").size(), 3U);
  expect_stored("deck");
}

TEST_F(StoredViews, RenamedObjectsWriteTheirPartsAlone) {
  take_ship();
  ASSERT_TRUE(store("deck", "{}"));
  ASSERT_TRUE(rename_objects_of_drawings(database(), {{7 * 300, 8}}));
  made_from_.identities[300] = 8;
  expect_stored("deck");
  ASSERT_TRUE(store("all of it", "{}"));
  EXPECT_TRUE(have_same_parts("deck", "all of it"));
}

TEST_F(StoredViews, DamagedPartsAreReported) {
  take_ship();
  for (
      const char* const damage :
      {"DELETE FROM drawing_part WHERE part = 1", "DELETE FROM drawing_part WHERE part = 2",
       "DELETE FROM drawing_part", "UPDATE drawing_part SET part = 3 WHERE part = 2",
       "UPDATE drawing_part SET lines = x'' WHERE part = 0",
       "UPDATE drawing_part SET made_from = lines",
       "UPDATE drawing_part SET made_from = (SELECT made_from FROM drawing_part WHERE part = 1)",
       "UPDATE drawing_part SET lines = (SELECT lines FROM drawing_part WHERE part = 1)",
       "INSERT INTO drawing_part SELECT view, 3, lines, made_from FROM drawing_part WHERE part = 0",
       "UPDATE drawing_part SET lines = CAST(substr(lines, 1, length(lines) - 1) || x'00' AS BLOB)",
       "UPDATE drawing SET lines = made_from", "UPDATE drawing SET made_from = lines"}) {
    ASSERT_TRUE(store("deck", "{}")) << damage;
    expect_stored("deck");
    ASSERT_TRUE(database().execute(damage)) << damage;
    const auto stored = load_drawing(database(), "deck", {1, 2}, {});
    ASSERT_FALSE(stored) << damage;
    EXPECT_EQ(stored.error().code, ErrorCode::input) << stored.error().text();
    const auto damaged = check_views(database(), {});
    ASSERT_TRUE(damaged) << damage;
    ASSERT_EQ(damaged->size(), 1U) << damage;
    EXPECT_NE((*damaged)[0].error.text().find("deck"), std::string::npos)
        << (*damaged)[0].error.text();
    EXPECT_TRUE(rename_objects_of_drawings(database(), {{7, 9}})) << damage;
    stored_.reset();
  }
}

}  // namespace
}  // namespace strake::project
