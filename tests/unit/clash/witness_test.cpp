// SPDX-License-Identifier: Apache-2.0
// Where a separation is measured: closest points, deepest points, and the way out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "support/clash_model.hpp"
#include "support/rotations.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::Vec3d;
using test::ClashModel;
using test::kTurn;

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

void expect_near(const Vec3d& x, const Vec3d& y, double within = 1e-9) {
  EXPECT_LE(norm(x - y), within) << x.x << ' ' << x.y << ' ' << x.z << " against " << y.x << ' '
                                 << y.y << ' ' << y.z;
}

/// Millimetres that the point between askew faces may be less deep than the deepest.
constexpr double kAskew = 4e-3;

/// What must hold for every witness, whatever the bodies.
void expect_sound(const Pair& p, double askew = 0) {
  const double slack = 1e-4 + askew + 2e-6 * std::fabs(p.d_mm) + (p.d_upper_mm - p.d_lower_mm);
  EXPECT_NEAR(norm(p.on_b_mm - p.on_a_mm), std::fabs(p.d_mm), slack);
  if (p.d_mm >= 0) {
    expect_near(p.point_mm, (p.on_a_mm + p.on_b_mm) * 0.5, 1e-6);
  } else {
    expect_near(p.point_mm, p.deep_in_a ? p.on_b_mm : p.on_a_mm);
  }
  if (p.d_mm == 0) return;
  EXPECT_NEAR(norm(p.away), 1, 1e-12);
  // Apart, a moves farther away; otherwise the way out is the way to go.
  const Vec3d way = (p.on_b_mm - p.on_a_mm) * (p.d_mm < 0 ? 1 : -1);
  EXPECT_NEAR(dot(way, p.away), std::fabs(p.d_mm), slack);
}

TEST(Witness, OfWallsApartTouchingAndOverlapping) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {200, 3000, 3000}).box("b", {210, 0, 0}, {400, 3000, 3000});
  const Report apart = m.detect({.tolerances = {.clearance_mm = 25}});
  ASSERT_EQ(apart.pairs.size(), 1U);
  expect_sound(apart.pairs[0]);
  EXPECT_EQ(apart.pairs[0].on_a_mm.x, 200);
  EXPECT_EQ(apart.pairs[0].on_b_mm.x, 210);
  expect_near(apart.pairs[0].away, {-1, 0, 0});

  ClashModel t;
  t.box("a", {0, 0, 0}, {200, 3000, 3000}).box("b", {200, 0, 0}, {400, 3000, 3000});
  const Report touch = t.detect();
  ASSERT_EQ(touch.pairs.size(), 1U);
  EXPECT_EQ(touch.pairs[0].on_a_mm, touch.pairs[0].on_b_mm);
  EXPECT_EQ(touch.pairs[0].away, Vec3d{});

  ClashModel o;
  o.box("a", {0, 0, 0}, {200, 3000, 3000}).box("b", {150, 0, 0}, {400, 3000, 3000});
  const Report overlap = o.detect();
  ASSERT_EQ(overlap.pairs.size(), 1U);
  expect_sound(overlap.pairs[0]);
  EXPECT_NEAR(overlap.pairs[0].d_mm, -50, 1e-3);
  expect_near(overlap.pairs[0].away, {-1, 0, 0});
  EXPECT_NEAR(overlap.pairs[0].point_mm.y, 1500, 1);
  EXPECT_NEAR(overlap.pairs[0].point_mm.z, 1500, 1);
}

Pair only_pair(const ClashModel& m) {
  const Report report = m.detect();
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? Pair{} : report.pairs[0];
}

Vec3d turned_back(const Mat3d& turn, const Vec3d& v) {
  return turn.row[0] * v.x + turn.row[1] * v.y + turn.row[2] * v.z;
}

