// SPDX-License-Identifier: Apache-2.0
// What rules say by relation and by common volume, on scenes whose answers are known.
#include <gtest/gtest.h>

#include <algorithm>
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

using test::box_mesh;
using test::ClashModel;
using test::ResultLines;
using test::run_rules;
using test::warned;

/// In reach of each other are: core, which lies in a block; bar, through a wall; twin, which is
/// there twice; post, which stands on a floor.
ClashModel scene(bool core_first = true) {
  ClashModel m;
  if (core_first) m.box("core", {40, 40, 40}, {60, 60, 60});
  m.box("block", {0, 0, 0}, {100, 100, 100});
  if (!core_first) m.box("core", {40, 40, 40}, {60, 60, 60});
  m.box("wall", {1000, 0, 0}, {1020, 100, 100});
  m.box("bar", {900, 45, 45}, {1100, 55, 55});
  m.box("twin", {2000, 0, 0}, {2100, 100, 100});
  m.box("twin2", {2000, 0, 0}, {2100, 100, 100});
  m.box("floor", {3000, 0, 0}, {3100, 100, 20});
  m.box("post", {3040, 40, 20}, {3060, 60, 200});
  return m;
}

/// The results that a rule between two selections with some keys does not allow.
ResultLines open_under(const ClashModel& m, const std::string& a, const std::string& b,
                       const std::string& keys) {
  const auto outcome = run_rules(
      m.model, "[[allowed]]\nname = \"meant\"\na = \"" + a + "\"\nb = \"" + b + "\"\n" + keys);
  ResultLines open = outcome.reported.at(0);
  std::erase_if(open, [](const std::string& one) { return one.ends_with(" by meant"); });
  return open;
}

TEST(RulesRelation, AResultIsAllowedOnlyIfItsRelationIsAmongThem) {
  const ClashModel m = scene();
  const auto with = [&](const std::string& words) {
    return open_under(m, "*", "*", "relation = " + words);
  };
  const std::string core = "core-block HIT", bar = "wall-bar HIT", twin = "twin-twin2 HIT",
                    post = "floor-post CONTACT";
  EXPECT_EQ(with("['inside', 'through', 'duplicate', 'abut']"), ResultLines{});
  EXPECT_EQ(with("'inside'"), (ResultLines{bar, twin, post}));
  EXPECT_EQ(with("'through'"), (ResultLines{core, twin, post}));
  EXPECT_EQ(with("['duplicate']"), (ResultLines{core, bar, post}));
  EXPECT_EQ(with("['abut']"), (ResultLines{core, bar, twin}));
  EXPECT_EQ(with("['INTERFERE', 'abut_outside']"), (ResultLines{core, twin}));
  EXPECT_EQ(with("['cross', 'separate', 'ABUT_INSIDE']"), (ResultLines{core, bar, twin, post}));
}

TEST(RulesRelation, InsideIsAboutTheRulesAAndB) {
  for (const bool core_first : {true, false}) {
    const ClashModel m = scene(core_first);
    const ResultLines hit{core_first ? "core-block HIT" : "block-core HIT"};
    const auto open = [&](const char* a, const char* b, const std::string& word) {
      ResultLines all = open_under(m, a, b, "relation = '" + word + "'");
      std::erase_if(all, [&](const std::string& one) { return one != hit.front(); });
      return all;
    };
    EXPECT_EQ(open("core", "block", "inside"), ResultLines{}) << core_first;
    EXPECT_EQ(open("block", "core", "inside"), hit) << core_first;
    EXPECT_EQ(open("block", "core", "b_in_a"), ResultLines{}) << core_first;
    EXPECT_EQ(open("core", "block", "A_IN_B"), ResultLines{}) << core_first;
    EXPECT_EQ(open("core", "block", "b_in_a"), hit) << core_first;
    EXPECT_EQ(open("core or block", "block", "inside"), ResultLines{}) << core_first;
  }
}

TEST(RulesRelation, ADepthLimitsThemStill) {
  const ClashModel m = scene();
  EXPECT_EQ(open_under(m, "bar", "wall", "relation = 'through'\nmax_depth = '10mm'").size(), 3U);
  EXPECT_EQ(open_under(m, "bar", "wall", "relation = 'through'\nmax_depth = '9.9mm'").size(), 4U);
  EXPECT_EQ(open_under(m, "bar", "wall", "max_depth = 'any'").size(), 3U);
}

