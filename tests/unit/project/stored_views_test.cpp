// SPDX-License-Identifier: Apache-2.0
// Views of a project: what is stored is found again, whole or not at all.
#include "project/views/stored_views.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "project/views/drawing_codec.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/project/project.hpp"
#include "support/clash_model.hpp"

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
    return store_view(database(), view);
  }

  std::filesystem::path folder_;
  std::optional<Project> project_;
  model::Model model_;
  hlr::Drawing drawing_;
  Snapshot made_from_;
  std::vector<geometry::Box3l> boxes_;
  std::vector<model::ObjectId> far_objects_{model::ObjectId{1}};
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
TEST_F(StoredViews, TellWhatTheyShowedByName) {
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
  ASSERT_TRUE(rename_objects_of_views(database(), {{7, 8}, {8, 7}}));
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
  EXPECT_TRUE(rename_objects_of_views(database(), {{7, 9}}));
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

TEST_F(StoredViews, ThatAreNotThereAreTold) {
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
  ASSERT_TRUE(store_view(database(), settings));
  EXPECT_FALSE(find_view(database(), "deck")->last);
  ASSERT_TRUE(store("deck", R"({"view":"front"})"));
  settings.settings = R"({"view":"iso"})";
  ASSERT_TRUE(store_view(database(), settings));
  const auto view = find_view(database(), "deck");
  ASSERT_TRUE(view);
  EXPECT_EQ(view->settings, R"({"view":"iso"})");
  EXPECT_TRUE(view->last) << "signatures tell whether the lines hold, not the settings";
}

TEST_F(StoredViews, DamageIsTold) {
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
  ASSERT_TRUE(store("deck", "{}"));
  const auto stored = load_drawing(database(), "deck", {1, 2}, {});
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().code, ErrorCode::input);
}

}  // namespace
}  // namespace strake::project
