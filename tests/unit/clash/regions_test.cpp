// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "support/clash_model.hpp"
#include "support/meshes.hpp"
#include "support/voxels.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Vec3d;
using test::box_mesh;
using test::ClashModel;

/// One closed mesh: a square bar bent twice by right angles, up, across and down again.
geometry::TriangleMesh bridge(double half, double span, double height) {
  geometry::TriangleMesh mesh;
  const auto ring = [&](double x, double z, double dx, double dz) {
    mesh.vertices.insert(mesh.vertices.end(), {{x - dx * half, -half, z - dz * half},
                                               {x + dx * half, -half, z + dz * half},
                                               {x + dx * half, half, z + dz * half},
                                               {x - dx * half, half, z - dz * half}});
  };
  ring(0, 0, 1, 0);
  ring(0, height, 1, -1);
  ring(span, height, -1, -1);
  ring(span, 0, -1, 0);
  for (std::uint32_t r = 0; r < 3; ++r)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t p = 4 * r + i, q = 4 * r + (i + 1) % 4;
      mesh.triangles.push_back({p, q, q + 4});
      mesh.triangles.push_back({p, q + 4, p + 4});
    }
  for (std::uint32_t i = 1; i < 3; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({12, 12 + i, 13 + i});
  }
  return mesh;
}

/// Four legs and a top, each a part, or with `sunk` one leg 5 mm into the deck.
ClashModel table_on_deck(double sunk) {
  ClashModel made;
  made.box("deck", {-500, -500, -10}, {2000, 2000, 0});
  made.object("table").body(box_mesh({0, 0, 700}, {1000, 600, 720}));
  for (const double x : {0.0, 940.0})
    for (const double y : {0.0, 540.0})
      made.body(box_mesh({x, y, x > 0 && y > 0 ? -sunk : 0}, {x + 60, y + 60, 700}));
  model::finish(made.model);
  return made;
}

TEST(RegionsTest, FourFeetAreFourContacts) {
  const Report report = table_on_deck(0).detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::contact);
  EXPECT_EQ(report.pairs[0].regions, 4U);
  ASSERT_EQ(report.regions.size(), 4U);
  for (const Region& r : report.regions) {
    EXPECT_EQ(r.cls, Class::contact);
    EXPECT_EQ(r.d_mm, 0);
    EXPECT_NEAR(r.box_mm.hi.x - r.box_mm.lo.x, 62, 0.1);
    EXPECT_NEAR(r.point_mm.z, 0, 1e-9);
  }
}

TEST(RegionsTest, TheWorstComesFirstAndListsEndWhileCountsDoNot) {
  Options options;
  options.engine.max_regions = 2;
  const Report report = table_on_deck(5).detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::hit);
  EXPECT_EQ(report.pairs[0].regions, 4U);
  ASSERT_EQ(report.regions.size(), 2U);
  EXPECT_EQ(report.regions[0].cls, Class::hit);
  EXPECT_NEAR(report.regions[0].d_mm, -5, 1e-6);
  EXPECT_EQ(report.regions[0].d_mm, report.pairs[0].d_mm);
  EXPECT_EQ(report.regions[0].point_mm, report.pairs[0].point_mm);
  EXPECT_EQ(report.regions[1].cls, Class::contact);
  options.engine.max_regions = 0;
  const Report without = table_on_deck(5).detect(options);
  EXPECT_EQ(without.pairs[0].regions, 0U);
  EXPECT_TRUE(without.regions.empty());
  EXPECT_EQ(without.pairs[0].d_mm, report.pairs[0].d_mm);
}

/// A count that is no count would be worse than none.
TEST(RegionsTest, TheBaselineDistinguishesNoPlaces) {
  Options options;
  options.engine.narrow_phase = NarrowPhase::sphere_subdivision;
  const Report report = table_on_deck(5).detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].regions, 0U);
  EXPECT_EQ(report.options.engine.max_regions, 0U);
}

