// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/policy.hpp"
#include "strake/parallel/team.hpp"
#include "strake/rules/rules.hpp"
#include "support/clash_model.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::ClashModel;
using test::Counts;
using test::exempted;
using test::expect_lines;
using test::ResultLines;
using test::Row;
using test::warned;

TEST(RulesPlan, SeveralTestsInTheOrderOfTheFile) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const auto outcome = row.run(R"toml(
[sets]
first = "a"
[[test]]
name = "second to none"
a = "set(first)"
b = "b"
[[test]]
name = "not today"
enabled = false
[[test]]
name = "shallow"
touch_overlap = "10.5mm"
thickness_cap = false
)toml");
  ASSERT_EQ(outcome.reported.size(), 2U);
  EXPECT_EQ(outcome.reports[0].name, "second to none");
  EXPECT_EQ(outcome.reports[0].set_a, "set(first)");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT"}));
  EXPECT_EQ(outcome.reported[1], (ResultLines{"a-b CONTACT", "b-c CONTACT"}));
  EXPECT_EQ(outcome.reports[1].options.tolerances.touch_overlap_mm, 10.5);
  EXPECT_TRUE(outcome.diagnostics.kept().empty());
}

TEST(RulesPlan, OneSetAloneIsAgainstEverything) {
  const Row row = Row().cube("a").cube("b").cube("c");
  EXPECT_EQ(row.hits("[[test]]\nname = \"x\"\na = \"a or b\""),
            (ResultLines{"a-b HIT", "b-c HIT"}));
  EXPECT_EQ(row.hits("[[test]]\nname = \"x\"\nb = \"a\""), (ResultLines{"a-b HIT"}));
}

TEST(RulesPlan, UnitGroupsByAttributeAndByRule) {
  const Row row = Row()
                      .cube("a", {{"UNIT", "7"}})
                      .cube("b", {{"UNIT", " '7' "}})
                      .cube("c", {{"UNIT", "-3"}})
                      .cube("d", {{"UNIT", "-3"}})
                      .cube("e", {{"UNIT", "seven"}})
                      .cube("f")
                      .cube("g", {{"UNIT", "7"}});
  auto outcome = row.run("[unit_groups]\nattribute = \"UNIT\"");
  EXPECT_EQ(outcome.reported[0],
            (ResultLines{"b-c HIT", "c-d HIT", "d-e HIT", "e-f HIT", "f-g HIT"}))
      << "a negative number is no unit";
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"unit groups", 1}}));
  EXPECT_EQ(warned(outcome.diagnostics, "unit-not-a-number"),
            "e: the attribute 'UNIT' is 'seven'; the object is in no unit\n");
  outcome = row.run(R"toml(
[unit_groups]
name = "skids"
attribute = "UNIT"
[[unit_groups.group]]
number = -1
select = "a"
[[unit_groups.group]]
number = 7
select = "name ~ '^[acdf]$'"
)toml");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "d-e HIT", "e-f HIT"}))
      << "the first rule decides";
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"skids", 3}}));
}

/// site/pump: a, b; site/pump itself holds c; site/fan: d, e; other/fan: f.
Row assemblies() {
  Row row;
  const auto site = row.group("site"), other = row.group("other");
  const auto pump = row.group("pump", site), fan = row.group("fan", site);
  row.cube("a", {}, pump).cube("b", {}, pump).cube("pump", {}, site);
  row.cube("d", {}, fan).cube("e", {}, fan).cube("f", {}, row.group("fan", other));
  return row;
}

TEST(RulesPlan, SameAssemblyByLevel) {
  const Row row = assemblies();
  const auto with = [&](const std::string& keys) {
    return row.hits("[[same_assembly]]\nname = \"one\"\n" + keys);
  };
  EXPECT_EQ(with("level = 2"), (ResultLines{"pump-d HIT", "e-f HIT"}))
      << "a group that is an object too";
  EXPECT_EQ(with("level = 1"), (ResultLines{"e-f HIT"}));
  EXPECT_EQ(with("level = 3"),
            (ResultLines{"a-b HIT", "b-pump HIT", "pump-d HIT", "d-e HIT", "e-f HIT"}));
  EXPECT_EQ(with("level = \"parent\""), (ResultLines{"b-pump HIT", "pump-d HIT", "e-f HIT"}));
  EXPECT_EQ(with("group = \"p*p\""), (ResultLines{"pump-d HIT", "d-e HIT", "e-f HIT"}));
  EXPECT_EQ(with("group = \"fan\"\nacross_files = true"),
            (ResultLines{"a-b HIT", "b-pump HIT", "pump-d HIT", "e-f HIT"}))
      << "site/fan is not other/fan";
  EXPECT_EQ(with("level = 1\namong = \"a or b or d\""),
            (ResultLines{"b-pump HIT", "pump-d HIT", "d-e HIT", "e-f HIT"}));
}

