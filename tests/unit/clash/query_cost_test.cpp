// SPDX-License-Identifier: Apache-2.0
// What a pair may cost, in counts, which hold on any machine. bench_clash_pairs has the times.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "strake/clash/clash.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rotations.hpp"
#include "support/tube_mesh.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;
using test::kTurn;

const Mat3d kTwist{{Vec3d{0.8, -0.6, 0}, Vec3d{0.6, 0.8, 0}, Vec3d{0, 0, 1}}};

struct MeasuredClash {
  Pair pair;
  Counters work;
  std::size_t triangles = 0;
};

MeasuredClash measure(TriangleMesh a, TriangleMesh b, const Placement& at, const Options& options) {
  MeasuredClash measured;
  measured.triangles = a.triangles.size() + b.triangles.size();
  ClashModel m;
  m.object("a").body(std::move(a), {at.linear, {}});
  m.object("b").body(std::move(b), at);
  const Report report = m.detect(options);
  measured.work = report.counters;
  if (!report.pairs.empty()) measured.pair = report.pairs.front();
  return measured;
}

TEST(QueryCost, CopiesAtOnePlaceCostOnePair) {
  const auto copies = [](int count) {
    ClashModel m;
    m.object("0").body(test::cylinder_mesh(30, 80, 2, 24), {kTurn, {}});
    for (int i = 1; i < count; ++i) m.object(std::to_string(i)).again({kTurn, {}});
    return m.detect();
  };
  const Report two = copies(2), many = copies(400);
  ASSERT_EQ(two.pairs.size(), 1U);
  ASSERT_EQ(many.pairs.size(), 400U * 399 / 2);
  EXPECT_EQ(many.counters.triangle_pairs, two.counters.triangle_pairs);
  EXPECT_EQ(many.counters.depth_cells, two.counters.depth_cells);
  for (const Pair& p : many.pairs) {
    EXPECT_EQ(p.cls, Class::hit);
    EXPECT_EQ(p.relation, Relation::duplicate);
    EXPECT_EQ(p.d_mm, two.pairs[0].d_mm);
  }
}

/// A frame of a ship again and again: each has the answers of the first, at its own place.
TEST(QueryCost, RepeatedFramesHaveTheAnswersOfTheFirst) {
  ClashModel m;
  constexpr int kFrames = 50;
  for (int i = 0; i < kFrames; ++i) {
    const Placement at{kTurn, {700.0 * i, 31.0 * i, 0}};
    const std::string number = std::to_string(100 + i);
    if (i == 0)
      m.object("beam" + number).body(test::box_mesh({0, 0, 0}, {300, 20, 10}), at);
    else
      m.object("beam" + number).body_of(0, at);
    if (i == 0)
      m.object("pipe" + number).body(test::box_mesh({50, 5, -40}, {60, 15, 43}), at);
    else
      m.object("pipe" + number).body_of(1, at);
  }
  const Report report = m.detect();
  ASSERT_EQ(report.pairs.size(), static_cast<std::size_t>(kFrames));
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    const Pair &p = report.pairs[i], &first = report.pairs[0];
    EXPECT_EQ(p.cls, first.cls);
    EXPECT_EQ(p.d_mm, first.d_mm);
    EXPECT_EQ(p.away, first.away);
    EXPECT_NEAR(p.point_mm.x - first.point_mm.x, 700.0 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(p.point_mm.y - first.point_mm.y, 31.0 * static_cast<double>(i), 1e-6);
  }
}

TEST(QueryCost, RotatedPlatesCostTheSameAtEveryGap) {
  for (const double gap : {1.005, 1.5, 2.0, 5.0, 10.0, 30.0, 100.0}) {
    ClashModel m;
    m.object("a").body(test::box_mesh({-5000, -5000, -13}, {5000, 5000, 0}), {kTurn, {}});
    m.object("b").body(test::box_mesh({-5000, -5000, gap}, {5000, 5000, gap + 13}),
                       {kTurn * kTwist, {}});
    const Report report = m.detect({.tolerances = {.clearance_mm = 200}});
    ASSERT_EQ(report.pairs.size(), 1U) << gap;
    EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation) << gap;
    EXPECT_NEAR(report.pairs[0].d_mm, gap, 0.003);
    EXPECT_LE(report.counters.triangle_pairs, 144U) << gap;
    EXPECT_LE(report.counters.exact_fallbacks, 12U) << gap;
    // Without anybody to ask how far, a parting plane is all it takes.
    if (gap > 1.1) {
      EXPECT_EQ(m.detect().counters.triangle_pairs, 0U) << gap;
    }
  }
}

