// SPDX-License-Identifier: Apache-2.0
// Ends that meet within a length, on generated pipes.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using geometry::CircularTorusPrimitive;
using geometry::CylinderPrimitive;
using geometry::Placement;
using geometry::SnoutPrimitive;
using geometry::Vec3d;
using test::ClashModel;
using test::exempted;
using test::ResultLines;
using test::run_rules;
using test::warned;

/// From a cylinder's frame to one whose axis runs along x or y.
constexpr geometry::Mat3d kAlongX{{Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}};
constexpr geometry::Mat3d kAlongY{{Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}}};

/// A pipe of radius 50 and length 1000 along z, from a height on.
ClashModel& pipe(ClashModel& m, const std::string& id, double from, double radius = 50) {
  return m.object(id).body(CylinderPrimitive{radius, 1000}, {{}, {0, 0, from + 500}});
}

ResultLines with_ends(const ClashModel& m, const std::string& within = "5mm") {
  return run_rules(
             m.model,
             "[defaults]\nclearance = '10mm'\n[[connected]]\nname = 'joints'\nends_within = '" +
                 within + "'")
      .reported.at(0);
}

ResultLines without(const ClashModel& m) {
  return run_rules(m.model, "[defaults]\nclearance = '10mm'").reported.at(0);
}

TEST(RulesEnds, AGapOfFourMillimetresIsAJointAndOneOfSixIsNot) {
  ClashModel four, six;
  pipe(pipe(four, "a", 0), "b", 1004);
  pipe(pipe(six, "a", 0), "b", 1006);
  EXPECT_EQ(without(four), (ResultLines{"a-b CLEARANCE_VIOLATION"}));
  EXPECT_EQ(with_ends(four), ResultLines{});
  EXPECT_EQ(with_ends(six), (ResultLines{"a-b CLEARANCE_VIOLATION"}));
  EXPECT_EQ(with_ends(six, "6mm"), ResultLines{});
  const auto outcome = run_rules(
      four.model, "[defaults]\nclearance = '10mm'\n[[connected]]\nname = 'x'\nends_within = '5mm'");
  EXPECT_EQ(exempted(outcome.reports.at(0)), (test::Counts{{"x", 1}}));
  EXPECT_TRUE(outcome.diagnostics.kept().empty());
}

TEST(RulesEnds, APipeThatReachesIntoTheNextByLessIsAJoint) {
  ClashModel little, much;
  pipe(pipe(little, "a", 0), "b", 996);
  pipe(pipe(much, "a", 0), "b", 994);
  EXPECT_EQ(without(little), (ResultLines{"a-b HIT"}));
  EXPECT_EQ(with_ends(little), ResultLines{});
  EXPECT_EQ(with_ends(much), (ResultLines{"a-b HIT"}));
}

TEST(RulesEnds, AnElbowAndItsTwoPipes) {
  ClashModel m;
  m.object("elbow").body(CircularTorusPrimitive{150, 50, std::numbers::pi / 2});
  m.object("first").body(CylinderPrimitive{50, 1000}, {kAlongY, {150, -498, 0}});
  m.object("second").body(CylinderPrimitive{50, 1000}, {kAlongX, {-498, 150, 0}});
  EXPECT_EQ(without(m), (ResultLines{"elbow-first HIT", "elbow-second HIT"}));
  EXPECT_EQ(with_ends(m), ResultLines{});
}

TEST(RulesEnds, AReducerJoinsUnlikeDiameters) {
  ClashModel m;
  pipe(m, "wide", 0);
  m.object("reducer").body(SnoutPrimitive{50, 25, 200, 25, 0}, {{}, {12.5, 0, 1098}});
  m.object("narrow").body(CylinderPrimitive{25, 1000}, {{}, {25, 0, 1696}});
  EXPECT_EQ(without(m), (ResultLines{"wide-reducer HIT", "reducer-narrow HIT"}));
  EXPECT_EQ(with_ends(m), ResultLines{});
}

