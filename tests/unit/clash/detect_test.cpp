// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "clash/rules/tolerance_lengths.hpp"
#include "strake/clash/clash.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/expect_pair.hpp"
#include "support/voxels.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::Vec3d;
using test::ClashModel;
using test::expect;
using test::only;

ClashModel two(const Vec3d& lo_a, const Vec3d& hi_a, const Vec3d& lo_b, const Vec3d& hi_b) {
  ClashModel m;
  m.box("a", lo_a, hi_a).box("b", lo_b, hi_b);
  return m;
}

/// Two walls 3,000 mm high and 200 thick, the second `dx` along and `dy` beside the end of the
/// first.
ClashModel walls(double dx, double dy) {
  return two({0, 0, 0}, {5000, 200, 3000}, {5000 + dx, dy, 0}, {10000 + dx, 200 + dy, 3000});
}

TEST(Detect, WallsThatOverlapAreAHitAlsoWhenAligned) {
  expect(only(walls(-50, 0)), Class::hit, Relation::interfere, -50);
  expect(only(walls(-50, 2)), Class::hit, Relation::interfere, -50);
}

TEST(Detect, WallsEndToEnd) {
  const Pair touch = only(walls(0, 0));
  expect(touch, Class::contact, Relation::abut_outside, 0);
  EXPECT_EQ(touch.d_lower_mm, 0);
  EXPECT_EQ(touch.flags, 0);
  EXPECT_EQ(touch.point_mm.x, 5000);
  EXPECT_EQ(only(walls(50, 0)).cls, Class::no_hit);
  expect(only(walls(0.5, 0)), Class::contact, Relation::separate, 0.5);
  expect(only(walls(-0.5, 0)), Class::contact, Relation::interfere, -0.5);
  expect(only(walls(0.003, 0)), Class::contact, Relation::abut_outside, 0.003);
  expect(only(walls(-0.002, 0)), Class::contact, Relation::abut_outside, -0.002);
}

/// Whichever two triangles are looked at first: those of the faces are apart where the boxes
/// overlap.
TEST(Detect, WhatOverlapsWithinTheContactDistanceIsNotApart) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {20.0, 50.0, 100.0, 140.0})
      for (const double deep : {0.001, 0.002}) {
        SCOPED_TRACE(std::to_string(axis) + ", " + std::to_string(side));
        for (const bool below : {false, true}) {
          Vec3d lo{30, 30, 30};
          lo[axis] = below ? deep - side : 100 - deep;
          const Pair pair = only(two({0, 0, 0}, {100, 100, 100}, lo, lo + Vec3d{side, side, side}));
          expect(pair, Class::contact, Relation::abut_outside, -deep);
          EXPECT_LE(pair.d_lower_mm, -deep);
          EXPECT_GE(pair.d_upper_mm, -deep);
          lo[axis] += below ? -2 * deep : 2 * deep;
          EXPECT_NEAR(only(two({0, 0, 0}, {100, 100, 100}, lo, lo + Vec3d{side, side, side})).d_mm,
                      deep, 1e-9);
        }
      }
}

/// A thousand objects at one place are half a million pairs; the memory ends before a million's do.
TEST(Detect, MorePairsThanAllowedAreAnErrorThatStatesWhy) {
  test::ClashModel m;
  for (int i = 0; i < 30; ++i) m.box("b" + std::to_string(i), {0, 0, 0}, {10, 10, 10});
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  for (const BroadPhase broad_phase : {BroadPhase::tree, BroadPhase::all_pairs}) {
    const Options options{.engine = {.broad_phase = broad_phase, .max_pairs = 30 * 29 / 2 - 1}};
    const auto report = detect(scene, one_set(scene), options, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::input);
    EXPECT_NE(report.error().text().find("at one place"), std::string::npos);
  }
}