TEST(RulesPlan, SameAssemblyAcrossFiles) {
  Row row;
  const auto one = row.group("skid"), two = row.group("skid");
  row.cube("a", {}, one, 0).cube("b", {}, two, 1);
  const std::string rule = "[[same_assembly]]\nname = \"skid\"\nlevel = 1\n";
  EXPECT_EQ(row.hits(rule), (ResultLines{"a-b HIT"}));
  EXPECT_EQ(row.hits(rule + "across_files = true"), ResultLines{});
}

TEST(RulesPlan, ConnectedByThePartnersNameOrId) {
  const Row row = Row()
                      .cube("a", {{"TREF", "'/b'"}, {"HREF", "Nulref"}})
                      .cube("b", {{"Name", "/b"}})
                      .cube("c", {{"HREF", "b"}})
                      .cube("d", {{"TREF", "unset"}, {"CREF", "x, e,y"}})
                      .cube("e", {{"TREF", "Nulref"}})
                      .cube("f", {{"TREF", "Nulref"}});
  const std::string rule = "[[connected]]\nname = \"joints\"\nattributes = [\"HREF\", \"TREF\"]\n";
  auto outcome = row.run(rule);
  EXPECT_EQ(outcome.reported[0], (ResultLines{"c-d HIT", "d-e HIT", "e-f HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"joints", 2}}));
  outcome = row.run("[[connected]]\nname = \"c\"\nattributes = \"CREF\"\nseparator = \",\"");
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"c", 1}}));
}

TEST(RulesPlan, ConnectedByACommonNode) {
  const Row row = Row()
                      .cube("a", {{"END1", "n1"}, {"END2", "n2"}})
                      .cube("b", {{"END1", "n2"}})
                      .cube("c", {{"END1", "n3"}})
                      .cube("d", {{"END2", "d"}});
  const std::string rule = "[[connected]]\nname = \"x\"\nattributes = [\"END1\", \"END2\"]\n";
  EXPECT_EQ(row.hits(rule + "by = \"node\""), (ResultLines{"b-c HIT", "c-d HIT"}));
  EXPECT_EQ(row.hits(rule), (ResultLines{"a-b HIT", "b-c HIT", "c-d HIT"}));
}

TEST(RulesPlan, ConnectedToAGroupOfThePartner) {
  Row row;
  const auto branch = row.group("/100-B-1");
  row.cube("nozzle", {{"CREF", "/100-B-1"}}).cube("elbow", {}, branch).cube("tee", {}, branch);
  const std::string rule = "[[connected]]\nname = \"x\"\nattributes = [\"CREF\"]\n";
  EXPECT_EQ(row.hits(rule), (ResultLines{"nozzle-elbow HIT", "elbow-tee HIT"}));
  EXPECT_EQ(row.hits(rule + "groups = true"), (ResultLines{"elbow-tee HIT"}));
}

TEST(RulesPlan, WhatABranchIsConnectedToItsEndsAre) {
  Row row;
  const auto branch = row.group("/100-B-1", {{"HREF", "=7/1"}, {"TREF", "pump"}});
  const auto equipment = row.group("/E-1", {{"Name", "=7/1"}});
  row.cube("tank", {}, equipment).cube("flange", {}, branch).cube("elbow", {}, branch);
  row.cube("strainer", {{"Name", "pump"}}).cube("tee", {}, branch).cube("cap", {}, branch);
  row.cube("pump");
  const std::string rule =
      "[[connected]]\nname = \"x\"\nattributes = [\"HREF\", \"TREF\"]\ngroups = true\n";
  EXPECT_EQ(row.hits(rule), (ResultLines{"flange-elbow HIT", "elbow-strainer HIT",
                                         "strainer-tee HIT", "tee-cap HIT"}));
  EXPECT_EQ(row.hits(rule + "inherited = \"all\""),
            (ResultLines{"flange-elbow HIT", "tee-cap HIT"}));
  EXPECT_EQ(row.hits(rule + "inherited = \"none\"").size(), 6U);
  EXPECT_EQ(row.hits("[[connected]]\nname = \"x\"\nattributes = \"TREF\"").size(), 5U);
}