TEST(RegionsTest, OneMeshThatMeetsTwoBarsHasADepthAtEach) {
  ClashModel made;
  made.object("pipe").body(bridge(40, 800, 600));
  made.object("wall").body(box_mesh({-20, -200, 100}, {30, 200, 110}));
  made.body(box_mesh({820, -200, 100}, {836, 200, 110}));
  model::finish(made.model);
  const Report report = made.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  ASSERT_EQ(report.pairs[0].regions, 2U);
  ASSERT_EQ(report.regions.size(), 2U);
  // Deepest is what lies farthest from the pipe's sides: the middle of the one leg, and 20 mm off
  // the side of the other.
  EXPECT_NEAR(report.regions[0].d_mm, -40, 0.01);
  EXPECT_NEAR(report.regions[1].d_mm, -20, 0.01);
  EXPECT_LT(report.regions[0].point_mm.x, 100);
  EXPECT_GT(report.regions[1].point_mm.x, 700);
}

TEST(RegionsTest, OneMeshThatMeetsOnePlateTwiceHasADepthAtEach) {
  ClashModel made;
  made.object("pipe").body(bridge(40, 800, 600));
  made.object("wall").body(box_mesh({-200, -200, 100}, {1200, 200, 110}));
  model::finish(made.model);
  const Report report = made.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  ASSERT_EQ(report.pairs[0].regions, 2U);
  for (const Region& r : report.regions) {
    EXPECT_EQ(r.cls, Class::hit);
    EXPECT_NEAR(r.d_mm, -40, 1);
    EXPECT_LE(r.d_lower_mm, r.d_mm);
    EXPECT_GE(r.d_upper_mm, r.d_mm);
    EXPECT_TRUE(r.box_mm.contains({r.point_mm, r.point_mm}));
  }
  EXPECT_GT(std::fabs(report.regions[0].point_mm.x - report.regions[1].point_mm.x), 700);
}

/// Parts that hang together meet in one place, however many they are.
TEST(RegionsTest, PartsOfOneObjectThatHangTogetherAreOnePlace) {
  ClashModel made;
  made.box("deck", {0, 0, 0}, {1000, 1000, 10});
  made.object("bar");
  for (const double x : {100.0, 200.0, 300.0})
    made.body(box_mesh({x, 100, -50}, {x + 100, 150, 50}));
  model::finish(made.model);
  const Report report = made.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].regions, 1U);
  EXPECT_TRUE(report.regions.empty());
}

TEST(RegionsTest, ClearanceHasPlacesToo) {
  ClashModel made;
  made.box("deck", {0, 0, 0}, {1000, 1000, 10});
  made.object("feet");
  made.body(box_mesh({100, 100, 20}, {150, 150, 500}));
  made.body(box_mesh({700, 100, 25}, {750, 150, 500}));
  model::finish(made.model);
  Options options;
  options.tolerances.clearance_mm = 30;
  const Report report = made.detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation);
  ASSERT_EQ(report.pairs[0].regions, 2U);
  EXPECT_EQ(report.regions[0].d_mm, 10);
  EXPECT_EQ(report.regions[1].d_mm, 15);
}

/// A rule that allows the one foot does not hide the other.
TEST(RegionsTest, AnAllowedContactIsAllowedAtItsPlaceAlone) {
  ClashModel made;
  made.object("pipe").body(bridge(40, 800, 600));
  made.object("wall").body(box_mesh({-200, -200, 100}, {1200, 200, 110}));
  model::finish(made.model);
  const model::Scene scene =
      make_scene(made.model, scene_options(Options{}), parallel::Context{}).value();
  const auto check = [&](const geometry::Box3d& region) {
    Policy policy;
    policy.allowed = {{"sleeve", {true, true}, {true, true}, region, {}, 100}};
    return detect(scene, one_set(scene), {}, policy, {}).value();
  };
  const Report one = check({{-200, -200, 0}, {200, 200, 200}});
  EXPECT_EQ(one.count_hit, 1U);
  ASSERT_EQ(one.pairs.size(), 1U);
  EXPECT_LT(one.pairs[0].allowed, 0);
  EXPECT_GT(one.pairs[0].point_mm.x, 700);
  EXPECT_EQ(one.pairs[0].regions, 1U);
  // What it allows there is counted and listed all the same.
  EXPECT_EQ(one.pairs[0].allowed_regions, 1U);
  EXPECT_EQ(one.count_allowed_regions, 1U);
  EXPECT_EQ(one.count_allowed, 0U);
  EXPECT_EQ(one.allowed[0].regions, 1U);
  EXPECT_EQ(one.allowed[0].pairs, 0U);
  ASSERT_EQ(one.regions.size(), 1U);
  EXPECT_EQ(one.regions[0].allowed, 0);
  EXPECT_EQ(one.regions[0].cls, Class::hit);
  EXPECT_LT(one.regions[0].point_mm.x, 100);
  const Report both = check({{-200, -200, 0}, {1200, 200, 200}});
  EXPECT_EQ(both.count_hit, 0U);
  EXPECT_EQ(both.count_allowed, 1U);
  EXPECT_EQ(both.pairs[0].regions, 2U);
  EXPECT_EQ(both.pairs[0].allowed_regions, 0U);
  EXPECT_EQ(both.regions[1].allowed, 0);
  // The places are known to lie within: nothing is uncertain.
  EXPECT_EQ(both.pairs[0].flags & kUncertain, 0);
}