/// One part of the bar lies in the block, another passes through it.
TEST(RulesRelation, EachPairOfPartsIsClassifiedByItself) {
  ClashModel m;
  m.box("bar", {40, 40, 40}, {60, 60, 60}).body(box_mesh({-50, 10, 10}, {150, 20, 20}));
  m.box("block", {0, 0, 0}, {100, 100, 100});
  EXPECT_EQ(open_under(m, "bar", "block", "relation = 'inside'"), (ResultLines{"bar-block HIT"}));
  EXPECT_EQ(open_under(m, "bar", "block", "relation = ['inside', 'through']"), ResultLines{});
}

/// A cylinder as deep in a mesh as a touch may be: its sag leaves open whether it is a HIT.
ClashModel uncertain() {
  ClashModel m;
  m.object("pipe").body(geometry::CylinderPrimitive{50, 100});
  m.box("plate", {49, -100, -100}, {149, 100, 100});
  return m;
}

TEST(RulesRelation, WhatIsUncertainIsNeitherAllowedNorLeftOut) {
  const ClashModel m = uncertain();
  const auto plain = run_rules(m.model, "");
  ASSERT_EQ(plain.reports.at(0).pairs.size(), 1U);
  ASSERT_NE(plain.reports[0].pairs[0].flags & clash::kUncertain, 0U);
  EXPECT_EQ(open_under(m, "*", "*", "relation = ['through', 'inside', 'abut', 'separate']").size(),
            1U);
  const auto tested = run_rules(m.model, "[[test]]\nname = 't'\nrelations = 'duplicate'");
  EXPECT_EQ(tested.reported.at(0), plain.reported.at(0));
  EXPECT_EQ(tested.reports.at(0).not_reported.by_relation.all(), 0U);
}

TEST(RulesRelation, ATestReportsSomeAndCountsTheOthers) {
  const ClashModel m = scene();
  const auto outcome = run_rules(m.model, R"toml(
[defaults]
relations = ["duplicate"]
[[allowed]]
name = "meant"
a = "post"
b = "floor"
[[test]]
name = "twins"
[[test]]
name = "through"
relations = ["through", "inside"]
a = "bar or core"
[[test]]
name = "the other way round"
relations = "inside"
a = "block"
b = "core"
)toml");
  ASSERT_EQ(outcome.reported.size(), 3U);
  EXPECT_EQ(outcome.reported[0], (ResultLines{"twin-twin2 HIT"}));
  EXPECT_EQ(outcome.reported[1], (ResultLines{"core-block HIT", "wall-bar HIT"}));
  EXPECT_EQ(outcome.reported[2], ResultLines{}) << "the block is in no core";
  const clash::Report& twins = outcome.reports[0];
  EXPECT_EQ(twins.not_reported.by_relation.hit, 2U);
  EXPECT_EQ(twins.not_reported.by_relation.allowed, 1U);
  EXPECT_EQ(twins.not_reported.by_relation.all(), 3U);
  EXPECT_EQ(twins.count_hit, 1U);
  EXPECT_EQ(twins.count_allowed, 0U);
  EXPECT_EQ(outcome.reports[2].not_reported.by_relation.hit, 1U);
}

/// The worst of the two objects is that they interfere, but two parts of theirs are one body.
TEST(RulesRelation, APairIsReportedForAnyOfItsParts) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {10, 10, 10}).body(box_mesh({100, 0, 0}, {200, 100, 100}));
  m.box("b", {0, 0, 0}, {10, 10, 10}).body(box_mesh({160, 0, 0}, {260, 100, 100}));
  const auto found = run_rules(m.model, "").reports.at(0).pairs;
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].relation, clash::Relation::interfere);
  const auto tested = run_rules(m.model, "[[test]]\nname = 't'\nrelations = 'duplicate'");
  EXPECT_EQ(tested.reported.at(0), (ResultLines{"a-b HIT"}));
}

/// The bar and the wall have 10 x 10 x 20 mm in common: two cubic centimetres.
TEST(RulesVolume, AResultIsAllowedUpToAVolume) {
  const ClashModel m = scene();
  const auto is_open = [&](const std::string& volume) {
    const ResultLines open = open_under(m, "bar", "wall", "max_volume = " + volume);
    return std::ranges::find(open, "wall-bar HIT") != open.end();
  };
  EXPECT_FALSE(is_open("'2cm3'"));
  EXPECT_FALSE(is_open("'0.002 l'"));
  EXPECT_TRUE(is_open("'1.999cm3'"));
  EXPECT_TRUE(is_open("0"));
  EXPECT_TRUE(is_open("'2cm3'\nmax_depth = '4mm'"));
  EXPECT_TRUE(is_open("'2cm3'\nrelation = 'inside'"));
}