TEST(RulesPlan, TheHeadOfABranchIsItsFirstObjectAndTheTailItsLast) {
  const auto between = [](const char* head, const char* tail) {
    Row row;
    const auto branch = row.group("/100-B-1", {{"HREF", head}, {"TREF", tail}});
    row.cube("pump").cube("flange", {}, branch).cube("elbow", {}, branch).cube("tank");
    return row;
  };
  const Row right = between("pump", "tank"), wrong = between("tank", "pump");
  const std::string named = "[[connected]]\nname = \"x\"\nhead = \"HREF\"\ntail = [\"TREF\"]\n";
  EXPECT_EQ(right.hits(named), (ResultLines{"flange-elbow HIT"}));
  EXPECT_EQ(wrong.hits(named).size(), 3U) << "the tail runs into what the head is joined to";
  const std::string either = "[[connected]]\nname = \"x\"\nattributes = [\"HREF\", \"TREF\"]\n";
  EXPECT_EQ(right.hits(either), (ResultLines{"flange-elbow HIT"}));
  EXPECT_EQ(wrong.hits(either), (ResultLines{"flange-elbow HIT"}))
      << "which end is which is not said";
  Row row_of_one;
  const auto branch = row_of_one.group("/100-B-2", {{"HREF", "pump"}, {"TREF", "tank"}});
  row_of_one.cube("pump").cube("spool", {}, branch).cube("tank");
  EXPECT_EQ(row_of_one.hits(named), ResultLines{}) << "one object is both ends";
}

TEST(RulesPlan, AttributesOfGroupsCountForTheObjectsBelow) {
  Row row;
  const auto skid = row.group("skid", {{"UNIT", "7"}, {"SYSTEM", "oil"}, {"OBST", "0"}});
  row.cube("a", {}, skid).cube("b", {{"UNIT", "8"}}, skid).cube("c", {{"OBST", "2"}}, skid);
  EXPECT_EQ(row.hits("[unit_groups]\nattribute = \"UNIT\""), (ResultLines{"a-b HIT", "b-c HIT"}));
  EXPECT_EQ(row.hits("[[same_attribute]]\nname = \"s\"\nattribute = \"SYSTEM\""), ResultLines{});
  EXPECT_EQ(row.hits("[obstruction]\n[[test]]\nname = \"t\"\na = \"@OBST = 2\""), ResultLines{});
}

TEST(RulesPlan, SameAttributeSameFileAndPairsOfSets) {
  const Row row = Row()
                      .cube("a", {{"SYSTEM", "hvac"}}, model::GroupId::none, 0)
                      .cube("b", {{"SYSTEM", "hvac"}}, model::GroupId::none, 1)
                      .cube("c", {{"SYSTEM", "none"}}, model::GroupId::none, 1)
                      .cube("d", {{"SYSTEM", "none"}}, model::GroupId::none, 0);
  EXPECT_EQ(row.hits("[[same_attribute]]\nname = \"s\"\nattribute = \"SYSTEM\""),
            (ResultLines{"b-c HIT", "c-d HIT"}));
  const auto outcome = row.run("[defaults]\nwithin_file = false");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "c-d HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"within one file", 1}}));
  EXPECT_EQ(row.hits("[[exempt]]\nname = \"x\"\na = \"file = t.obj\"\nb = \"file = u.obj\""),
            (ResultLines{"b-c HIT"}));
}

TEST(RulesPlan, ATestMayDoWithoutARule) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const auto outcome = row.run(R"toml(
[[exempt]]
name = "ab"
a = "a"
b = "b"
[[allowed]]
name = "bc"
a = "b"
b = "c"
max_depth = "any"
[[test]]
name = "strict"
without = ["ab", "bc"]
[[test]]
name = "lenient"
)toml");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "b-c HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), Counts{});
  EXPECT_EQ(outcome.reported[1], (ResultLines{"b-c HIT by bc"}));
}