/// Two boxes, turned or not and far away or not, overlap with a middle that is known; of two faces
/// that are as deep it may be on either.
void expect_middle(const Vec3d& lo_a, const Vec3d& hi_a, const Vec3d& lo_b, const Vec3d& hi_b,
                   const Vec3d& middle, int across, double depth, double within = 0.1) {
  for (const Mat3d& turn : {Mat3d{}, kTurn})
    for (const Vec3d& there : {Vec3d{}, Vec3d{200'000, -70'000, 3'000}}) {
      ClashModel m;
      m.object("a").body(test::box_mesh(lo_a, hi_a), {turn, there});
      m.object("b").body(test::box_mesh(lo_b, hi_b), {turn, there});
      const Pair p = only_pair(m);
      EXPECT_NEAR(p.d_mm, -depth, 0.01);
      expect_sound(p, turn == Mat3d{} ? 0 : kAskew);
      Vec3d at = turned_back(turn, p.point_mm - there);
      at[across] = middle[across];
      expect_near(at, middle, within);
    }
}

TEST(Witness, OfFacesEquallyDeepIsTheirMiddle) {
  {
    SCOPED_TRACE("walls in line, short along y");
    expect_middle({0, 0, 0}, {200, 140, 3000}, {150, 0, 0}, {400, 140, 3000}, {150, 70, 1500}, 0,
                  50);
  }
  {
    SCOPED_TRACE("walls that cross");
    expect_middle({0, 0, 0}, {3000, 200, 3000}, {1000, -2000, 0}, {1200, 2000, 3000},
                  {1100, 100, 1500}, 1, 100);
  }
  {
    SCOPED_TRACE("slabs on each other");
    expect_middle({0, 0, 0}, {1000, 300, 100}, {0, 0, 90}, {1000, 300, 190}, {500, 150, 90}, 2, 10);
  }
  {
    SCOPED_TRACE("slabs beside each other");
    expect_middle({0, 0, 0}, {1000, 300, 100}, {700, 100, 95}, {2000, 500, 190}, {850, 200, 95}, 2,
                  5, 3.6);
  }
  {
    SCOPED_TRACE("a beam in a wall");
    expect_middle({0, 0, 0}, {6000, 200, 3000}, {1000, 50, 1000}, {5000, 150, 1100},
                  {3000, 100, 1050}, 1, 100);
  }
  {
    SCOPED_TRACE("the same box twice");
    expect_middle({0, 0, 0}, {100, 4000, 700}, {0, 0, 0}, {100, 4000, 700}, {50, 2000, 350}, 0, 50);
  }
}

/// A bar with an I for its section, along x from 0.
geometry::TriangleMesh profile(double length) {
  const std::vector<std::array<double, 2>> outline{
      {-100, -100}, {100, -100}, {100, -80}, {10, -80}, {10, 80},   {100, 80},
      {100, 100},   {-100, 100}, {-100, 80}, {-10, 80}, {-10, -80}, {-100, -80}};
  geometry::TriangleMesh mesh;
  for (const double x : {0.0, length})
    for (const auto& [y, z] : outline) mesh.vertices.push_back({x, y, z});
  const std::vector<geometry::Triangle> cap{{0, 1, 2},  {0, 2, 11}, {2, 3, 11}, {3, 10, 11},
                                            {3, 4, 10}, {4, 9, 10}, {4, 5, 9},  {5, 8, 9},
                                            {5, 6, 8},  {6, 7, 8}};
  for (const auto& [i, j, k] : cap) {
    mesh.triangles.push_back({i, k, j});
    mesh.triangles.push_back({i + 12, j + 12, k + 12});
  }
  for (std::uint32_t i = 0; i < 12; ++i) {
    const std::uint32_t j = (i + 1) % 12;
    mesh.triangles.push_back({i, j, j + 12});
    mesh.triangles.push_back({i, j + 12, i + 12});
  }
  return mesh;
}

TEST(Witness, OfProfilesIsInTheMiddleOfTheirLength) {
  for (const Mat3d& turn : {Mat3d{}, kTurn}) {
    ClashModel m;
    m.object("a").body(profile(6000), {turn, {}});
    m.object("b").body(profile(8000), {turn, turn * Vec3d{1000, 30, 12}});
    const Pair p = only_pair(m);
    expect_sound(p);
    const Vec3d at = turned_back(turn, p.point_mm);
    EXPECT_NEAR(at.x, 3500, 1) << at.y << ' ' << at.z;
  }
}

TEST(Witness, OfPrimitivesIsInTheMiddle) {
  using geometry::BoxPrimitive, geometry::CylinderPrimitive, geometry::Primitive;
  const auto pair_of = [](const Primitive& a, const Primitive& b, const Vec3d& at,
                          const Mat3d& of_b, const Mat3d& turn) {
    ClashModel m;
    m.object("a").body(a, {turn, {}}).object("b").body(b, {turn * of_b, turn * at});
    Pair p = only_pair(m);
    expect_sound(p);
    p.point_mm = turned_back(turn, p.point_mm);
    return p;
  };
  const Mat3d along_x{{Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}}};
  for (const Mat3d& turn : {Mat3d{}, kTurn}) {
    // A pipe through a wall.
    Pair p = pair_of(BoxPrimitive{200, 3000, 3000}, CylinderPrimitive{57, 2000}, {0, 400, 700},
                     along_x, turn);
    EXPECT_NEAR(p.d_mm, -100, 0.01);
    expect_near(p.point_mm, {0, 400, 700}, 0.5);
    // A pipe that runs along in a wall.
    p = pair_of(BoxPrimitive{200, 3000, 3000}, CylinderPrimitive{57, 2000}, {110, 100, 800}, {},
                turn);
    EXPECT_NEAR(p.point_mm.y, 100, 0.5);
    EXPECT_NEAR(p.point_mm.z, 673.5, 0.5);  // its end is no less than so deep
    // Pipes side by side.
    p = pair_of(CylinderPrimitive{57, 4000}, CylinderPrimitive{80, 3000}, {110, 0, 1000}, {}, turn);
    EXPECT_NEAR(p.point_mm.z, 750, 14);
    // Pipes in line, one a little in the other.
    p = pair_of(CylinderPrimitive{80, 4000}, CylinderPrimitive{57, 3000}, {0, 0, 3490}, {}, turn);
    EXPECT_NEAR(p.d_mm, -10, 0.01);
    expect_near({p.point_mm.x, p.point_mm.y, 0}, {}, 0.5);
  }
}

TEST(Witness, OfABoxInABoxLeadsToTheNearestWall) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {1000, 2000, 3000}).box("b", {900, 900, 900}, {950, 950, 950});
  const Report report = m.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  const Pair& p = report.pairs[0];
  EXPECT_NEAR(p.d_mm, -100, 1e-3);
  EXPECT_TRUE(p.deep_in_a);
  expect_sound(p);
  EXPECT_NEAR(p.surface_mm().x, 1000, 1e-3);
  EXPECT_NEAR(p.away.x, -1, 1e-9);
}

