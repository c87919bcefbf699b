// SPDX-License-Identifier: Apache-2.0
// Lines as bodies without thickness, in the whole engine: with EngineOptions::curves only.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/expect_pair.hpp"

namespace strake::clash {
namespace {

using geometry::Placement;
using geometry::Vec3d;
using test::ClashModel;
using test::expect;

Options with_curves() { return {.engine = {.curves = Curves::on}}; }

geometry::Polylines chain(const std::vector<Vec3d>& points) {
  geometry::Polylines lines;
  lines.points = points;
  lines.first = {0, static_cast<std::uint32_t>(points.size())};
  return lines;
}

/// A 1 m cube as a mesh and a line.
ClashModel cube_and_line(const std::vector<Vec3d>& points) {
  ClashModel m;
  m.box("cube", {0, 0, 0}, {1000, 1000, 1000}).object("line").body(chain(points));
  return m;
}

Pair evaluated(const ClashModel& m) { return test::only(m, with_curves()); }

TEST(Curves, AreOffUnlessRequested) {
  const ClashModel m = cube_and_line({{-500, 500, 500}, {1500, 500, 500}});
  EXPECT_TRUE(m.detect({}).pairs.empty());
  EXPECT_EQ(m.detect(with_curves()).pairs.size(), 1U);
}

TEST(Curves, ALineThroughACubeIsAsDeepAsItsMiddle) {
  const Pair p = evaluated(cube_and_line({{-500, 500, 300}, {1500, 500, 300}}));
  expect(p, Class::hit, Relation::cross, -300, 0.01);
  // The deepest point, and out through the nearest face.
  EXPECT_NEAR(p.point_mm.z, 300, 0.01);
  EXPECT_NEAR(p.surface_mm().z, 0, 0.01);
  EXPECT_NEAR(std::fabs(p.away.z), 1, 1e-9);
}

TEST(Curves, ClassesFollowTheThresholds) {
  expect(evaluated(cube_and_line({{200, 200, 1000}, {800, 200, 1000}})), Class::contact,
         Relation::abut_outside, 0, 0.002);
  expect(evaluated(cube_and_line({{200, 200, 1000.7}, {800, 200, 1000.7}})), Class::contact,
         Relation::separate, 0.7);
  expect(evaluated(cube_and_line({{200, 200, 999.5}, {800, 200, 999.5}})), Class::contact,
         Relation::b_in_a, -0.5, 0.01);
  const ClashModel near = cube_and_line({{200, 200, 1020}, {800, 200, 1020}});
  EXPECT_EQ(evaluated(near).cls, Class::no_hit);
  Options clearance = with_curves();
  clearance.tolerances.clearance_mm = 25;
  const Pair p = test::only(near, clearance);
  expect(p, Class::clearance_violation, Relation::separate, 20);
  EXPECT_NEAR(p.on_a_mm.z, 1000, 1e-6);
  EXPECT_NEAR(p.on_b_mm.z, 1020, 1e-6);
}

TEST(Curves, ALineInsideIsInside) {
  expect(evaluated(cube_and_line({{300, 500, 500}, {700, 500, 500}, {700, 600, 500}})), Class::hit,
         Relation::b_in_a, -500, 10.1);
  // Ending on the skin it is not wholly inside.
  EXPECT_EQ(evaluated(cube_and_line({{0, 500, 500}, {700, 500, 500}})).relation, Relation::cross);
}

TEST(Curves, APipesOwnCentreLineInAnotherObject) {
  ClashModel m;
  m.object("pipe").body(geometry::Primitive{geometry::CylinderPrimitive{50, 2000}});
  m.object("line").body(geometry::Primitive{geometry::LinePrimitive{1, 2000}});
  const Pair p = evaluated(m);
  expect(p, Class::hit, Relation::cross, -50, 0.001);
  EXPECT_EQ(p.flags, 0);
  EXPECT_LE(p.d_upper_mm - p.d_lower_mm, 0.001);
}

TEST(Curves, ThinPlatesAreHitByTheCapLikeAnythingElse) {
  ClashModel m;
  m.box("plate", {0, 0, 0}, {1000, 1000, 1.5})
      .object("line")
      .body(chain({{500, 500, -100}, {500, 500, 100}}));
  expect(evaluated(m), Class::hit, Relation::cross, -0.75, 0.01);
}

/// Two triangles without thickness.
geometry::TriangleMesh sheet() {
  return {{{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {0, 1000, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, -1};
}

TEST(Curves, ALineThroughASheetCountsToTheNearestRimOrEnd) {
  const auto through = [](const std::vector<Vec3d>& points) {
    ClashModel m;
    m.object("sheet").body(sheet()).object("line").body(chain(points));
    return evaluated(m);
  };
  const Pair rim = through({{300, 200, -500}, {300, 200, 900}});
  expect(rim, Class::hit, Relation::cross, -200);
  EXPECT_NE(rim.flags & kOpen, 0);
  EXPECT_EQ(rim.point_mm, (Vec3d{300, 200, 0}));
  expect(through({{300, 400, -500}, {300, 400, 120}}), Class::hit, Relation::cross, -120);
  // Through a corner of the line, and through the sheet's inner edge.
  expect(through({{300, 200, -500}, {300, 200, 0}, {310, 210, 700}}), Class::hit, Relation::cross,
         -200);
  expect(through({{400, 400, -500}, {400, 400, 500}}), Class::hit, Relation::cross, -400);
  // What ends on it, turns back at it or runs along it does not pass through it.
  expect(through({{300, 200, 500}, {300, 200, 0}}), Class::contact, Relation::abut_outside, 0);
  expect(through({{300, 200, 500}, {300, 200, 0}, {400, 200, 500}}), Class::contact,
         Relation::abut_outside, 0);
  expect(through({{-100, 200, 0}, {1100, 300, 0}}), Class::contact, Relation::abut_outside, 0);
  expect(through({{300, 200, 500}, {300, 200, 0.5}}), Class::contact, Relation::separate, 0.5);
}

TEST(Curves, LinesAmongThemselvesTouchAtMost) {
  const auto lines = [](const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
    ClashModel m;
    m.object("a").body(chain(a)).object("b").body(chain(b));
    return evaluated(m);
  };
  expect(lines({{0, 0, 0}, {100, 0, 0}}, {{50, -50, 0}, {50, 50, 0}}), Class::contact,
         Relation::abut_outside, 0);
  expect(lines({{0, 0, 0}, {100, 0, 0}}, {{0, 0, 0}, {100, 0, 0}}), Class::contact,
         Relation::duplicate, 0);
  expect(lines({{0, 0, 0}, {100, 0, 0}}, {{50, -50, 0.8}, {50, 50, 0.8}}), Class::contact,
         Relation::separate, 0.8);
  EXPECT_EQ(lines({{0, 0, 0}, {100, 0, 0}}, {{50, -50, 8}, {50, 50, 8}}).cls, Class::no_hit);
}

/// A scene with all of it: the same bytes for teams, swapped sets and either broad phase, and the
/// results between bodies as without lines.
TEST(Curves, ChangeNothingElseAndDependOnNothing) {
  ClashModel m;
  for (int i = 0; i < 12; ++i) {
    const double x = 137.0 * i;
    const std::string n = std::to_string(i);
    m.box("box" + n, {x, 0, 0}, {x + 150, 100, 100});
    m.object("pipe" + n)
        .body(geometry::Primitive{geometry::CylinderPrimitive{30, 400}},
              {{}, {x + 40, 50, 20.0 * i}});
    m.object("line" + n).body(chain({{x, 50, -10.0 * i}, {x + 170, 60, 90}, {x, 10, 300}}));
    m.object("elbow" + n)
        .body(geometry::Primitive{geometry::CircularTorusPrimitive{90, 20, 1.5}},
              {{}, {x, 100, 50}});
  }
  const Report with = m.detect(with_curves()), without = m.detect({});
  EXPECT_GT(with.pairs.size(), without.pairs.size() + 20);
  std::size_t same = 0;
  for (const Pair& p : with.pairs)
    for (const Pair& q : without.pairs)
      same += p.a == q.a && p.b == q.b && p.d_mm == q.d_mm && p.cls == q.cls ? 1 : 0;
  EXPECT_EQ(same, without.pairs.size());
  Options all = with_curves();
  all.engine.broad_phase = BroadPhase::all_pairs;
  EXPECT_EQ(m.detect(all).hash, with.hash);
  for (const unsigned workers : {2U, 3U, 8U}) {
    parallel::Team team(workers);
    EXPECT_EQ(m.detect(with_curves(), {.team = &team}).hash, with.hash);
  }
}

TEST(Curves, WhichIsCalledAMirrorsTheAnswer) {
  const std::vector<Vec3d> points{{-500, 310, 400}, {700, 290, 350}, {650, 900, 1400}};
  ClashModel line_first;
  line_first.object("a").body(chain(points)).box("cube", {0, 0, 0}, {1000, 1000, 1000});
  const Pair p = evaluated(cube_and_line(points)), q = evaluated(line_first);
  EXPECT_EQ(p.d_mm, q.d_mm);
  EXPECT_EQ(p.d_lower_mm, q.d_lower_mm);
  EXPECT_EQ(p.d_upper_mm, q.d_upper_mm);
  EXPECT_EQ(p.cls, q.cls);
  EXPECT_EQ(p.point_mm, q.point_mm);
  EXPECT_EQ(p.on_a_mm, q.on_b_mm);
  EXPECT_EQ(p.on_b_mm, q.on_a_mm);
  EXPECT_EQ(p.away, -q.away);
  EXPECT_NE(p.deep_in_a, q.deep_in_a);
}

TEST(Curves, TheBaselineKnowsNoLines) {
  const ClashModel m = cube_and_line({{-500, 500, 500}, {1500, 500, 500}});
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  Options options = with_curves();
  options.engine.narrow_phase = NarrowPhase::sphere_subdivision;
  const auto report = detect(scene, one_set(scene), options, {});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace strake::clash