TEST(Detect, Clearance) {
  const Options options{.tolerances = {.clearance_mm = 25}};
  expect(only(walls(24.9, 0), options), Class::clearance_violation, Relation::separate, 24.9);
  EXPECT_EQ(only(walls(25.1, 0), options).cls, Class::no_hit);
  EXPECT_EQ(only(walls(25.1, 0), options).d_mm, 0) << "NO_HIT pairs are not kept";
  const Pair p = only(walls(10, 0), options);
  EXPECT_EQ(p.point_mm.x, 5005) << "midpoint of the closest pair";
}

TEST(Detect, ThinCrossingPlatesAreAHit) {
  const auto plates = two({0, 0, 0}, {1000, 2, 500}, {499, -500, 0}, {501, 500, 500});
  expect(only(plates), Class::hit, Relation::interfere, -1);
  Options plain;
  plain.tolerances.thickness_cap = ThicknessCap::off;
  // Exactly at the threshold of the plain rule: the severer class, and said so.
  const Pair p = only(plates, plain);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_TRUE(p.flags & kBorderline);
  const auto foil = two({0, 0, 0}, {1000, 0.8, 500}, {499, -500, 0}, {500, 500, 500});
  EXPECT_EQ(only(foil).cls, Class::hit);
  EXPECT_EQ(only(foil, plain).cls, Class::contact);
}

TEST(Detect, NestedAndDuplicate) {
  const auto nested = two({0, 0, 0}, {1000, 1000, 1000}, {400, 400, 300}, {500, 500, 400});
  expect(only(nested), Class::hit, Relation::b_in_a, -400);
  const auto same = two({0, 0, 0}, {100, 100, 100}, {0, 0, 0}, {100, 100, 100});
  expect(only(same), Class::hit, Relation::duplicate, -50);
  const auto inside = two({0, 0, 0}, {100, 100, 100}, {0, 20, 20}, {10, 30, 30});
  EXPECT_EQ(only(inside).relation, Relation::abut_inside);
  EXPECT_EQ(only(inside).cls, Class::hit);
  const auto clear = two({0, 0, 0}, {100, 100, 100}, {0.003, 20, 20}, {10, 30, 30});
  EXPECT_EQ(only(clear).relation, Relation::abut_inside);
  EXPECT_EQ(only(clear, {.contact_distance_mm = 0.0025}).relation, Relation::b_in_a);
}

TEST(Detect, AToleranceOfZeroIsTheStrictDefinition) {
  const Options strict{.tolerances = {.touch_gap_mm = 0, .touch_overlap_mm = 0}};
  EXPECT_EQ(only(walls(0, 0), strict).cls, Class::contact);
  EXPECT_EQ(only(walls(-0.001, 0), strict).cls, Class::hit);
  EXPECT_EQ(only(walls(0.001, 0), strict).cls, Class::no_hit);
}

TEST(Detect, InsideOutSolidIsFoundAndFlagged) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}, true).box("b", {20, 20, 20}, {30, 30, 30});
  const Pair p = only(m);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_EQ(p.relation, Relation::b_in_a);
  EXPECT_TRUE(p.flags & kInverted);
}

geometry::TriangleMesh sheet(const Vec3d& p, const Vec3d& u, const Vec3d& v) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {p, p + u, p + u + v, p + v};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Detect, Sheets) {
  ClashModel m;
  m.object("a").body(sheet({0, 0, 0}, {100, 0, 0}, {0, 100, 0}));
  m.object("b").body(sheet({50, 20, -30}, {0, 60, 0}, {0, 0, 60}));
  Pair p = only(m);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_EQ(p.relation, Relation::cross);
  EXPECT_TRUE(p.flags & kOpen);
  EXPECT_LE(p.d_lower_mm, -30);
  EXPECT_GE(p.d_upper_mm, -30);

  ClashModel solid;
  solid.object("a").body(sheet({0, 0, 0}, {100, 0, 0}, {0, 100, 0}));
  solid.box("b", {40, 40, -20}, {60, 60, 20});
  p = only(solid);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_TRUE(p.flags & kOpen);
  EXPECT_LE(p.d_lower_mm, -10);
  EXPECT_GE(p.d_upper_mm, -10);

  ClashModel laid;
  laid.object("a").body(sheet({0, 0, 20}, {100, 0, 0}, {0, 100, 0}));
  laid.box("b", {40, 40, -20}, {60, 60, 20});
  EXPECT_EQ(only(laid).cls, Class::contact);
}