TEST(Witness, OfAPlateThroughABoxPushesOutOfTheBox) {
  ClashModel m;
  m.box("box", {0, 0, 0}, {1000, 1000, 1000});
  m.object("plate").body(geometry::TriangleMesh{
      {{500, 500, 950}, {1500, 500, 950}, {500, 1500, 950}, {1500, 1500, 950}},
      {{0, 1, 3}, {0, 3, 2}},
      {},
      0});
  const Report report = m.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  const Pair& p = report.pairs[0];
  expect_sound(p);
  EXPECT_TRUE(p.deep_in_a);
  EXPECT_NEAR(p.surface_mm().z, 1000, 1e-3);
  EXPECT_NEAR(p.away.z, -1, 1e-9);
}

TEST(Witness, OfCrossingSheetsHasNoWayOut) {
  ClashModel m;
  const auto sheet = [](const Vec3d& u, const Vec3d& v) {
    const Vec3d o = (u + v) * -0.5;
    return geometry::TriangleMesh{{o, o + u, o + u + v, o + v}, {{0, 1, 2}, {0, 2, 3}}, {}, 0};
  };
  m.object("a").body(sheet({1000, 0, 0}, {0, 1000, 0}));
  m.object("b").body(sheet({1000, 0, 0}, {0, 0, 1000}));
  const Report report = m.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::hit);
  EXPECT_EQ(report.pairs[0].away, Vec3d{});
  EXPECT_EQ(report.pairs[0].on_a_mm, report.pairs[0].point_mm);
}

using DrawInt = std::function<double(int, int)>;

/// A body of any kind that can clash.
model::Shape any_shape(std::mt19937_64& random, const DrawInt& draw) {
  using geometry::Primitive;
  switch (random() % 10) {
    case 0:
      return Primitive{geometry::SpherePrimitive{draw(20, 90)}};
    case 1:
      return Primitive{geometry::CylinderPrimitive{draw(10, 60), draw(20, 150)}};
    case 2:
      return Primitive{geometry::BoxPrimitive{draw(20, 90), draw(20, 90), draw(9, 90)}};
    case 3:
      return Primitive{geometry::PyramidPrimitive{draw(30, 90), draw(30, 90), draw(0, 60),
                                                  draw(5, 60), draw(-20, 20), draw(-20, 20),
                                                  draw(20, 90)}};
    case 4:
      return Primitive{
          geometry::SnoutPrimitive{draw(20, 60), draw(5, 40), draw(30, 90), draw(-20, 20), 0}};
    case 5:
      return Primitive{geometry::EllipticalDishPrimitive{draw(20, 60), draw(10, 50)}};
    case 6:
      return Primitive{geometry::SphericalDishPrimitive{draw(30, 60), draw(5, 28)}};
    case 7:
      return Primitive{geometry::CircularTorusPrimitive{draw(40, 70), draw(8, 30), 1.5}};
    case 8:
      return Primitive{
          geometry::RectangularTorusPrimitive{draw(20, 40), draw(50, 90), draw(10, 60), 2.5}};
    default: {
      const Vec3d half{draw(10, 50), draw(10, 50), draw(10, 50)};
      return test::box_mesh(-half, half);
    }
  }
}

