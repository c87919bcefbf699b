// SPDX-License-Identifier: Apache-2.0
#include "strake/model/selection.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "strake/parallel/team.hpp"
#include "support/meshes.hpp"

namespace strake::model {
namespace {

/// Five objects: two pipes and a valve of one branch, a wall without attributes, a centre line.
class SelectionTest : public ::testing::Test {
 protected:
  SelectionTest() {
    model_.files = {{"piping.rvm", "RVM 2", "mm", "z", 1, 0}, {"hull.obj", "OBJ", "mm", "z", 1, 0}};
    model_.groups = {{"SITE", GroupId::none}, {"BRANCH-1", GroupId{0}}};
    add("p1", "PIPE 1", 0, GroupId{1}, geometry::CylinderPrimitive{50, 1000}, 0,
        {{"DN", "100"}, {"Wall", "4.5 mm"}, {"Spec", "S-10"}, {"Part", "007"}});
    add("p2", "PIPE 2", 0, GroupId{1}, geometry::CylinderPrimitive{100, 1000}, 2000,
        {{"DN", "200mm"}, {"Spec", "S-25"}, {"Spec", "old"}});
    add("v1", "VALVE", 0, GroupId{1}, geometry::BoxPrimitive{300, 300, 300}, 4000,
        {{"DN", "8 in"}});
    model_.bodies.back().category = Category::insulation;
    add("w1", "WALL", 1, GroupId::none, test::box_mesh({0, 0, 0}, {100, 9000, 3000}), 6000, {});
    model_.bodies.back().color = {255, 0, 16, 255};
    add("c1", "axis", 1, GroupId::none, geometry::Polylines{}, 0, {});
    model_.objects.back().body_count = 0;
    model_.bodies.pop_back();
    scene_ = make_scene(model_, {.insulation = true}, {}).value();
  }

  void add(const char* id, const char* name, std::uint32_t file, GroupId parent, Shape shape,
           double x, Attributes attributes) {
    Object o;
    o.id = id;
    o.name = name;
    o.file = file;
    o.parent = parent;
    o.first_body = static_cast<std::uint32_t>(model_.bodies.size());
    o.body_count = 1;
    o.attributes = std::move(attributes);
    model_.objects.push_back(std::move(o));
    Body b;
    b.shape = ShapeId{static_cast<std::uint32_t>(model_.shapes.size())};
    b.placement.translation = {x, 0, 0};
    model_.shapes.push_back(std::move(shape));
    model_.bodies.push_back(b);
  }

  /// The ids picked, joined by blanks.
  std::string picked(const std::string& text, const parallel::Context& context = {}) const {
    const auto selection = Selection::parse(text);
    if (!selection) return selection.error().text();
    std::string out;
    const auto bits = pick(*selection, scene_, context).value();
    for (std::size_t i = 0; i < bits.size(); ++i)
      if (bits[i]) out += (out.empty() ? "" : " ") + model_.objects[i].id;
    return out;
  }