/// The end of a branch in the middle of a run, on its axis and in its wall.
TEST(RulesEnds, AnEndInTheMiddleOfAnotherStaysAClash) {
  for (const double from : {0.0, 45.0}) {
    ClashModel m;
    pipe(m, "run", 0);
    m.object("branch").body(CylinderPrimitive{20, 1000}, {kAlongX, {from + 500, 0, 500}});
    EXPECT_EQ(with_ends(m, "50mm"), (ResultLines{"run-branch HIT"})) << from;
  }
  // In the middle of a plate, whose ends are its short edges, and of a wall that is a mesh.
  ClashModel walls;
  walls.object("plate").body(geometry::BoxPrimitive{1000, 800, 10});
  walls.box("wall", {-500, 2000, -5}, {500, 3000, 5});
  pipe(walls, "post", 3);
  walls.object("other").body(CylinderPrimitive{50, 1000}, {{}, {0, 2500, 503}});
  EXPECT_EQ(with_ends(walls), (ResultLines{"plate-post HIT", "wall-other HIT"}));
}

TEST(RulesEnds, PipesSideBySideAndCopiesStayClashes) {
  ClashModel m;
  pipe(pipe(m, "a", 0), "a2", 0);
  m.object("b").body(CylinderPrimitive{50, 1000}, {{}, {90, 0, 500}});
  EXPECT_EQ(with_ends(m), (ResultLines{"a-a2 HIT", "a-b HIT", "a2-b HIT"}));
}

/// A round body along z, by its radius, from a height to another.
ClashModel& round(ClashModel& m, const std::string& id, double radius, double from, double to,
                  double x = 0) {
  return m.object(id).body(CylinderPrimitive{radius, to - from}, {{}, {x, 0, (from + to) / 2}});
}

/// A copy, the one in the other or side by side, shorter than the length: the top of the one is
/// opposed to the bottom of the other, one body away.
TEST(RulesEnds, ShortBodiesInOnePlaceStayClashes) {
  struct Case {
    double radius, from, to, other_radius, other_from, other_to, x;
    const char* within;
  };
  const std::vector<Case> cases{
      {80, 0, 3, 80, 0, 3, 0, "5mm"},      // a gasket twice
      {80, 0, 3, 60, .5, 2.5, 0, "5mm"},   // a disc in a disc
      {30, 0, 5, 20, .5, 4.5, 0, "5mm"},   // a nipple in a sleeve
      {30, 0, 15, 30, 0, 15, 10, "20mm"},  // spools side by side
      {80, 0, 20, 80, 3, 23, 0, "25mm"},   // flanges, the one moved along
      {80, 0, 20, 80, 0, 20, 3, "25mm"},   // and aside
      {50, 0, 500, 50, 0, 500, 0, "1m"},
  };
  for (const Case& c : cases) {
    ClashModel m;
    round(m, "a", c.radius, c.from, c.to);
    round(m, "b", c.other_radius, c.other_from, c.other_to, c.x);
    EXPECT_EQ(with_ends(m, c.within), (ResultLines{"a-b HIT"})) << c.to << ' ' << c.other_to;
  }
}

TEST(RulesEnds, AMirroredCopyInOnePlaceStaysAClash) {
  ClashModel m;
  m.object("a").body(test::cylinder_mesh(50, 500, 2, 16));
  m.object("b").again({{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, -1}}}, {0, 0, 500}});
  EXPECT_EQ(with_ends(m, "1m"), (ResultLines{"a-b HIT"}));
}

/// A valve of two bodies end to end, and its copy: their seams coincide.
TEST(RulesEnds, ACopyOfAnObjectOfSeveralBodiesStaysAClash) {
  ClashModel m;
  for (const char* const id : {"a", "b"}) {
    round(m, id, 80, 0, 20);
    m.body(SnoutPrimitive{50, 25, 100}, {{}, {0, 0, 70}});
    m.body(CylinderPrimitive{60, 0}, {{}, {0, 0, 20}});
  }
  round(m, "pipe", 25, 119, 500);
  EXPECT_EQ(with_ends(m), (ResultLines{"a-b HIT"}));
}