TEST(Detect, SheetsThatAreWoundToAndFroEndWhereTheyEnd) {
  geometry::TriangleMesh plate = sheet({50, 20, -30}, {0, 60, 0}, {0, 0, 60});
  std::swap(plate.triangles[1][0], plate.triangles[1][1]);
  ClashModel m;
  m.object("a").body(sheet({0, 0, 0}, {100, 0, 0}, {0, 100, 0}));
  m.object("b").body(plate);
  const Pair p = only(m);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_LE(p.d_lower_mm, -30);
  EXPECT_GE(p.d_upper_mm, -30);
  EXPECT_LE(p.d_mm, -29);
}

TEST(Detect, ASheetInTheSamePlaceIsADuplicate) {
  geometry::TriangleMesh tray = test::box_mesh({0, 0, 0}, {100, 100, 100});
  tray.triangles.resize(8);
  const geometry::TriangleMesh flat = sheet({0, 0, 0}, {100, 0, 0}, {0, 100, 0});
  for (const geometry::TriangleMesh& mesh : {tray, flat})
    for (const double aside : {0.0, 0.001}) {
      ClashModel m;
      m.object("a").body(mesh).object("b").body(mesh, {{}, {0, 0, aside}});
      const Pair p = only(m);
      EXPECT_EQ(p.relation, Relation::duplicate) << aside;
      if (aside == 0) expect(p, Class::contact, Relation::duplicate, 0);
    }
  ClashModel other;
  other.object("a").body(flat).object("b").body(sheet({0, 100, 0}, {0, -100, 0}, {100, 0, 0}));
  expect(only(other), Class::contact, Relation::duplicate, 0);
  ClashModel smaller;
  smaller.object("a").body(flat).object("b").body(sheet({0, 0, 0}, {100, 0, 0}, {0, 99, 0}));
  expect(only(smaller), Class::contact, Relation::abut_outside, 0);
}

TEST(Detect, ASheetThatRunsAlongAnotherMayGoThroughIt) {
  ClashModel m;
  geometry::TriangleMesh mesh = sheet({0, 0, 0}, {100, 0, 0}, {0, 60, 0});
  for (const auto& [y, z] : {std::pair{0.0, 50.0}, std::pair{60.0, -50.0}}) {
    const geometry::TriangleMesh web = sheet({0, y, 0}, {100, 0, 0}, {0, 0, z});
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), web.vertices.begin(), web.vertices.end());
    for (const geometry::Triangle& t : web.triangles)
      mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
  m.object("a").body(mesh);
  m.object("b").body(sheet({-100, -100, 0}, {300, 0, 0}, {0, 300, 0}));
  const Pair p = only(m);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_EQ(p.relation, Relation::cross);
  EXPECT_LE(p.d_lower_mm, -50);
  EXPECT_GE(p.d_upper_mm, -50);
}

TEST(Detect, PrimitivesWithAClosedFormHaveNoSag) {
  ClashModel m;
  m.object("a").body(geometry::CylinderPrimitive{100, 3000}, {{}, {0, 0, 0}});
  m.object("b").body(geometry::CylinderPrimitive{80, 2000}, {{}, {178.5, 0, 50}});
  m.object("c").body(geometry::SpherePrimitive{300}, {{}, {5000, 0, 0}});
  m.object("d").body(geometry::SpherePrimitive{100}, {{}, {5030, 0, 0}});
  m.object("e").body(geometry::SpherePrimitive{100}, {{}, {5208, 0, 0}});
  const Report report = m.detect({.tolerances = {.clearance_mm = 20}});
  ASSERT_EQ(report.pairs.size(), 3U);
  expect(report.pairs[0], Class::hit, Relation::interfere, -1.5);
  expect(report.pairs[1], Class::hit, Relation::b_in_a, -150);
  expect(report.pairs[2], Class::clearance_violation, Relation::separate, 8);
  for (const Pair& p : report.pairs) {
    EXPECT_EQ(p.flags, 0);
    EXPECT_LT(p.d_upper_mm - p.d_lower_mm, 1e-3);
  }
  EXPECT_NEAR(report.pairs[2].point_mm.x, 5154, 1e-6);
}