TEST(QueryCost, ConcentricSpheresCostAFewTrianglePairsATriangle) {
  for (const double inner : {995.0, 999.0, 500.0}) {
    const MeasuredClash l = measure(test::sphere_mesh(1000, 50), test::sphere_mesh(inner, 50),
                                    {kTurn, {}}, {.tolerances = {.clearance_mm = 25}});
    EXPECT_EQ(l.pair.cls, Class::hit);
    EXPECT_EQ(l.pair.relation, Relation::b_in_a);
    EXPECT_LE(l.work.triangle_pairs, 10 * l.triangles) << inner;
    EXPECT_LE(l.work.exact_fallbacks, l.triangles / 4) << inner;
    EXPECT_EQ(l.work.depth_cells, 0U) << inner;
    EXPECT_LT(l.pair.d_upper_mm - l.pair.d_lower_mm, 0.01);
  }
}

TEST(QueryCost, ConcentricCylindersCostAFewTrianglePairsATriangle) {
  const MeasuredClash l =
      measure(test::cylinder_mesh(500, 2000, 40, 80), test::cylinder_mesh(499, 1998, 40, 80),
              {kTurn, kTurn * Vec3d{0, 0, 1}}, {.tolerances = {.clearance_mm = 25}});
  EXPECT_EQ(l.pair.relation, Relation::b_in_a);
  EXPECT_LE(l.work.triangle_pairs, 10 * l.triangles);
  EXPECT_EQ(l.work.depth_cells, 0U);
}

/// A tube of long facets without bands.
TriangleMesh tube_mesh(double outer, double inner, double height, std::uint32_t sectors) {
  return test::tube<TriangleMesh>(sectors, outer, inner, 0, height,
                                  [](double x, double y, double z) { return Vec3d{x, y, z}; });
}

/// A pipe in its sleeve, askew: boxes along the axes tell nothing of their facets.
TEST(QueryCost, TubesInTubesCostAFewTrianglePairsATriangle) {
  for (const std::uint32_t sectors : {360U, 1000U, 2000U}) {
    const double slack = 102 * (1 - std::cos(std::numbers::pi / sectors)) + 0.003;
    const MeasuredClash l =
        measure(tube_mesh(100, 90, 1000, sectors), tube_mesh(120, 102, 1000, sectors - 1),
                {kTurn, kTurn * Vec3d{0, 0, 1}}, {.tolerances = {.clearance_mm = 10}});
    EXPECT_EQ(l.pair.cls, Class::clearance_violation) << sectors;
    EXPECT_NEAR(l.pair.d_mm, 2, slack) << sectors;
    EXPECT_LE(l.work.triangle_pairs, 32 * l.triangles) << sectors;
  }
}

TEST(QueryCost, AWideClearanceCostsAFewTrianglePairsATriangle) {
  const TriangleMesh hills = test::bumpy_mesh(100, 12, 4, 10);
  for (const double clearance : {110.0, 200.0, 300.0, 1000.0}) {
    const MeasuredClash l = measure(hills, hills, {kTurn, kTurn * Vec3d{318, 11, 0}},
                                    {.tolerances = {.clearance_mm = clearance}});
    EXPECT_EQ(l.pair.cls, Class::clearance_violation) << clearance;
    EXPECT_EQ(l.pair.regions, 1U) << clearance;
    EXPECT_LE(l.work.triangle_pairs, 16 * l.triangles) << clearance;
  }
}

TEST(QueryCost, FansOfNeedlesCostAFewTrianglePairsATriangle) {
  struct Fans {
    const char* name;
    Vec3d at;
    Class cls;
    double d_mm;
  };
  for (const std::uint32_t sectors : {1000U, 5000U})
    for (const Fans& fans : {Fans{"touching", {0, 0, 10}, Class::contact, 0},
                             Fans{"touching aside", {100, 170, 10}, Class::contact, 0},
                             Fans{"apart", {0, 0, 13}, Class::clearance_violation, 3},
                             Fans{"apart aside", {100, 170, 13}, Class::clearance_violation, 3},
                             Fans{"within", {0, 0, 2}, Class::hit, -5},
                             Fans{"flush within", {0, 0, 0}, Class::hit, -5}})
      for (const bool askew : {false, true}) {
        SCOPED_TRACE(std::string(fans.name) + ", " + std::to_string(sectors) +
                     (askew ? " sides, turned" : " sides"));
        const Mat3d turn = askew ? kTurn : Mat3d{};
        TriangleMesh a = test::cylinder_mesh(500, 10, 1, sectors);
        for (Vec3d& v : a.vertices) v = turn * v;
        TriangleMesh b = test::cylinder_mesh(400, fans.d_mm < 0 ? 6 : 10, 1, sectors);
        for (Vec3d& v : b.vertices) v = turn * (v + fans.at);
        const MeasuredClash l =
            measure(std::move(a), std::move(b), {}, {.tolerances = {.clearance_mm = 25}});
        EXPECT_EQ(l.pair.cls, fans.cls);
        EXPECT_LE(l.pair.d_lower_mm, fans.d_mm + 0.002);
        EXPECT_GE(l.pair.d_upper_mm, fans.d_mm - 0.002);
        EXPECT_LE(l.pair.d_upper_mm - l.pair.d_lower_mm, 0.01);
        EXPECT_LE(l.work.triangle_pairs, 12 * l.triangles);
      }
}