  Model model_;
  Scene scene_;
};

TEST_F(SelectionTest, ABarePatternLooksAtNameIdAndPath) {
  EXPECT_EQ(picked("PIPE*"), "p1 p2");
  EXPECT_EQ(picked("w1"), "w1");
  EXPECT_EQ(picked("SITE/*"), "p1 p2 v1");
  EXPECT_EQ(picked("'PIPE 1'"), "p1");
  EXPECT_EQ(picked("nothing"), "");
  EXPECT_EQ(picked("name"), "") << "a property without an operator is a pattern like any other";
  EXPECT_EQ(picked("*[!1-9]"), "v1 w1 c1");
}

TEST_F(SelectionTest, PropertiesAreComparedAsTextAndByExpression) {
  EXPECT_EQ(picked("name = VALVE"), "v1");
  EXPECT_EQ(picked("name != PIPE*"), "v1 w1 c1");
  EXPECT_EQ(picked("name ~ '^PIPE [12]$'"), "p1 p2");
  EXPECT_EQ(picked("name ~ IPE"), "p1 p2") << "an expression is searched for, not matched whole";
  EXPECT_EQ(picked("name !~ '(?i)pipe|valve'"), "w1 c1");
  EXPECT_EQ(picked("path = SITE/BRANCH-1/VALVE"), "v1");
  EXPECT_EQ(picked("file = hull.*"), "w1 c1");
  EXPECT_EQ(picked("type = cylinder"), "p1 p2");
  EXPECT_EQ(picked("type=mesh or type=box"), "v1 w1");
  EXPECT_EQ(picked("category = insulation"), "v1");
  EXPECT_EQ(picked("color = #ff0010"), "w1");
  EXPECT_EQ(picked("color = '#ff*'"), "w1");
}

TEST_F(SelectionTest, AttributesAreComparedWithUnits) {
  EXPECT_EQ(picked("@DN"), "p1 p2 v1");
  EXPECT_EQ(picked("not @DN"), "w1 c1");
  EXPECT_EQ(picked("@DN >= 200mm"), "p2 v1");
  EXPECT_EQ(picked("@DN > 20cm"), "v1") << "8 in are 203.2 mm";
  EXPECT_EQ(picked("@DN <= 100"), "p1");
  EXPECT_EQ(picked("@DN = 0.2m"), "p2");
  // 203.2 mm, and a product of doubles that is not.
  EXPECT_EQ(picked("@DN = 203.2mm"), "v1");
  EXPECT_EQ(picked("@DN = 100"), "p1");
  EXPECT_EQ(picked("@Part = 7"), "") << "part numbers are text";
  EXPECT_EQ(picked("@Part < 8"), "p1");
  EXPECT_EQ(picked("@Wall < 5"), "p1");
  EXPECT_EQ(picked("@Wall < 5bar"), "") << "millimetres and bar cannot be compared";
  EXPECT_EQ(picked("@Spec = S-*"), "p1 p2");
  EXPECT_EQ(picked("@Spec = old"), "p2") << "every value of a repeated attribute counts";
  EXPECT_EQ(picked("@Spec != S-10"), "p2 v1 w1 c1") << "what has no Spec has not that Spec";
  EXPECT_EQ(picked("@\"no such\" = *"), "");
}

TEST_F(SelectionTest, LengthsAreComparedAndNotTheirRoundings) {
  for (int inches = 1; inches <= 48; ++inches) {
    const std::string in = std::to_string(inches) + "in";
    const int tenths = 254 * inches;
    const std::string mm = std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + "mm";
    for (const auto& [value, requested] : {std::pair(in, mm), std::pair(mm, in)}) {
      model_.objects[0].attributes = {{"L", value}};
      EXPECT_EQ(picked("@L = " + requested), "p1") << value;
      EXPECT_EQ(picked("@L >= " + requested + " and @L <= " + requested), "p1") << value;
      EXPECT_EQ(picked("@L < " + requested + " or @L > " + requested), "") << value;
    }
  }
}

TEST_F(SelectionTest, EqualIsWhatNeitherLessNorMoreIs) {
  struct Case {
    const char* value;
    const char* requested;
    bool equal;
  };
  for (const Case& c : std::vector<Case>{{"150mm", "150", true},
                                         {"150 MM", "150", true},
                                         {"15cm", "150", true},
                                         {"150mm", "150.0", true},
                                         {"150", "150mm", true},
                                         {"150", "15cm", true},
                                         {"150.00", "150", true},
                                         {"150", "150.0", true},
                                         {" 150 ", "150", true},
                                         {"-5", "-5.0", true},
                                         {"151mm", "150", false},
                                         {"16bar", "16", false},
                                         {"150 x 20", "150", false}}) {
    model_.objects[0].attributes = {{"L", c.value}};
    const std::string at(c.requested);
    EXPECT_EQ(picked("@L = " + at), c.equal ? "p1" : "") << c.value << " = " << at;
    EXPECT_EQ(picked("@L >= " + at + " and @L <= " + at), c.equal ? "p1" : "") << c.value;
    EXPECT_EQ(picked("@L != " + at + " and @L"), c.equal ? "" : "p1") << c.value << " != " << at;
  }
  for (const auto& [value, requested] :
       {std::pair("007", "7"), std::pair("7", "007"), std::pair("1e2", "100"),
        std::pair("100", "1e2"), std::pair("1234567890123456789", "1234567890123456788")}) {
    model_.objects[0].attributes = {{"L", value}};
    EXPECT_EQ(picked(std::string("@L = ") + requested), "") << value << " is a name, not a number";
  }
}

TEST_F(SelectionTest, OneSlashStandsBetweenLevelsOfAPath) {
  model_.groups = {{"/SITE", GroupId::none}, {"/PIPING", GroupId{0}}};
  model_.objects[0].name = "/P1";
  for (const char* path :
       {"/SITE/PIPING/P1", "/SITE/PIPING/*", "/SITE//PIPING//P1", "/SITE//PIPING/*"}) {
    EXPECT_NE(picked("path = '" + std::string(path) + "'").find("p1"), std::string::npos) << path;
    EXPECT_NE(picked("'" + std::string(path) + "'").find("p1"), std::string::npos) << path;
    EXPECT_EQ(picked("path != '" + std::string(path) + "'").find("p1"), std::string::npos) << path;
  }
  EXPECT_EQ(picked("path ~ '^/SITE/PIPING/P1$'"), "p1");
  EXPECT_EQ(picked("path = 'SITE/PIPING/*'"), "") << "the first slash belongs to the name";
  EXPECT_EQ(model_.path(model_.objects[0]), "/SITE/PIPING");
}

TEST_F(SelectionTest, ValuesAreReadAsDesignersWriteThem) {
  for (const char* value : {"150 MM", "150Mm", "150mm x 20mm", "150 mm (nominal)", "0.15 M"}) {
    model_.objects[0].attributes = {{"L", value}};
    EXPECT_EQ(picked("@L >= 150mm and @L < 15.1cm"), "p1") << value;
  }
  model_.objects[0].attributes = {{"L", "150 x 20"}};
  EXPECT_EQ(picked("@L >= 150mm"), "") << "no length";
}

TEST_F(SelectionTest, WhatPicksNothingNamesTheAttributesThereAre) {
  const auto stated = [&](const char* text) {
    return picks_nothing(Selection::parse(text).value(), model_);
  };
  EXPECT_EQ(
      stated("name = ghost and @Diameter > 5mm"),
      "'name = ghost and @Diameter > 5mm' picks no object: no object has an attribute @Diameter; "
      "there are @DN, @Spec, @Part, @Wall");
  EXPECT_EQ(stated("@DN = 7"), "'@DN = 7' picks no object");
  EXPECT_EQ(stated("ghost"), "'ghost' picks no object");
  for (int i = 0; i < 20; ++i)
    model_.objects[4].attributes.emplace_back("extra " + std::to_string(i), "");
  EXPECT_EQ(stated("@\"D\x07N\""),
            "'@\"D\x07N\"' picks no object: no object has an attribute @D?N; there are @DN, @Spec, "
            "@Part, @Wall, @extra 0, @extra 1, @extra 10, @extra 11, @extra 12, @extra 13, "
            "@extra 14, @extra 15 and 12 more");
  EXPECT_EQ(picks_nothing(Selection::parse("@DN").value(), Model()),
            "'@DN' picks no object: no object has an attribute @DN, nor any other");
}

TEST_F(SelectionTest, StatesByWhatItPicks) {
  const auto kinds = [](const char* text) {
    const Selection selection = Selection::parse(text).value();
    return std::pair(selection.tests_attributes(), selection.has_bare_pattern());
  };
  EXPECT_EQ(kinds("@DN = 7"), std::pair(true, false));
  EXPECT_EQ(kinds("PIPE*"), std::pair(false, true));
  EXPECT_EQ(kinds("name = PIPE*"), std::pair(false, false));
  EXPECT_EQ(kinds("PIPE* and not @DN"), std::pair(true, true));
  const Selection inner = Selection::parse("@DN").value();
  const Selection outer = Selection::parse("set(s)", [&](std::string_view) {
                            return Result<Selection>(inner);
                          }).value();
  EXPECT_TRUE(outer.tests_attributes()) << "by a set";
}

TEST_F(SelectionTest, BoxesOfTheModel) {
  EXPECT_EQ(picked("touches(0,-50,-500,1900,50,500)"), "p1 p2") << "touching faces count";
  EXPECT_EQ(picked("inside(-50,-50,-500,1900,50,500)"), "p1");
  EXPECT_EQ(picked("inside(-1m, -1m, -1m, 1e30, 10m, 10m)"), "p1 p2 v1 w1");
  EXPECT_EQ(picked("touches(7000,0,0,8000,1,1)"), "");
}

TEST_F(SelectionTest, AndBindsTighterThanOrAndNotTightest) {
  EXPECT_EQ(picked("name=WALL or type=cylinder and @DN=100"), "p1 w1");
  EXPECT_EQ(picked("(name=WALL or type=cylinder) and @DN=100"), "p1");
  EXPECT_EQ(picked("not type=cylinder and not type=mesh"), "v1 c1");
  EXPECT_EQ(picked("not (type=cylinder or type=mesh)"), "v1 c1");
  EXPECT_EQ(picked("not not w1"), "w1");
}

TEST_F(SelectionTest, FaultsNameTheColumnAndTheMend) {
  EXPECT_EQ(picked(""),
            "selection, column 1: an empty selection (write a pattern, as 'PIPE*', or "
            "a test, as type = box)");
  EXPECT_EQ(picked("colour = red"),
            "selection, column 1: no property is called 'colour' (properties are name, id, path, "
            "file, type, category, color and @ATTRIBUTE)");
  const std::vector<std::pair<std::string, std::string>> faults{
      {"PIPE 1", "column 6: '1' is one thing too many"},
      {"name =", "column 7: a value is missing before the end"},
      {"name = = x", "column 8: a value is missing"},
      {"(a or b", "column 8: a '(' that is never closed"},
      {"a)", "column 2: ')' is one thing too many"},
      {"a and", "column 6: a test or a pattern is missing"},
      {"'open", "column 1: a quote that is never closed"},
      {"@ = 3", "column 1: '@' without the name"},
      {"@DN > wide", "column 7: no number: 'wide'"},
      {"name > 3", "column 8: only attributes"},
      {"name ~ '('", "column 8: no regular expression"},
      {"inside(1,2,3)", "column 13: ',' is missing"},
      {"inside(0,0,0,1,-1,1)", "column 1: the box ends before it begins"},
      {"inside(0,0,0,1,1,nan)", "column 18: 'nan' is not a coordinate"},
      {std::string(100000, '('), "nested too deeply"},
  };
  for (const auto& [text, fault] : faults)
    EXPECT_NE(picked(text).find(fault), std::string::npos)
        << text.substr(0, 40) << ": " << picked(text);
}

TEST_F(SelectionTest, NamedSetsStandForWhatTheyPick) {
  const auto sets = [&](std::string_view name) -> Result<Selection> {
    if (name == "pipes") return Selection::parse("type = cylinder");
    if (name == "two words") return Selection::parse("w1 or p1");
    return Error{ErrorCode::usage, "no set is called '" + std::string(name) + "'", {}, "name one"};
  };
  const auto picked_by = [&](std::string_view text) {
    const auto selection = Selection::parse(text, sets);
    if (!selection) return selection.error().text();
    std::string names;
    const Scene scene = make_scene(model_, {}, {}).value();
    for (std::uint32_t o = 0; o < model_.objects.size(); ++o)
      if (selection->picks(scene, ObjectId{o})) names += model_.objects[o].name + " ";
    return names;
  };
  EXPECT_EQ(picked_by("set(pipes)"), picked_by("type = cylinder"));
  EXPECT_EQ(picked_by("not set(pipes) or set('two words')"),
            picked_by("type != cylinder or w1 or p1"));
  EXPECT_EQ(picked_by("a or set( nobody )"),
            "selection, column 11: no set is called 'nobody' (name one)");
  EXPECT_NE(picked_by("set(pipes").find("column 10: ')' is missing"), std::string::npos);
  EXPECT_NE(picked_by("set()").find("column 5: the name of a set is missing"), std::string::npos);
  EXPECT_NE(picked("set(pipes)").find("column 5: no set is called 'pipes'"), std::string::npos);
  EXPECT_EQ(picked_by("set"), "") << "a pattern without brackets";
}

TEST_F(SelectionTest, SetsThatGrowWithoutEndAreRefused) {
  const auto sets = [&](std::string_view wanted) -> Result<Selection> {
    Selection set = Selection::parse("a").value();
    const auto inner = [&](std::string_view) -> Result<Selection> { return set; };
    for (int level = 0; level < 40; ++level) {
      const auto twice = Selection::parse("set(x) and set(x)", inner);
      if (!twice) return twice.error();
      set = *twice;
    }
    return wanted == "s" ? Result<Selection>(set) : Selection::parse("b");
  };
  const auto heavy = Selection::parse("set(s)", sets);
  ASSERT_FALSE(heavy);
  EXPECT_NE(heavy.error().message.find("too many tests"), std::string::npos);
}

TEST_F(SelectionTest, HostileTextsEndSoon) {
  std::string many = "a";
  for (int i = 0; i < 100000; ++i) many += " or a";
  EXPECT_EQ(picked(many), "");
  std::string nots;
  for (int i = 0; i < 100000; ++i) nots += "not ";
  EXPECT_NE(picked(nots + "a").find("nested too deeply"), std::string::npos);
  // Backtracking matchers need exponential time for this one.
  model_.objects[0].name = std::string(5000, 'a');
  EXPECT_EQ(picked("name ~ '(a*)*b'"), "");
  model_.objects[0].attributes = {{"DN", std::string(1000000, '1')}};
  EXPECT_EQ(picked("@DN > 300mm"), "");
}

TEST_F(SelectionTest, TheSameForAnyNumberOfThreads) {
  for (const unsigned workers : {1U, 2U, 8U}) {
    parallel::Team team(workers);
    parallel::Context context;
    context.team = &team;
    EXPECT_EQ(picked("type = cylinder or w1", context), "p1 p2 w1");
  }
}

TEST_F(SelectionTest, AttributesOfGroupsAreThoseOfTheObjectsBelow) {
  model_.set_attributes(GroupId{0}, {{"Area", "7"}, {"Spec", "S-40"}, {"DN", "1"}});
  model_.set_attributes(GroupId{1}, {{"Area", "8"}, {"Tref", "/N1"}, {"Tref", "/N2"}});
  EXPECT_EQ(picked("@Tref = /N2"), "p1 p2 v1");
  EXPECT_EQ(picked("@Area = 8"), "p1 p2 v1");
  EXPECT_EQ(picked("@Area = 7"), "") << "the nearest group that states it";
  EXPECT_EQ(picked("@Spec = S-40"), "v1") << "what an object states itself it does not inherit";
  EXPECT_EQ(picked("@DN = 1"), "");
  EXPECT_EQ(picked("@Area != 8"), "w1 c1");
  model_.groups[0].parent = GroupId{1};
  EXPECT_EQ(picked("@Nobody"), "") << "groups that run in a circle";
}

}  // namespace
}  // namespace strake::model