TEST(RulesVolume, ATestCountsSmallerHits) {
  const ClashModel m = scene();
  const auto run = [&](const char* volume) {
    return run_rules(m.model, std::string("[[test]]\nname = 't'\nmin_volume = '") + volume + "'");
  };
  EXPECT_EQ(run("2cm3").reported.at(0).size(), 4U);
  const auto larger = run("2.001cm3");
  EXPECT_EQ(larger.reported.at(0),
            (ResultLines{"core-block HIT", "twin-twin2 HIT", "floor-post CONTACT"}));
  EXPECT_EQ(larger.reports.at(0).not_reported.by_volume.hit, 1U);
  EXPECT_EQ(larger.reports.at(0).not_reported.by_volume.all(), 1U);
  EXPECT_EQ(run("1l").reported.at(0), (ResultLines{"twin-twin2 HIT", "floor-post CONTACT"}));
  EXPECT_EQ(run("1.001l").reported.at(0), (ResultLines{"floor-post CONTACT"}))
      << "contacts are no hits";
}

/// What a test reports does not change with what a rule allows of it.
TEST(RulesRelation, WhatIsAllowedIsNotReportedEither) {
  const std::string allowed =
      "\n[[allowed]]\nname = 'x'\na = 'bar'\nb = 'wall'\nmax_depth = 'any'\n";
  for (const std::string key : {"min_volume = '2.001cm3'", "relations = ['inside', 'duplicate']"}) {
    const auto outcome = run_rules(scene().model, "[[test]]\nname = 't'\n" + key + allowed);
    const clash::Report& report = outcome.reports.at(0);
    const auto& reported = outcome.reported.at(0);
    EXPECT_EQ(std::ranges::find(reported, "wall-bar HIT by x"), reported.end()) << key;
    EXPECT_EQ(report.count_allowed, 0U) << key;
    EXPECT_EQ(report.not_reported.by_volume.allowed + report.not_reported.by_relation.allowed, 1U);
  }
}

/// A cylinder of 10 mm radius through a plate 10 mm thick: 3.14 cm3, to within its sag.
TEST(RulesVolume, ABracketThatStraddlesTheLimitAllowsNothingAndIsFlagged) {
  ClashModel m;
  m.object("pipe").body(geometry::CylinderPrimitive{10, 100});
  m.box("plate", {-50, -50, -5}, {50, 50, 5});
  const auto pair = [&](const std::string& rule) {
    const auto outcome = run_rules(m.model, rule);
    return outcome.reports.at(0).pairs.at(0);
  };
  const auto allowed = [&](const char* volume) {
    return pair("[[allowed]]\nname = 'x'\na = 'pipe'\nb = 'plate'\nmax_volume = '" +
                std::string(volume) + "'");
  };
  ASSERT_EQ(pair("").flags & clash::kUncertain, 0U);
  EXPECT_GE(allowed("4cm3").allowed, 0);
  EXPECT_LT(allowed("3.1cm3").allowed, 0);
  EXPECT_NE(allowed("3.1cm3").flags & clash::kUncertain, 0U);
  EXPECT_LT(allowed("2cm3").allowed, 0);
  EXPECT_EQ(allowed("2cm3").flags & clash::kUncertain, 0U);
  const clash::Pair listed = pair("[[test]]\nname = 't'\nmin_volume = '3.1cm3'");
  EXPECT_NE(listed.flags & clash::kUncertain, 0U);
}

/// A sheet has no volume: what is not known is neither allowed nor left out.
TEST(RulesVolume, SheetsAreNotLeftOut) {
  ClashModel m;
  geometry::TriangleMesh sheet;
  sheet.vertices = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  m.object("sheet").body(sheet);
  m.box("bar", {-5, -5, -100}, {5, 5, 100});
  EXPECT_EQ(open_under(m, "*", "*", "max_volume = '1m3'").size(), 1U);
  EXPECT_EQ(run_rules(m.model, "[[test]]\nname = 't'\nmin_volume = '1m3'").reported.at(0).size(),
            1U);
}