/// Whether a ball of a hundredth of a millimetre meets the body of one object of a model.
bool meets_ball(const ClashModel& m, std::size_t object, const Vec3d& at) {
  ClashModel probe;
  probe.model.shapes = m.model.shapes;
  model::Object body = m.model.objects[object];
  const model::Body placed = m.model.bodies[object];
  body.first_body = 0;
  probe.model.objects.push_back(body);
  probe.model.bodies.push_back(placed);
  probe.object("probe").body(geometry::Primitive{geometry::SpherePrimitive{0.02}}, {{}, at});
  return !probe.detect({.tolerances = {.touch_gap_mm = 0, .touch_overlap_mm = 0}}).pairs.empty();
}

/// Every kind against every kind, turned, in every relation: moved away by d and a little more, the
/// deepest point is out of the body whose skin it was measured to.
TEST(Witness, LeadsOutOfTheBody) {
  int deep = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    std::mt19937_64 random(seed);
    const DrawInt draw = [&](int lo, int hi) {
      return static_cast<double>(lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo)));
    };
    const Placement feature_a{random() % 2 == 0 ? kTurn : Mat3d{}, {}};
    const Placement feature_b{random() % 2 == 0 ? kTurn : Mat3d{},
                              {draw(-70, 70), draw(-70, 70), draw(-70, 70)}};
    ClashModel m;
    m.object("a").body(any_shape(random, draw), feature_a);
    m.object("b").body(any_shape(random, draw), feature_b);
    const Report report = m.detect({.tolerances = {.clearance_mm = 60}});
    if (report.pairs.empty()) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pair& p = report.pairs[0];
    expect_sound(p, kAskew);
    if (p.d_mm > 0) ++apart;
    if (p.d_mm > -2) continue;
    ++deep;
    // Beyond what the bracket leaves open and what a tessellation cuts off.
    const double beyond = 0.6 + (p.d_upper_mm - p.d_lower_mm);
    const Vec3d to = p.point_mm + (p.surface_mm() - p.point_mm) * (1 - beyond / p.d_mm);
    EXPECT_FALSE(meets_ball(m, p.deep_in_a ? 0 : 1, to)) << "d " << p.d_mm;
  }
  EXPECT_GT(deep, 100);
  EXPECT_GT(apart, 100);
}

/// Which of the two is called a is a matter of names: the witness is mirrored, bit by bit.
TEST(Witness, SwappedNamesMirrorIt) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const auto corner = [&](int reach) {
      const auto draw = [&] {
        return static_cast<double>(static_cast<int>(random() % 100) - reach);
      };
      return Vec3d{draw(), draw(), draw()};
    };
    const Vec3d lo_a = corner(80), lo_b = corner(80);
    const Vec3d hi_a = lo_a + Vec3d{20, 30, 40} + corner(0),
                hi_b = lo_b + Vec3d{35, 25, 15} + corner(0);
    ClashModel m, n;
    m.box("a", lo_a, hi_a).box("b", lo_b, hi_b);
    n.box("a", lo_b, hi_b).box("b", lo_a, hi_a);
    const Report x = m.detect({.tolerances = {.clearance_mm = 50}}),
                 y = n.detect({.tolerances = {.clearance_mm = 50}});
    ASSERT_EQ(x.pairs.size(), y.pairs.size());
    if (x.pairs.empty()) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_EQ(x.pairs[0].d_mm, y.pairs[0].d_mm);
    EXPECT_EQ(x.pairs[0].on_a_mm, y.pairs[0].on_b_mm);
    EXPECT_EQ(x.pairs[0].on_b_mm, y.pairs[0].on_a_mm);
    EXPECT_EQ(x.pairs[0].away, -y.pairs[0].away);
    EXPECT_EQ(x.pairs[0].point_mm, y.pairs[0].point_mm);
    EXPECT_EQ(x.pairs[0].deep_in_a != y.pairs[0].deep_in_a, x.pairs[0].d_mm < 0);
  }
}

}  // namespace
}  // namespace strake::clash