TEST(Detect, WiresAndPartsOfOneObjectNeverClash) {
  ClashModel m;
  geometry::Polylines line;
  line.points = {{-50, 50, 50}, {150, 50, 50}};
  line.first = {0, 2};
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.body(test::box_mesh({50, 0, 0}, {150, 100, 100}));
  m.object("b").body(line);
  EXPECT_TRUE(m.detect().pairs.empty());
}

TEST(Detect, AnObjectIsAsBadAsItsWorstPart) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.object("b").body(test::box_mesh({100, 0, 0}, {200, 100, 100}));
  m.body(test::box_mesh({90, 300, 0}, {200, 400, 100}));
  m.body(test::box_mesh({80, 50, 50}, {300, 60, 60}));
  const Pair p = only(m);
  EXPECT_EQ(p.cls, Class::hit);
  EXPECT_EQ(p.part_b, 2U);
  EXPECT_NEAR(p.d_mm, -20, 1e-6);
}

TEST(Detect, OfPartsThatAreEquallyDeepTheWeightiestRelationCounts) {
  // All 100 mm deep in the block.
  const auto within = test::box_mesh({10, 810, 810}, {100, 900, 900});
  const auto through = test::box_mesh({-100, 100, 100}, {100, 300, 300});
  const auto turned = test::box_mesh({800, 900, 100}, {900, 1100, 300});
  using Parts = std::vector<geometry::TriangleMesh>;
  for (const Parts& parts : {Parts{within, through}, {through, within}, {turned, within}}) {
    ClashModel m;
    m.box("block", {0, 0, 0}, {1000, 1000, 1000}).object("parts");
    for (const auto& part : parts) m.body(part);
    const Report report = m.detect();
    ASSERT_EQ(report.pairs.size(), 1U);
    expect(report.pairs[0], Class::hit, Relation::interfere, -100);
    ASSERT_EQ(report.regions.size(), 2U);
    EXPECT_EQ(report.regions[0].point_mm, report.pairs[0].point_mm);
  }
}

TEST(Detect, NeitherLiesInTheOtherWhereEachHoldsAPartOfTheOther) {
  ClashModel m;
  m.object("a").body(test::box_mesh({0, 0, 0}, {100, 100, 100}));
  m.body(test::box_mesh({1040, 40, 40}, {1060, 60, 60}));
  m.object("b").body(test::box_mesh({40, 40, 40}, {60, 60, 60}));
  m.body(test::box_mesh({1000, 0, 0}, {1100, 100, 100}));
  expect(only(m), Class::hit, Relation::interfere, -50);
}

TEST(Detect, EachLengthOfTheTolerancesHasItsRowInTheTable) {
  Tolerances t;
  double next = 0;
  for (const ToleranceLength& length : kToleranceLengths) t.*length.value_mm = ++next;
  // All members: a new one that is a length wants a row.
  const auto& [clearance, touch_gap, touch_overlap, cap, object_clearances] = t;
  EXPECT_EQ(std::vector({clearance, touch_gap, touch_overlap}), std::vector({1.0, 2.0, 3.0}));
  EXPECT_EQ(cap, ThicknessCap::on);
  EXPECT_EQ(object_clearances, nullptr);
}