/// A bar through three plates of one object: as many rules as plates, and the one in the middle.
TEST(RegionsTest, PlacesThatRulesAllowAreCountedByRule) {
  ClashModel made;
  made.box("bar", {0, 0, 0}, {1000, 20, 20});
  made.object("plates");
  for (const double x : {100.0, 500.0, 900.0})
    made.body(box_mesh({x, -200, -200}, {x + 10, 200, 200}));
  model::finish(made.model);
  const model::Scene scene =
      make_scene(made.model, scene_options(Options{}), parallel::Context{}).value();
  const auto rule = [](const char* name, double from, double to) {
    return Allowed{name, {true, true}, {true, true}, Box3d{{from, -200, -200}, {to, 200, 200}},
                   {},   100};
  };
  Policy policy;
  policy.allowed = {rule("first", 0, 200), rule("last", 800, 1000), rule("shadow", 800, 1000)};
  Options options;
  const Report all = detect(scene, one_set(scene), options, policy, {}).value();
  ASSERT_EQ(all.pairs.size(), 1U);
  EXPECT_LT(all.pairs[0].allowed, 0);
  EXPECT_EQ(all.pairs[0].regions, 1U);
  EXPECT_EQ(all.pairs[0].allowed_regions, 2U);
  EXPECT_EQ(all.allowed[0].regions, 1U);
  EXPECT_EQ(all.allowed[1].regions, 1U);
  EXPECT_EQ(all.allowed[2].regions, 0U);
  EXPECT_EQ(all.count_allowed_regions, 2U);
  EXPECT_EQ(all.pairs[0].allowed_regions_listed(options), 2U);
  // The count does not depend on what is listed, nor on whether places are.
  for (const std::uint64_t most : {1U, 0U}) {
    options.engine.max_regions = most;
    const Report some = detect(scene, one_set(scene), options, policy, {}).value();
    EXPECT_EQ(some.pairs[0].allowed_regions, 2U);
    EXPECT_EQ(some.pairs[0].regions, most);
    EXPECT_EQ(some.regions.size(), most);
    EXPECT_EQ(some.count_allowed_regions, 2U);
  }
  // The hash covers them: another rule, another hash.
  policy.allowed[0].rule = "renamed";
  options.engine.max_regions = 8;
  const Report renamed = detect(scene, one_set(scene), options, policy, {}).value();
  EXPECT_NE(renamed.hash, all.hash);
  // An allowed hit besides a gap that is none: the result is the gap, the hit is counted.
  ClashModel gap;
  gap.box("bar", {0, 0, 0}, {1000, 20, 20});
  gap.object("plates").body(box_mesh({100, -200, -200}, {110, 200, 200}));
  gap.body(box_mesh({1010, -200, -200}, {1020, 200, 200}));
  model::finish(gap.model);
  const model::Scene near =
      make_scene(gap.model, scene_options(Options{}), parallel::Context{}).value();
  options.tolerances.clearance_mm = 25;
  const Report open = detect(near, one_set(near), options, policy, {}).value();
  ASSERT_EQ(open.pairs.size(), 1U);
  EXPECT_EQ(open.pairs[0].cls, Class::clearance_violation);
  EXPECT_EQ(open.pairs[0].allowed_regions, 1U);
}

/// A block from z = 0 to 10 on a square of side `a`, about a square hole of half width `h` round
/// (a / 2, a / 2).
geometry::TriangleMesh holed_plate(double a, double h) {
  geometry::TriangleMesh plate;
  const auto ring = [&](double lo, double hi) {
    for (const double z : {0.0, 10.0})
      plate.vertices.insert(plate.vertices.end(),
                            {{lo, lo, z}, {hi, lo, z}, {hi, hi, z}, {lo, hi, z}});
  };
  ring(0, a);                  // 0 to 3 below, 4 to 7 above
  ring(a / 2 - h, a / 2 + h);  // the hole: 8 to 11 and 12 to 15
  const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t t) {
    plate.triangles.push_back({p, q, r});
    plate.triangles.push_back({p, r, t});
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    quad(i, j, 4 + j, 4 + i);            // outer side
    quad(8 + i, 12 + i, 12 + j, 8 + j);  // of the hole
    quad(4 + i, 4 + j, 12 + j, 12 + i);  // above
    quad(i, 8 + i, 8 + j, j);            // below
  }
  return plate;
}