TEST(RulesVolume, VolumesAreMeasuredOnlyWhereARuleConcernsThePair) {
  const ClashModel m = scene();
  const auto work = [&](const char* a, const char* b) {
    return run_rules(m.model, std::string("[[allowed]]\nname = 'x'\nmax_volume = '1mm3'\na = '") +
                                  a + "'\nb = '" + b + "'")
        .reports.at(0)
        .counters.volume_triangle_pairs;
  };
  const std::uint64_t one = work("bar", "wall"), other = work("twin", "twin2");
  EXPECT_GT(one, 0U);
  EXPECT_EQ(work("bar or twin", "wall or twin2"), one + other);
  EXPECT_EQ(work("bar", "twin"), 0U);
}

TEST(RulesVolume, TheSameForAnyTeam) {
  const ClashModel m = scene();
  const std::string text =
      "[defaults]\nrelations = ['through', 'inside']\nmin_volume = '3cm3'\n"
      "[[allowed]]\nname = 'x'\na = 'core'\nb = '*'\nmax_volume = '9cm3'";
  parallel::Team team(3);
  const auto one = run_rules(m.model, text), three = run_rules(m.model, text, {.team = &team});
  EXPECT_EQ(one.reported, three.reported);
  EXPECT_EQ(one.reported.at(0), (ResultLines{"core-block HIT by x"}));
  EXPECT_EQ(one.reports.at(0).hash, three.reports.at(0).hash);
}

TEST(RulesRelation, TheLogHasTheClassesOfWhatIsNotReported) {
  const ClashModel m = scene();
  const auto rules = Rules::parse("[[test]]\nname = 't'\nrelations = 'cross'", "r.toml");
  ASSERT_TRUE(rules);
  const auto scene_made = make_scene(m.model, rules->scene_options(), {}).value();
  PlannedTest test = rules->plan(scene_made, {}).value().tests.at(0);
  test.options.engine.log_pairs = true;
  test.options.engine.contacts = clash::Contacts::count;
  const auto report = clash::detect(scene_made, test.sets, test.options, test.policy, {}).value();
  EXPECT_TRUE(report.pairs.empty());
  const auto logged = [&](clash::Class cls) {
    return std::ranges::count(report.log, cls, &clash::LoggedPair::cls);
  };
  EXPECT_EQ(logged(clash::Class::hit), 3);
  EXPECT_EQ(logged(clash::Class::contact), 1);
}

TEST(RulesRelation, TheBaselineReportsNone) {
  const ClashModel m = scene();
  for (const char* const keys : {"relation = 'inside'", "max_volume = '1l'"}) {
    const auto rules =
        Rules::parse(std::string("[[allowed]]\nname = 'x'\na = '*'\nb = '*'\n") + keys, "r.toml");
    ASSERT_TRUE(rules);
    const auto scene_made = make_scene(m.model, rules->scene_options(), {}).value();
    Plan plan = rules->plan(scene_made, {}).value();
    PlannedTest& test = plan.tests.at(0);
    test.options.engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
    const auto report = clash::detect(scene_made, test.sets, test.options, test.policy, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::usage);
  }
}

TEST(RulesRelation, FaultsNamePlaceCauseAndMend) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"relation = 'near'", "line 5, column 12: 'relation' of [[allowed]] 'x' has the word 'near'"},
      {"relation = 'near'", "write some of inside, through, abut, separate"},
      {"relation = []", "names no relation"},
      {"relation = 3", "a text in quotes"},
      {"max_volume = 5", "a volume with its unit in quotes"},
      {"max_volume = '5'", "write 5cm3"},
      {"max_volume = '5mm'", "is a length, not a volume"},
      {"max_volume = '-5cm3'", "is negative"},
      {"max_volume = '5 gallons'", "write mm3, cm3, dm3, l, m3, in3 or ft3"},
      {"relations = 'inside'", "no key 'relations'"},
  };
  for (const auto& [key, stated] : faults) {
    const auto rules =
        Rules::parse("[[allowed]]\nname = 'x'\na = '*'\nb = '*'\n" + key + "\n", "r.toml");
    ASSERT_FALSE(rules) << key;
    EXPECT_NE(rules.error().text().find(stated), std::string::npos) << rules.error().text();
  }
}

}  // namespace
}  // namespace strake::rules
