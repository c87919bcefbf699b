// SPDX-License-Identifier: Apache-2.0
// What compare() tells of one change at a time, and of what could be taken for another.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "strake/project/update.hpp"

namespace strake::project {
namespace {

using geometry::Vec3d;

model::Shape box(double size) {
  return geometry::Primitive(geometry::BoxPrimitive{size, size, size});
}

/// A triangle with a corner at `at`: a shape that states where it is.
model::Shape triangle(const Vec3d& at) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {at, at + Vec3d{100, 0, 0}, at + Vec3d{0, 100, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

struct Given {
  std::string id;
  model::Shape shape = box(100);
  Vec3d at = {};
  std::string name = "part";
  model::Attributes attributes = {};
  bool positional = false;
  std::string file = "a.rvm";
  std::string group = "HULL";
  model::Color color = {};
};

model::Model model_of(const std::vector<Given>& objects) {
  model::Model model;
  for (const Given& given : objects) {
    std::uint32_t file = 0;
    while (file < model.files.size() && model.files[file].label != given.file) ++file;
    if (file == model.files.size()) {
      model::SourceFile source;
      source.label = given.file;
      model.files.push_back(source);
    }
    model::Object object;
    object.id = given.id;
    object.name = given.name;
    object.file = file;
    object.attributes = given.attributes;
    object.positional_id = given.positional;
    object.parent = model::GroupId{static_cast<std::uint32_t>(model.groups.size())};
    object.first_body = static_cast<std::uint32_t>(model.bodies.size());
    object.body_count = 1;
    model::Group group;
    group.name = given.group;
    model.groups.push_back(group);
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model.shapes.size())};
    body.placement.translation = given.at;
    body.color = given.color;
    model.shapes.push_back(given.shape);
    model.bodies.push_back(body);
    model.objects.push_back(object);
  }
  model::finish(model);
  return model;
}

Changes changes_between(const std::vector<Given>& then, const std::vector<Given>& now) {
  const model::Model before = model_of(then), after = model_of(now);
  Result<report::FileMatches> files = match_files(before, after, {}, {});
  EXPECT_TRUE(files);
  Result<Changes> changes = compare(before, after, std::move(*files), {});
  EXPECT_TRUE(changes);
  return std::move(*changes);
}

/// Returns "id: kind, kind; …", in the order of the list.
std::string reported(const Changes& changes) {
  std::string text;
  for (const ObjectChange& change : changes.objects) {
    text += (text.empty() ? "" : "; ") + change.name().id + ":";
    for (std::size_t k = 0; k < kChangeKinds; ++k)
      if (const auto kind = static_cast<ChangeKind>(k); change.is(kind))
        text += " " + std::string(change_name(kind));
  }
  return text;
}

std::string reported(const std::vector<Given>& then, const std::vector<Given>& now) {
  return reported(changes_between(then, now));
}

TEST(Changes, NothingChangedIsNothingReported) {
  const std::vector<Given> objects{{.id = "x"}, {.id = "y", .shape = triangle({1, 2, 3})}};
  const Changes changes = changes_between(objects, objects);
  EXPECT_EQ(reported(changes), "");
  EXPECT_EQ(changes.unchanged, 2U);
}

TEST(Changes, EachKindIsReportedAsItself) {
  const Given x{.id = "x"}, other{.id = "other", .at = {900, 0, 0}};
  EXPECT_EQ(reported({x}, {x, other}), "other: added");
  EXPECT_EQ(reported({x, other}, {x}), "other: removed");
  EXPECT_EQ(reported({x}, {{.id = "x", .at = {1, 0, 0}}}), "x: moved");
  EXPECT_EQ(reported({x}, {{.id = "x", .shape = box(101)}}), "x: reshaped");
  EXPECT_EQ(reported({x}, {{.id = "x", .shape = box(101), .at = {1, 0, 0}}}), "x: reshaped");
  EXPECT_EQ(reported({x}, {{.id = "x", .name = "bolt"}}), "x: reattributed");
  EXPECT_EQ(reported({x}, {{.id = "x", .attributes = {{"DN", "80"}}}}), "x: reattributed");
  EXPECT_EQ(reported({x}, {{.id = "x", .group = "DECK"}}), "x: reattributed");
  EXPECT_EQ(reported({x}, {{.id = "x", .color = {1, 2, 3, 255}}}), "x: reattributed");
  EXPECT_EQ(reported({x}, {{.id = "z"}}), "z: renamed");
}

TEST(Changes, AnObjectMayHaveSeveralKinds) {
  const Given x{.id = "x"};
  EXPECT_EQ(reported({x}, {{.id = "x", .at = {5, 0, 0}, .attributes = {{"DN", "80"}}}}),
            "x: moved reattributed");
  EXPECT_EQ(reported({x}, {{.id = "z", .attributes = {{"DN", "80"}}}}), "z: reattributed renamed");
}

TEST(Changes, ANameThatComesWithAnotherIdIsOneChange) {
  EXPECT_EQ(reported({{.id = "/HULL/x", .name = "x"}}, {{.id = "/HULL/z", .name = "z"}}),
            "/HULL/z: renamed");
}

TEST(Changes, ARenamedObjectReportsWhatItWasCalled) {
  const Changes changes = changes_between({{.id = "x"}}, {{.id = "z"}});
  ASSERT_EQ(changes.objects.size(), 1U);
  EXPECT_EQ(changes.objects.front().before.id, "x");
  EXPECT_EQ(changes.objects.front().after.id, "z");
}

TEST(Changes, WhatMovedUnderAnotherIdIsAnotherObject) {
  EXPECT_EQ(reported({{.id = "x"}}, {{.id = "z", .at = {50, 0, 0}}}), "x: removed; z: added");
}

TEST(Changes, ACopyAtTheSamePlaceIsAdded) {
  EXPECT_EQ(reported({{.id = "x"}}, {{.id = "a"}, {.id = "x"}}), "a: added");
}

TEST(Changes, AMeshWhoseCornersAreAllDisplacedHasMoved) {
  EXPECT_EQ(reported({{.id = "x", .shape = triangle({0, 0, 0})}},
                     {{.id = "x", .shape = triangle({12.5, 0, 3})}}),
            "x: moved");
  model::Shape bent = triangle({12.5, 0, 3});
  std::get<geometry::TriangleMesh>(bent).vertices[2].z += 0.5;
  EXPECT_EQ(reported({{.id = "x", .shape = triangle({0, 0, 0})}}, {{.id = "x", .shape = bent}}),
            "x: reshaped");
}

TEST(Changes, AChangeBelowTheGridIsNoMove) {
  model::Shape other = triangle({0, 0, 0});
  std::get<geometry::TriangleMesh>(other).vertices[1].x += 1e-7;
  EXPECT_EQ(reported({{.id = "x", .shape = triangle({0, 0, 0})}}, {{.id = "x", .shape = other}}),
            "x: reshaped");
}

TEST(Changes, IdsThatCountFollowWhatTheyAreAndWhere) {
  const auto node = [](int number, double x) {
    return Given{.id = "node" + std::to_string(number), .at = {x, 0, 0}, .positional = true};
  };
  // One is inserted before two others, which are counted on.
  EXPECT_EQ(reported({node(1, 0), node(2, 500)}, {node(1, -500), node(2, 0), node(3, 500)}),
            "node1: added");
  // One has moved and leaves nothing behind: its id is all that tells.
  EXPECT_EQ(reported({node(1, 0), node(2, 500)}, {node(1, 0), node(2, 600)}), "node2: moved");
}

TEST(Changes, ObjectsAreTheSameInAFileOfAnotherName) {
  std::vector<Given> then, now;
  for (int i = 0; i < 6; ++i) {
    then.push_back({.id = "p" + std::to_string(i), .at = {i * 500.0, 0, 0}, .file = "HA.RVM"});
    now.push_back(then.back());
    now.back().file = "HA_revB.RVM";
  }
  now[2].at.x += 10;
  const Changes changes = changes_between(then, now);
  EXPECT_EQ(reported(changes), "p2: moved");
  EXPECT_EQ(changes.unchanged, 5U);
  ASSERT_EQ(changes.files.matches.size(), 1U);
  EXPECT_EQ(changes.files.matches.front().relation, report::FileRelation::renamed);
  EXPECT_EQ(changes.objects.front().before.file, "HA.RVM");
  EXPECT_EQ(changes.objects.front().after.file, "HA_revB.RVM");
}

TEST(Changes, ObjectsOfFilesThatHaveNothingInCommonCameAndWent) {
  const Changes changes = changes_between({{.id = "x", .file = "old.rvm"}},
                                          {{.id = "q", .at = {9, 9, 9}, .file = "new.rvm"}});
  EXPECT_EQ(reported(changes), "q: added; x: removed");
  EXPECT_EQ(changes.files.only_before, std::vector<std::string>{"old.rvm"});
  EXPECT_EQ(changes.files.only_after, std::vector<std::string>{"new.rvm"});
}

TEST(Changes, TheListIsInTheOrderOfTheModel) {
  EXPECT_EQ(
      reported({{.id = "b"}, {.id = "d", .at = {1000, 0, 0}}, {.id = "e", .at = {2000, 0, 0}}},
               {{.id = "a", .at = {3000, 0, 0}},
                {.id = "c", .at = {4000, 0, 0}},
                {.id = "d", .at = {1001, 0, 0}}}),
      "a: added; b: removed; c: added; d: moved; e: removed");
}

TEST(Changes, OutputsHaveEveryChange) {
  const Changes changes = changes_between(
      {{.id = "x"}, {.id = "y", .at = {700, 0, 0}}},
      {{.id = "x", .at = {5, 0, 0}, .name = "=bolt"}, {.id = "z", .at = {700, 0, 0}}});
  std::string json, csv;
  write_changes_json(changes, [&](std::string_view text) { json += text; });
  write_changes_csv(changes, [&](std::string_view text) { csv += text; });
  EXPECT_NE(json.find(R"({"kinds": ["moved", "reattributed"], "id": "x", "name": "=bolt")"),
            std::string::npos)
      << json;
  EXPECT_NE(json.find(R"("was": {"id": "y")"), std::string::npos) << json;
  EXPECT_EQ(csv,
            "change,file,id,name,file_before,id_before,name_before\r\n"
            "moved,a.rvm,x,'=bolt,a.rvm,x,part\r\n"
            "reattributed,a.rvm,x,'=bolt,a.rvm,x,part\r\n"
            "renamed,a.rvm,z,part,a.rvm,y,part\r\n");
  EXPECT_NE(changes_text(changes, {}).find("renamed: 1 object\n  a.rvm: z (part), was y\n"),
            std::string::npos)
      << changes_text(changes, {});
}

}  // namespace
}  // namespace strake::project