TEST(Detect, TolerancesThatMakeNoSenseAreErrors) {
  const ClashModel m = walls(0, 0);
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  const double bad[] = {-1, std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  for (const double v : bad)
    for (const ToleranceLength& length : kToleranceLengths) {
      Options options;
      options.tolerances.*length.value_mm = v;
      const auto report = detect(scene, one_set(scene), options, {});
      ASSERT_FALSE(report);
      EXPECT_EQ(report.error().code, ErrorCode::usage);
    }
  EXPECT_FALSE(detect(scene, {}, {}, {})) << "sets of the wrong size";
}

TEST(Detect, AnEmptySetIsAWarning) {
  const ClashModel m = walls(-50, 0);
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  Sets sets = one_set(scene);
  sets.in_b.assign(2, false);
  const auto report = detect(scene, sets, {}, {});
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->pairs.empty());
  EXPECT_EQ(report->diagnostics.count("empty-set"), 1U);
}

TEST(Detect, SetsAndTheirOrder) {
  ClashModel m;
  for (int i = 0; i < 4; ++i)
    m.box(std::to_string(i), {i * 90.0, 0, 0}, {i * 90.0 + 100, 100, 100});
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  const Sets ab{{true, true, false, false}, {false, true, true, true}};
  const Sets ba{ab.in_b, ab.in_a};
  const Report x = detect(scene, ab, {}, {}).value(), y = detect(scene, ba, {}, {}).value();
  EXPECT_EQ(x.hash, y.hash);
  // 0-1 and 1-2 stand in different sets, 2-3 does not; 0-1 is named once.
  ASSERT_EQ(x.pairs.size(), 2U);
  EXPECT_EQ(model::index(x.pairs[1].b), 2U);
}

TEST(Detect, UnknownSagIsStatedOncePerFile) {
  EXPECT_EQ(walls(0, 0).detect().diagnostics.count("unknown-sag"), 1U);
}

TEST(Detect, StopsWhenRequestedTo) {
  const std::stop_source source;
  source.request_stop();
  const ClashModel m = walls(0, 0);
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  const auto report =
      detect(scene, one_set(scene), {}, {.team = nullptr, .stop = source.get_token()});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::cancelled);
}

/// Boxes, turned boxes and primitives on a coarse lattice: touching, crossing, nested, duplicate.
ClashModel turned_crowd(std::uint64_t seed, int count, const Vec3d& offset = {}) {
  std::mt19937_64 random(seed);
  const auto draw = [&](int n) {
    return static_cast<double>(random() % static_cast<std::uint64_t>(n));
  };
  ClashModel m;
  for (int i = 0; i < count; ++i) {
    Placement at;
    at.translation = offset + Vec3d{draw(8) * 25, draw(8) * 25, draw(4) * 25};
    if (i % 3 == 1) at.linear.row = {Vec3d{0.6, -0.8, 0}, Vec3d{0.8, 0.6, 0}, Vec3d{0, 0, 1}};
    m.object(std::to_string(100 + i));
    if (i % 5 == 4)
      m.body(geometry::CylinderPrimitive{10 + draw(3) * 5, 50}, at);
    else
      m.body(test::box_mesh({0, 0, 0}, {25 + draw(3) * 25, 25, 25 + draw(2) * 25}, i % 7 == 0), at);
  }
  return m;
}

TEST(Detect, SameBytesForAnyTeamAndEitherBroadPhase) {
  const ClashModel m = turned_crowd(3, 200);
  Options options{.tolerances = {.clearance_mm = 5}};
  const Report base = m.detect(options);
  EXPECT_GT(base.count_hit, 50U);
  EXPECT_GT(base.count_contact, 50U);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    EXPECT_EQ(m.detect(options, {.team = &team, .stop = {}}).hash, base.hash);
  }
  options.engine.broad_phase = BroadPhase::all_pairs;
  const Report all = m.detect(options);
  EXPECT_EQ(all.hash, base.hash);
  EXPECT_EQ(all.counters.part_pairs, base.counters.part_pairs);
}