TEST(QueryCost, CopiesOfABodyNeedNoWalk) {
  const TriangleMesh hills = test::bumpy_mesh(1000, 60, 12, 40);
  const MeasuredClash l = measure(hills, hills, {}, {.tolerances = {.clearance_mm = 25}});
  EXPECT_EQ(l.pair.relation, Relation::duplicate);
  EXPECT_EQ(l.work.triangle_pairs, 0U);
  // The work limit, and what the last surface comes in.
  EXPECT_LE(l.work.depth_cells, 1100U);
  EXPECT_LE(l.pair.d_lower_mm, -940);
  EXPECT_GE(l.pair.d_upper_mm, -960);
}

TEST(QueryCost, TheSearchForTheDepthEnds) {
  const TriangleMesh hills = test::bumpy_mesh(1000, 60, 12, 40);
  for (const Vec3d& at : {Vec3d{900, 300, 100}, Vec3d{1992, 20, 10}, Vec3d{2050, 0, 0}}) {
    const MeasuredClash l =
        measure(hills, hills, {kTurn, at}, {.tolerances = {.clearance_mm = 25}});
    EXPECT_LE(l.work.depth_cells, 3001U);
    EXPECT_LE(l.work.triangle_pairs, 8 * l.triangles);
  }
}

/// The hull of a tank tells nothing of what stands in it: a move as far as it is deep does.
TEST(QueryCost, WhatIsSunkIntoTheBottomOfACavityNeedsNoSearch) {
  for (const std::uint32_t sectors : {24U, 48U, 360U})
    for (const bool askew : {false, true}) {
      SCOPED_TRACE(std::to_string(sectors) + (askew ? " sides, turned" : " sides"));
      const Mat3d turn = askew ? kTurn : Mat3d{};
      const auto stand = [&](double radius, double height, double z) {
        TriangleMesh m = test::cylinder_mesh(radius, height, 1, sectors);
        for (Vec3d& v : m.vertices) v = turn * (v + Vec3d{0, 0, z});
        return m;
      };
      TriangleMesh tank = stand(1500, 3101, 0);
      const TriangleMesh cavity = stand(1100, 3000, 50);
      const auto first = static_cast<std::uint32_t>(tank.vertices.size());
      tank.vertices.insert(tank.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
      for (const auto& t : cavity.triangles)
        tank.triangles.push_back({first + t[0], first + t[2], first + t[1]});
      const MeasuredClash l = measure(stand(1000, 2800, 45), std::move(tank), {}, {});
      EXPECT_EQ(l.pair.cls, Class::hit);
      EXPECT_NEAR(l.pair.d_mm, -5, 0.002);
      EXPECT_LE(l.pair.d_upper_mm - l.pair.d_lower_mm, 0.01);
      EXPECT_EQ(l.work.depth_cells, 0U);
    }
}

TEST(QueryCost, FlushFacesOfATurnedModelNeedNoSearch) {
  ClashModel m;
  m.object("deck").body(test::box_mesh({0, 0, -12}, {6000, 4000, 0}), {kTurn, {}});
  for (int i = 0; i < 20; ++i)
    m.object("box " + std::to_string(i))
        .body(test::box_mesh({i * 300.0, 100, 0}, {i * 300.0 + 200, 900, 700}), {kTurn, {}});
  const Report report = m.detect();
  EXPECT_EQ(report.count_contact, 20U);
  EXPECT_EQ(report.counters.depth_cells, 0U);
  for (const Pair& p : report.pairs) {
    EXPECT_LE(p.d_upper_mm - p.d_lower_mm, 0.01);
    EXPECT_EQ(p.relation, Relation::abut_outside);
  }
}

}  // namespace
}  // namespace strake::clash