/// A gasket that is part of each of two ducts, and a coupling that both are put into halfway.
TEST(RulesEnds, RingsAndCouplingsAtAJointLeaveItOne) {
  ClashModel rings;
  round(rings, "a", 50, 0, 500).body(CylinderPrimitive{52, 3}, {{}, {0, 0, 501.5}});
  round(rings, "b", 50, 500, 1000).body(CylinderPrimitive{52, 3}, {{}, {0, 0, 498.5}});
  EXPECT_EQ(without(rings), (ResultLines{"a-b HIT"}));
  EXPECT_EQ(with_ends(rings), ResultLines{});
  ClashModel coupled;
  round(round(coupled, "a", 50, 0, 500), "b", 50, 500, 1000);
  round(coupled, "coupling", 55, 496, 504);
  EXPECT_EQ(with_ends(coupled), ResultLines{});
}

TEST(RulesEnds, FacetedPipesJoinByTheirCaps) {
  ClashModel m;
  m.object("a").body(test::cylinder_mesh(50, 1000, 2, 16));
  m.object("b").again({{}, {0, 0, 998}});
  pipe(m, "c", 1996);
  m.object("branch").body(test::cylinder_mesh(20, 500, 2, 16), {kAlongX, {10, 0, 500}});
  EXPECT_EQ(without(m), (ResultLines{"a-b HIT", "a-branch HIT", "b-c HIT"}));
  EXPECT_EQ(with_ends(m), (ResultLines{"a-branch HIT"}));
}

TEST(RulesEnds, OnlyAmongWhatIsSelected) {
  ClashModel m;
  pipe(pipe(pipe(m, "a", 0), "b", 998), "c", 1996);
  const auto among = [&](const std::string& selection) {
    return run_rules(m.model, "[[connected]]\nname = 'x'\nends_within = '5mm'\namong = \"" +
                                  selection + "\"")
        .reported.at(0);
  };
  EXPECT_EQ(among("a or b"), (ResultLines{"b-c HIT"}));
  EXPECT_EQ(among("a or c"), (ResultLines{"a-b HIT", "b-c HIT"}));
}

TEST(RulesEnds, ARuleThatJoinsNothingIsNamed) {
  ClashModel m;
  pipe(pipe(m, "a", 0), "b", 1500);
  const std::string rule = "[[connected]]\nname = 'x'\nends_within = '5mm'";
  EXPECT_EQ(warned(run_rules(m.model, rule).diagnostics, "rule-matches-nothing"),
            "r.toml, line 1: [[connected]] 'x': no two of 4 ends meet\n");
  ClashModel boxes;
  boxes.box("a", {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(warned(run_rules(boxes.model, rule).diagnostics, "rule-matches-nothing"),
            "r.toml, line 1: [[connected]] 'x': no object has an end that is known\n");
}

TEST(RulesEnds, FaultsNamePlaceCauseAndMend) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"ends_within = '2m'", "'ends_within' of [[connected]] 'x' is more than a metre"},
      {"ends_within = 5", "a length with its unit in quotes"},
      {"ends_within = '-5mm'", "'ends_within' of [[connected]] 'x' is negative"},
      {"ends_within = '-5mm'", "from 0 to 1m, as \"5mm\""},
      {"ends_within = '2km'", "from 0 to 1m, as \"5mm\""},
      {"ends_within = '5mm'\nhead = 'HREF'", "'ends_within' and 'head' in one [[connected]]"},
      {"ends_within = '5mm'\nby = 'node'", "write two tables, each with a name"},
      {"", "or ends_within = \"5mm\""},
  };
  for (const auto& [key, stated] : faults) {
    const auto rules = Rules::parse("[[connected]]\nname = 'x'\n" + key + "\n", "r.toml");
    ASSERT_FALSE(rules) << key;
    EXPECT_NE(rules.error().text().find(stated), std::string::npos) << rules.error().text();
  }
}

}  // namespace
}  // namespace strake::rules