TEST(RulesPlan, ObstructionLevels) {
  const Row row = Row()
                      .cube("a", {{"OBST", "2"}})
                      .cube("b", {{"OBST", "1"}})
                      .cube("c", {{"OBST", "Soft"}})
                      .cube("d", {{"OBST", " 'NONE'"}})
                      .cube("e", {{"OBST", "5"}})
                      .cube("f")
                      .cube("g")
                      .category(model::Category::obstruction);
  EXPECT_EQ(row.hits("").size(), 5U) << "off unless asked for, and no obstruction volumes";
  auto outcome = row.run("[obstruction]");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "b-c HIT", "e-f HIT", "f-g HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"no obstruction", 2}}));
  EXPECT_EQ(outcome.reports[0].pairs[3].level_b, clash::Level::soft);
  EXPECT_EQ(warned(outcome.diagnostics, "obstruction-not-known"),
            "e: the attribute 'OBST' is '5', not 0, 1 or 2; the object counts as hard\n");
  outcome = row.run(
      "[obstruction]\nsoft_against_soft = false\nvolumes = \"none\"\nsoft = \"f\"\nnone = \"a\"");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"e-f HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]),
            (Counts{{"no obstruction", 3}, {"soft against soft", 1}}));
  EXPECT_EQ(outcome.reports[0].pairs[0].level_b, clash::Level::soft);
}

TEST(RulesPlan, ObstructionLevelsOfTheFirstAttributeThatAnObjectHas) {
  const Row row = Row()
                      .cube("a", {{"Obstruction", "0"}})
                      .cube("b", {{"OBST", "2"}, {"Obstruction", "0"}})
                      .cube("c", {{"OBST", "unset"}, {"Obstruction", "1"}});
  const auto outcome = row.run("[obstruction]\nattribute = [\"OBST\", \"Obstruction\"]");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"b-c HIT"}));
  EXPECT_EQ(outcome.reports[0].pairs[0].level_b, clash::Level::soft);
  EXPECT_EQ(row.hits("[obstruction]"), (ResultLines{"a-b HIT", "b-c HIT"}));
}

TEST(RulesPlan, Insulation) {
  const Row row = Row()
                      .cube("a")
                      .cube("b")
                      .category(model::Category::insulation)
                      .cube("c")
                      .category(model::Category::insulation)
                      .cube("d")
                      .category(model::Category::obstruction);
  EXPECT_EQ(row.hits(""), ResultLines{});
  EXPECT_EQ(row.hits("[insulation]"), (ResultLines{"a-b HIT", "b-c HIT"}));
  EXPECT_EQ(row.hits("[insulation]\nagainst_insulation = false"), (ResultLines{"a-b HIT"}));
  EXPECT_EQ(row.hits("[obstruction]\n[insulation]"),
            (ResultLines{"a-b HIT", "b-c HIT", "c-d HIT"}));
  EXPECT_EQ(row.hits("[obstruction]\n[insulation]\nagainst_soft = false"),
            (ResultLines{"a-b HIT", "b-c HIT"}));
}

TEST(RulesPlan, AllowedContacts) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const auto outcome = row.run(R"toml(
[[allowed]]
name = "seat"
a = "a or b or c"
b = "*"
max_depth = "10.5mm"
region = { min = ["-1m", "-1m", "-1m"], max = ["1m", "1m", "1m"] }
cavity = [ { point = ["150mm", 0, 0], normal = [1, 0, 0] } ]
)toml");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "b-c HIT by seat"}));
  EXPECT_EQ(outcome.reports[0].count_allowed, 1U);
  EXPECT_EQ(outcome.reports[0].counters.allowed_pairs, 2U);
}

constexpr std::string_view kDisciplines = R"toml(
[[discipline]]
name = "hull"
select = "a or b"
[[discipline]]
name = "pipes"
select = "b or c"
)toml";