// A hole or a groove is small beside a large plate, and parts the contact all the same.
TEST(RegionsTest, AHoleInALargePlatePartsAContact) {
  const double a = 2500;
  for (const double gap : {0.0, 0.5}) {
    SCOPED_TRACE(gap);
    ClashModel made;
    made.object("plate").body(holed_plate(a, 10));
    made.box("strip", {a / 2 - 5, 1000, 10 + gap}, {a / 2 + 5, 1500, 30});
    model::finish(made.model);
    const Report report = made.detect();
    ASSERT_EQ(report.pairs.size(), 1U);
    EXPECT_EQ(report.pairs[0].cls, Class::contact);
    EXPECT_EQ(report.pairs[0].regions, 2U);
  }
}

// Both faces of a plate and both skins of a tube lie within the clearance, one behind the other.
TEST(RegionsTest, WhatLiesBehindTheSkinWithinTheClearanceIsNoOtherPlace) {
  Options options;
  options.tolerances.clearance_mm = 30;
  ClashModel over;
  over.object("deck").body(holed_plate(2500, 10));
  over.box("crate", {100, 100, 15}, {600, 600, 400});
  model::finish(over.model);
  Report report = over.detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation);
  EXPECT_EQ(report.pairs[0].regions, 1U);

  // A square tube that points with its edges at the sides of a square hole, 5 mm before each; the
  // edges inside are 10 mm behind.
  std::vector<geometry::Vec3i> cubes;
  for (int x = -3; x < 3; ++x)
    for (int y = -3; y < 3; ++y)
      for (int z = -10; z < 10; ++z)
        if (x == -3 || x == 2 || y == -3 || y == 2) cubes.push_back({x, y, z});
  geometry::TriangleMesh tube = test::voxel_mesh(cubes, 5);
  for (Vec3d& v : tube.vertices) v = {100 + v.x - v.y, 100 + v.x + v.y, v.z};
  ClashModel through;
  through.object("plate").body(holed_plate(200, 35));
  through.object("tube").body(tube);
  model::finish(through.model);
  options.tolerances.clearance_mm = 18;
  report = through.detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation);
  EXPECT_EQ(report.pairs[0].d_mm, 5);
  EXPECT_EQ(report.pairs[0].regions, 4U);
}

/// What is allowed at one arm of a fork does not hide that the other is too near.
TEST(RegionsTest, AGapAcrossFromAHitIsAPlaceOfItsOwn) {
  std::vector<geometry::Vec3i> cubes;
  for (int z = 0; z < 10; ++z)
    for (const int x : {0, 3}) cubes.emplace_back(x, 0, z);
  cubes.emplace_back(1, 0, 0);
  cubes.emplace_back(2, 0, 0);
  ClashModel made;
  made.object("fork").body(test::voxel_mesh(cubes, 10));
  made.box("bar", {-20, 2, 62}, {8, 8, 78});  // ends inside the one arm
  model::finish(made.model);
  const model::Scene scene =
      make_scene(made.model, scene_options(Options{}), parallel::Context{}).value();
  Options options;
  options.tolerances.clearance_mm = 25;
  Policy policy;
  policy.allowed = {
      {"sleeve", {true, true}, {true, true}, Box3d{{-30, -10, 50}, {12, 20, 90}}, {}, 100}};
  const Report report = detect(scene, one_set(scene), options, policy, {}).value();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation);
  EXPECT_NEAR(report.pairs[0].d_mm, 22, 1e-6);
}

/// What listing regions must not change.
auto answers(const Report& report) {
  std::vector<std::tuple<Class, Relation, std::uint16_t, double, double, double, Vec3d, Vec3d>> all;
  for (const Pair& p : report.pairs)
    all.emplace_back(p.cls, p.relation, p.flags, p.d_mm, p.d_lower_mm, p.d_upper_mm, p.point_mm,
                     p.away);
  return all;
}