TEST(Detect, OtherObjectsAndTheirOrderDoNotShow) {
  const Report all = turned_crowd(5, 60).detect();
  // Objects in reverse: a and b of each pair change places, and nothing else does.
  ClashModel m = turned_crowd(5, 60);
  std::reverse(m.model.objects.begin(), m.model.objects.end());
  const Report turned = m.detect();
  ASSERT_EQ(turned.pairs.size(), all.pairs.size());
  for (const Pair& p : all.pairs) {
    const auto mirror = std::find_if(turned.pairs.begin(), turned.pairs.end(), [&](const Pair& q) {
      return model::index(q.a) == 59 - model::index(p.b) &&
             model::index(q.b) == 59 - model::index(p.a);
    });
    ASSERT_NE(mirror, turned.pairs.end());
    EXPECT_EQ(mirror->cls, p.cls);
    EXPECT_EQ(mirror->d_mm, p.d_mm);
    EXPECT_EQ(mirror->d_lower_mm, p.d_lower_mm);
    EXPECT_EQ(mirror->d_upper_mm, p.d_upper_mm);
    EXPECT_NEAR(mirror->point_mm.x, p.point_mm.x, 1e-9);
  }
  // Any two alone say what they said in the turned_crowd.
  for (std::size_t i = 0; i < all.pairs.size(); i += 7) {
    const ClashModel pair = turned_crowd(5, 60);
    const model::Scene scene = make_scene(pair.model, scene_options({}), {}).value();
    Sets sets{std::vector<bool>(60, false), std::vector<bool>(60, false)};
    sets.in_a[model::index(all.pairs[i].a)] = sets.in_b[model::index(all.pairs[i].b)] = true;
    const Report alone = detect(scene, sets, {}, {}).value();
    ASSERT_EQ(alone.pairs.size(), 1U);
    EXPECT_EQ(alone.pairs[0].d_mm, all.pairs[i].d_mm);
    EXPECT_EQ(alone.pairs[0].point_mm, all.pairs[i].point_mm);
  }
}

TEST(Detect, MovedByGridStepsNothingChanges) {
  const Report here = turned_crowd(9, 80).detect();
  const Report there = turned_crowd(9, 80, {123456789, -98765432, 5000}).detect();
  ASSERT_EQ(here.pairs.size(), there.pairs.size());
  for (std::size_t i = 0; i < here.pairs.size(); ++i) {
    EXPECT_EQ(here.pairs[i].cls, there.pairs[i].cls);
    EXPECT_EQ(here.pairs[i].relation, there.pairs[i].relation);
    EXPECT_EQ(here.pairs[i].d_mm, there.pairs[i].d_mm);
    EXPECT_EQ(here.pairs[i].flags, there.pairs[i].flags);
  }
}

TEST(Detect, SeparationChangesByNoMoreThanTheMove) {
  const Options options{.tolerances = {.clearance_mm = 1000}};
  double before = 0;
  for (int i = 0; i <= 60; ++i) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 80, 60});
    Placement at;
    at.linear.row = {Vec3d{0.6, -0.8, 0}, Vec3d{0.8, 0.6, 0}, Vec3d{0, 0, 1}};
    at.translation = {-40 + i * 3.0, 20, 30};
    m.object("b").body(test::box_mesh({0, 0, 0}, {50, 40, 70}), at);
    const double d = only(m, options).d_mm;
    if (i > 0) {
      EXPECT_LE(std::fabs(d - before), 3 + 0.02) << "step " << i;
    }
    before = d;
  }
  EXPECT_GT(before, 0);
}

// All corners of the bar lie in the legs of the channel; its middle does not.
TEST(Detect, ABarAcrossASlotInterferes) {
  std::vector<geometry::Vec3i> channel, bar;
  for (int x = -3; x <= 3; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 5; ++z) {
        if (std::abs(x) >= 2 || z == 0) channel.push_back({x, y, z});
        if (std::abs(x) <= 2 && (y == 1 || y == 2) && (z == 2 || z == 3)) bar.push_back({x, y, z});
      }
  ClashModel made;
  made.object("channel").body(test::voxel_mesh(channel, 10));
  made.object("bar").body(test::voxel_mesh(bar, 10));
  model::finish(made.model);
  const Report report = made.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::hit);
  EXPECT_EQ(report.pairs[0].relation, Relation::interfere);
}

}  // namespace
}  // namespace strake::clash
