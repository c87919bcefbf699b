// SPDX-License-Identifier: Apache-2.0
#include "strake/model/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/parallel/team.hpp"

namespace strake::model {
namespace {

Model one_file(const std::string& label, const std::vector<std::string>& ids) {
  Model m;
  m.files.push_back({label, "OBJ", "mm", "z", 1, 0});
  m.groups.push_back({"root " + label, GroupId::none});
  m.groups.push_back({"deck", GroupId{0}});
  for (const std::string& id : ids) {
    m.shapes.push_back(geometry::Primitive{geometry::SpherePrimitive{1.0}});
    Object o;
    o.id = id;
    o.name = "name of " + id;
    o.parent = GroupId{1};
    o.first_body = static_cast<std::uint32_t>(m.bodies.size());
    o.body_count = 1;
    Body b;
    b.shape = ShapeId{static_cast<std::uint32_t>(m.shapes.size() - 1)};
    b.color.red = static_cast<std::uint8_t>(m.bodies.size());
    m.bodies.push_back(b);
    m.objects.push_back(o);
  }
  return m;
}

std::vector<std::string> keys(const Model& m) {
  std::vector<std::string> keys;
  for (const Object& o : m.objects) keys.push_back(m.files[o.file].label + ":" + o.id);
  return keys;
}

TEST(Model, FinishOrdersByFileAndIdWhateverTheOrderOfFiles) {
  Model ab = one_file("a.obj", {"z", "m"});
  append(ab, one_file("b.obj", {"k", "a"}));
  Model ba = one_file("b.obj", {"k", "a"});
  append(ba, one_file("a.obj", {"z", "m"}));
  finish(ab);
  finish(ba);
  EXPECT_EQ(keys(ab), (std::vector<std::string>{"a.obj:m", "a.obj:z", "b.obj:a", "b.obj:k"}));
  EXPECT_EQ(keys(ab), keys(ba));
  EXPECT_EQ(ab.path(ab.objects[0]), "root a.obj/deck");
  EXPECT_EQ(ba.path(ba.objects[3]), "root b.obj/deck");
}

TEST(Model, FinishNotesTheOrderOfTheSource) {
  Model m = one_file("a.obj", {"z", "m", "k"});
  finish(m);
  EXPECT_EQ(m.objects[0].id, "k");
  EXPECT_EQ(m.objects[0].place, 2U);
  EXPECT_EQ(m.objects[2].place, 0U);
}

TEST(Model, AppendKeepsTheAttributesOfGroups) {
  Model a = one_file("a.obj", {"x"}), b = one_file("b.obj", {"y"});
  a.set_attributes(GroupId{1}, {{"AREA", "1"}});
  b.set_attributes(GroupId{0}, {{"AREA", "2"}});
  append(a, std::move(b));
  finish(a);
  const auto area = [&](std::size_t o) {
    const Model::Stated stated = a.stated(a.objects[o], "AREA");
    return stated.attributes == nullptr ? std::string() : stated.attributes->front().second;
  };
  EXPECT_EQ(area(0), "1");
  EXPECT_EQ(area(1), "2");
  EXPECT_EQ(a.stated(a.objects[1], "AREA").group, GroupId{2});
  EXPECT_EQ(a.stated(a.objects[1], "TREF").attributes, nullptr);
}

TEST(Model, FinishKeepsBodiesWithTheirObjects) {
  Model m = one_file("a.obj", {"z", "m", "k"});
  finish(m);
  ASSERT_EQ(m.objects[0].id, "k");
  EXPECT_EQ(m.bodies[m.objects[0].first_body].color.red, 2);
  EXPECT_EQ(m.bodies[m.objects[2].first_body].color.red, 0);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(m.objects[i].first_body, i);
}

TEST(Model, FinishIsTheSameForAnyTeam) {
  constexpr std::uint32_t kMany = 100'000;
  Model source;
  source.files.push_back({"b.obj", "OBJ", "mm", "z", 1, 0});
  source.files.push_back({"a.obj", "OBJ", "mm", "z", 1, 0});
  source.bodies.resize(2 * kMany);
  for (std::uint32_t b = 0; b < source.bodies.size(); ++b)
    source.bodies[b].placement.translation.x = b;
  for (std::uint32_t i = 0; i < kMany; ++i) {
    Object o;
    o.id = "/SHIP/" + std::to_string(i * std::uint64_t{7919} % kMany);
    o.name = std::to_string(i);
    // From none to two bodies, those of one object before those of another that comes after it.
    o.first_body = 2 * (kMany - 1 - i);
    o.body_count = i % 3;
    o.file = i % 7 == 0 ? 1 : 0;
    o.positional_id = i % 1000 == 0;
    source.objects.push_back(o);
  }
  Model alone = source;
  finish(alone);
  ASSERT_TRUE(std::ranges::is_sorted(alone.objects, {},
                                     [](const Object& o) { return std::tie(o.file, o.id); }));
  EXPECT_EQ(alone.diagnostics.kept().size(), 2U);
  for (const unsigned workers : {2U, 3U, 8U}) {
    parallel::Team team(workers);
    Model shared = source;
    ASSERT_TRUE(finish(shared, {.team = &team}));
    ASSERT_EQ(shared.bodies.size(), alone.bodies.size());
    ASSERT_EQ(shared.diagnostics.kept().size(), alone.diagnostics.kept().size());
    for (std::size_t d = 0; d < alone.diagnostics.kept().size(); ++d)
      ASSERT_EQ(shared.diagnostics.kept()[d].message, alone.diagnostics.kept()[d].message);
    for (std::size_t i = 0; i < alone.objects.size(); ++i) {
      const Object &x = shared.objects[i], &y = alone.objects[i];
      ASSERT_EQ(std::tie(x.file, x.id, x.name, x.place, x.first_body, x.body_count),
                std::tie(y.file, y.id, y.name, y.place, y.first_body, y.body_count));
      for (std::uint32_t b = x.first_body; b < x.first_body + x.body_count; ++b)
        ASSERT_EQ(shared.bodies[b].placement.translation, alone.bodies[b].placement.translation);
    }
  }
}

TEST(Model, IsEmptyOnceItIsClearedByAnyTeam) {
  for (const unsigned workers : {1U, 2U, 3U, 8U}) {
    parallel::Team team(workers);
    Model m =
        one_file("a.obj", std::vector<std::string>(50'000, "an id that is too long to be short"));
    m.set_attributes(GroupId{1}, {{"AREA", "1"}});
    m.diagnostics.add(Severity::note, "told", "of it", "here");
    clear(m, {.team = &team});
    EXPECT_TRUE(m.files.empty() && m.groups.empty() && m.group_attributes.empty() &&
                m.shapes.empty() && m.objects.empty() && m.bodies.empty());
    EXPECT_TRUE(m.diagnostics.kept().empty());
    append(m, one_file("b.obj", {"x"}));
    EXPECT_EQ(keys(m), std::vector<std::string>{"b.obj:x"});
  }
}

TEST(Model, WhatIsInOrderStaysWhereItIs) {
  Model m = one_file("a.obj", {"a", "b", "c"});
  const Object* const objects = m.objects.data();
  finish(m);
  EXPECT_EQ(m.objects.data(), objects);
  // A body that no object has goes.
  m.bodies.emplace_back();
  finish(m);
  EXPECT_EQ(m.bodies.size(), 3U);
}

TEST(Model, RepeatedIdsGainNumbersThatAreFree) {
  Model m = one_file("a.obj", {"x", "x#2", "x", "x"});
  finish(m);
  EXPECT_EQ(keys(m), (std::vector<std::string>{"a.obj:x", "a.obj:x#2", "a.obj:x#3", "a.obj:x#4"}));
  EXPECT_EQ(m.diagnostics.count("object-id-repeated"), 1U);
  EXPECT_EQ(m.bodies[m.objects[2].first_body].color.red, 2);
}

TEST(Model, IdsThatAreOnlyPositionsAreReportedOncePerFile) {
  Model m = one_file("a.obj", {"x", "y", "x", "node 1", "node 2"});
  m.objects[3].positional_id = m.objects[4].positional_id = true;
  append(m, one_file("b.obj", {"x"}));
  finish(m);
  std::vector<std::string> positions;
  for (const Object& o : m.objects)
    if (o.positional_id) positions.push_back(o.id);
  EXPECT_EQ(positions, (std::vector<std::string>{"node 1", "node 2", "x", "x#2"}));
  EXPECT_EQ(m.diagnostics.count("object-id-positional"), 1U);
  const auto note =
      std::ranges::find(m.diagnostics.kept(), "object-id-positional", &Diagnostic::code);
  ASSERT_NE(note, m.diagnostics.kept().end());
  EXPECT_EQ(note->where, "a.obj");
  EXPECT_TRUE(note->message.starts_with("2 objects ")) << "repeated ones have their own message";
}

TEST(Model, EqualIdsInDifferentFilesStay) {
  Model m = one_file("a.obj", {"x"});
  append(m, one_file("b.obj", {"x"}));
  finish(m);
  EXPECT_EQ(m.diagnostics.count("object-id-repeated"), 0U);
}

TEST(Model, EqualFileLabelsGainNumbers) {
  Model m = one_file("a.obj", {"x"});
  append(m, one_file("a.obj", {"x"}));
  finish(m);
  EXPECT_EQ(keys(m), (std::vector<std::string>{"a.obj:x", "a.obj#2:x"}));
}

/// The labels and what lies in each file, for files given as (folders, label, id of an object).
std::vector<std::string> keys_of_files(
    const std::vector<std::tuple<std::string, std::string, std::string>>& files) {
  Model m;
  for (const auto& [folders, label, id] : files) {
    Model one = one_file(label, {id});
    one.files[0].folders = folders;
    one.files[0].bytes = 1000 - m.files.size();
    append(m, std::move(one));
  }
  finish(m);
  return keys(m);
}

TEST(Model, NamesakesGainTheFoldersThatDistinguishThem) {
  const std::vector<std::string> two{"hull/m.obj:h", "outfit/m.obj:o"};
  EXPECT_EQ(keys_of_files({{"p/hull/", "m.obj", "h"}, {"p/outfit/", "m.obj", "o"}}), two);
  EXPECT_EQ(keys_of_files({{"p/outfit/", "m.obj", "o"}, {"p/hull/", "m.obj", "h"}}), two);
  // Each as few as it takes, whole names of folders, and none for a name of its own.
  EXPECT_EQ(keys_of_files({{"x/hull/", "m.obj", "1"},
                           {"y/hull/", "m.obj", "2"},
                           {"y/xhull/", "m.obj", "3"},
                           {"y/hull/", "n.obj", "4"},
                           {"hull/", "m.obj", "5"}}),
            (std::vector<std::string>{"hull/m.obj:5", "n.obj:4", "x/hull/m.obj:1", "xhull/m.obj:3",
                                      "y/hull/m.obj:2"}));
  EXPECT_EQ(keys_of_files({{"", "m.obj", "1"}, {"a/", "m.obj", "2"}}),
            (std::vector<std::string>{"a/m.obj:2", "m.obj:1"}));
}

TEST(Model, NamesakesOfOneFolderAreNumberedByWhatTheyHold) {
  const std::vector<std::string> two{"m.obj:a", "m.obj#2:b"};
  EXPECT_EQ(keys_of_files({{"p/", "m.obj", "b"}, {"p/", "m.obj", "a"}}), two);
  EXPECT_EQ(keys_of_files({{"p/", "m.obj", "a"}, {"p/", "m.obj", "b"}}), two);
}

TEST(Model, ReportsFilesThatEndEarly) {
  Model m = one_file("whole.rvm", {"1"});
  std::vector<std::string> reported{unread_rest(m)};
  for (const char* const label : {"cut.rvm", "half.rvm", "part.rvm"}) {
    append(m, one_file(label, {"1"}));
    m.files.back().ends_early = true;
    reported.push_back(unread_rest(m));
  }
  finish(m);
  EXPECT_EQ(unread_rest(m), reported.back());
  EXPECT_EQ(reported,
            (std::vector<std::string>{"", "the rest of cut.rvm, which ends early",
                                      "the rest of cut.rvm and 1 more file, which end early",
                                      "the rest of cut.rvm and 2 more files, which end early"}));
}

TEST(Model, PathSurvivesACircleOfGroups) {
  Model m = one_file("a.obj", {"x"});
  m.groups[0].parent = GroupId{1};
  EXPECT_FALSE(m.path(m.objects[0]).empty());
}

}  // namespace
}  // namespace strake::model