TEST(RulesPlan, DisciplinesTheFirstThatPicksAnObjectCounts) {
  const Row row = Row().cube("a").cube("b").cube("c").cube("d");
  const auto outcome = row.run(std::string(kDisciplines) + R"toml(
[matrix]
[matrix.cells.pipes]
hull = { touch_overlap = "10.5mm", thickness_cap = false }
)toml");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "b-c CONTACT"}))
      << "d is of no discipline";
  EXPECT_EQ(outcome.reports[0].name, "matrix");
  EXPECT_EQ(outcome.reports[0].disciplines[0].objects, 2U);
  EXPECT_EQ(outcome.reports[0].disciplines[1].objects, 1U);
  EXPECT_EQ(warned(outcome.diagnostics, "in-several-disciplines"),
            "r.toml, line 7: [[discipline]] 'pipes', select: 1 object counts for 'hull', which "
            "comes first\n");
  EXPECT_EQ(warned(outcome.diagnostics, "in-no-discipline"),
            "r.toml: [[discipline]]: 1 object is of no discipline and not checked by the matrix\n");
}

TEST(RulesPlan, MissingCellsAreAsStated) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const std::string cells = "[matrix.cells.hull]\npipes = \"checked\"\n";
  EXPECT_EQ(row.hits(std::string(kDisciplines) + cells), (ResultLines{"a-b HIT", "b-c HIT"}));
  const auto outcome =
      row.run(std::string(kDisciplines) + "[matrix]\nmissing = \"not checked\"\n" + cells);
  EXPECT_EQ(outcome.reported[0], (ResultLines{"b-c HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"matrix", 1}}));
}

TEST(RulesPlan, WhatMatchesNothingIsNamed) {
  const Row row = Row().cube("a").cube("b");
  const auto outcome = row.run(R"toml(
[sets]
ghosts = "x*"
[[test]]
name = "t"
a = "y*"
[unit_groups]
attribute = "UNIT"
[[same_assembly]]
name = "deep"
level = 9
[[connected]]
name = "joints"
attributes = "HREF"
[[same_attribute]]
name = "system"
attribute = "SYS"
[[exempt]]
name = "old"
a = "a"
b = "z*"
[obstruction]
[[allowed]]
name = "seat"
a = "w*"
b = "a"
)toml");
  expect_lines(
      warned(outcome.diagnostics, "rule-matches-nothing"),
      {"r.toml, line 3: [sets] 'ghosts': 'x*' picks no object\n",
       "r.toml, line 6: [[test]] 't', a: 'y*' picks no object\n",
       "r.toml, line 7: [unit_groups]: no object has the attribute 'UNIT'\n",
       "r.toml, line 9: [[same_assembly]] 'deep': no object lies in such a group\n",
       "r.toml, line 12: [[connected]] 'joints': no object has one of the attributes with a "
       "value\n",
       "r.toml, line 15: [[same_attribute]] 'system': no object has the attribute 'SYS'\n",
       "r.toml, line 21: [[exempt]] 'old', b: 'z*' picks no object\n",
       "r.toml: [obstruction]: no object has the attribute 'OBST' and there are no obstruction "
       "volumes\n",
       "r.toml, line 25: [[allowed]] 'seat', a: 'w*' picks no object\n"});
  EXPECT_EQ(outcome.reports[0].diagnostics.count("empty-set"), 1U);
}

TEST(RulesPlan, TheSameForAnyTeam) {
  const Row row = assemblies();
  const std::string rules = std::string(kDisciplines) + R"toml(
[matrix.cells.hull]
hull = { clearance = "5mm" }
[[same_assembly]]
name = "one"
level = 2
[[test]]
name = "all"
)toml";
  const auto first = row.run(rules);
  for (const unsigned workers : {1U, 3U, 64U}) {
    parallel::Team team(workers);
    parallel::Context context;
    context.team = &team;
    const auto again = row.run(rules, context);
    ASSERT_EQ(again.reports.size(), first.reports.size());
    for (std::size_t t = 0; t < first.reports.size(); ++t) {
      EXPECT_EQ(again.reports[t].hash, first.reports[t].hash);
      EXPECT_EQ(exempted(again.reports[t]), exempted(first.reports[t]));
    }
    EXPECT_EQ(again.diagnostics.kept().size(), first.diagnostics.kept().size());
  }
}

TEST(RulesPlan, CanBeCancelled) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {1, 1, 1});
  const auto scene = make_scene(m.model, {}, {}).value();
  const std::stop_source source;
  source.request_stop();
  const auto plan = Rules::parse("[[exempt]]\nname = \"x\"\na = \"a\"\nb = \"b\"", "r")
                        .value()
                        .plan(scene, {.team = nullptr, .stop = source.get_token()});
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::rules