TEST(RegionsTest, ListingPlacesChangesNoAnswer) {
  Options without;
  without.engine.max_regions = 0;
  for (const double sunk : {0.0, 5.0}) {
    const ClashModel table = table_on_deck(sunk);
    EXPECT_EQ(answers(table.detect()), answers(table.detect(without)));
  }
}

/// One shell of 5 mm cubes: a square ring round a pin that is 30 mm long below the plane z = 0,
/// both under one cap. The box of the ring holds the pin.
geometry::TriangleMesh ring_and_pin(int ring_bottom) {
  std::vector<geometry::Vec3i> cubes;
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -6; z <= 3; ++z) {
        const bool ring = std::max(std::abs(x), std::abs(y)) == 4 && z >= ring_bottom;
        const bool pin = std::max(std::abs(x), std::abs(y)) <= 1;
        if (ring || pin || z >= 2) cubes.push_back({x, y, z});
      }
  return test::voxel_mesh(cubes, 5);
}

/// Turned about an odd axis, so that nothing is flush with the coordinate planes.
geometry::TriangleMesh askew(geometry::TriangleMesh mesh) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vec3d& v : mesh.vertices) {
    v = {v.x * c - v.y * s, v.x * s + v.y * c, v.z};
    v = {v.x, v.y * c - v.z * s, v.y * s + v.z * c};
  }
  return mesh;
}

Report ring_and_pin_in_plate(int ring_bottom, double top, bool turned) {
  ClashModel made;
  const geometry::TriangleMesh plate = box_mesh({-100, -100, -200}, {100, 100, top});
  const geometry::TriangleMesh stamp = ring_and_pin(ring_bottom);
  made.object("plate").body(turned ? askew(plate) : plate);
  made.object("stamp").body(turned ? askew(stamp) : stamp);
  model::finish(made.model);
  return made.detect();
}

TEST(RegionsTest, APlaceRoundAnotherHasItsOwnDepth) {
  for (const bool turned : {false, true}) {
    SCOPED_TRACE(turned);
    const Report report = ring_and_pin_in_plate(-1, 0, turned);
    ASSERT_EQ(report.pairs.size(), 1U);
    ASSERT_EQ(report.pairs[0].regions, 2U);
    EXPECT_NEAR(report.regions[0].d_mm, -30, 0.01);
    EXPECT_NEAR(report.regions[1].d_mm, -5, 0.01);
    EXPECT_EQ(report.regions[1].cls, Class::hit);
    EXPECT_LE(report.regions[1].d_lower_mm, -4.99);
  }
}

/// Points of the pin, in the box of the ring, are not what is asked about there.
TEST(RegionsTest, APlaceOfASheetRoundAnotherHasItsOwnDepth) {
  ClashModel made;
  geometry::TriangleMesh stamp = ring_and_pin(-1);
  stamp.triangles.pop_back();
  ASSERT_GT(stamp.vertices[stamp.triangles.back()[0]].z, 0);
  made.object("plate").body(box_mesh({-100, -100, -200}, {100, 100, 0}));
  made.object("stamp").body(stamp);
  model::finish(made.model);
  const Report report = made.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  ASSERT_EQ(report.pairs[0].regions, 2U);
  ASSERT_EQ(report.regions.size(), 2U);
  EXPECT_NEAR(report.regions[0].d_mm, -30, 0.01);
  EXPECT_NEAR(report.regions[1].d_mm, -5, 0.01);
  EXPECT_GE(report.regions[1].d_lower_mm, -5.2);
}

TEST(RegionsTest, AGapRoundAHitIsAGap) {
  for (const bool turned : {false, true}) {
    SCOPED_TRACE(turned);
    const Report report = ring_and_pin_in_plate(0, -0.5, turned);
    ASSERT_EQ(report.pairs.size(), 1U);
    ASSERT_EQ(report.pairs[0].regions, 2U);
    EXPECT_NEAR(report.regions[0].d_mm, -29.5, 0.01);
    const Region& gap = report.regions[1];
    EXPECT_EQ(gap.cls, Class::contact);
    EXPECT_NEAR(gap.d_mm, 0.5, 0.01);
    EXPECT_NEAR(gap.d_lower_mm, 0.5, 0.01);
    EXPECT_EQ(gap.flags & kUncertain, 0);
  }
}

}  // namespace
}  // namespace strake::clash
