// SPDX-License-Identifier: Apache-2.0
// How primitives lie in each other, known by construction, turned every way and in either order:
// what is not proven is not said, and the points of an answer lie on the skins.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "support/body_depth.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"
#include "support/random_primitives.hpp"

namespace strake::clash {
namespace {

using geometry::BoxPrimitive;
using geometry::CircularTorusPrimitive;
using geometry::CylinderPrimitive;
using geometry::Mat3d;
using geometry::Placement;
using geometry::Primitive;
using geometry::RectangularTorusPrimitive;
using geometry::SpherePrimitive;
using geometry::Vec3d;

constexpr std::uint64_t kTurns = 6;
constexpr double kFullTurn = 6.283185307179586;
/// Local z along x.
const Mat3d kOnItsSide{{Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}}};

struct PlacedPrimitive {
  Primitive primitive;
  Placement at;

  [[nodiscard]] double depth(const Vec3d& p) const {
    const Vec3d v = p - at.translation;
    const auto& m = at.linear.row;
    return test::depth_in(primitive, m[0] * v.x + m[1] * v.y + m[2] * v.z);
  }
};

PlacedPrimitive placed(const PlacedPrimitive& body, const Placement& frame) {
  Placement at = frame * body.at;
  at.translation = to_mm(geometry::snap(at.translation).value());
  return {body.primitive, at};
}

Pair pair_of(const PlacedPrimitive& a, const PlacedPrimitive& b, const Options& options = {}) {
  test::ClashModel m;
  m.object("a").body(a.primitive, a.at);
  m.object("b").body(b.primitive, b.at);
  const Report report = m.detect(options);
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? Pair{} : report.pairs.front();
}

Relation mirrored(Relation r) {
  if (r == Relation::a_in_b) return Relation::b_in_a;
  return r == Relation::b_in_a ? Relation::a_in_b : r;
}

void expect_relation(const PlacedPrimitive& a, const PlacedPrimitive& b, Relation relation,
                     double d_mm, const std::string& what) {
  for (std::uint64_t seed = 1; seed <= kTurns; ++seed) {
    test::PrimitiveDraw draw(seed);
    const Placement frame{seed == 1 ? Mat3d{} : draw.turn(), draw.point(500)};
    const PlacedPrimitive x = placed(a, frame), y = placed(b, frame);
    const Pair p = pair_of(x, y), q = pair_of(y, x);
    SCOPED_TRACE(what + ", turn " + std::to_string(seed));
    EXPECT_EQ(name(p.relation), name(relation));
    EXPECT_EQ(name(q.relation), name(mirrored(relation)));
    EXPECT_LE(p.d_lower_mm, d_mm + 5e-3);
    EXPECT_GE(p.d_upper_mm, d_mm - 5e-3);
    EXPECT_NEAR(p.d_mm, d_mm, 0.2);
  }
}

TEST(CertifiedRelations, SheetsInSolidsAndThroughThem) {
  const PlacedPrimitive pipe{CylinderPrimitive{50, 100}, {}}, ball{SpherePrimitive{100}, {}};
  const PlacedPrimitive bar{BoxPrimitive{20, 20, 100}, {}}, block{BoxPrimitive{90, 100, 110}, {}};
  const PlacedPrimitive small{BoxPrimitive{20, 20, 0}, {}}, wide{BoxPrimitive{300, 300, 0}, {}};
  const PlacedPrimitive coin{CylinderPrimitive{20, 0}, {}}, disc{CylinderPrimitive{200, 0}, {}};
  const PlacedPrimitive beside{BoxPrimitive{100, 20, 0}, {{}, {50, 0, 0}}};
  expect_relation(small, pipe, Relation::a_in_b, -50, "sheet in pipe");
  expect_relation(coin, pipe, Relation::a_in_b, -50, "disc in pipe");
  expect_relation(coin, ball, Relation::a_in_b, -50, "disc in ball");
  expect_relation(coin, block, Relation::a_in_b, -45, "disc in block");
  expect_relation(beside, pipe, Relation::cross, -50, "sheet that ends in a pipe");
  expect_relation(wide, pipe, Relation::cross, -50, "sheet through a pipe");
  expect_relation(wide, ball, Relation::cross, -50, "sheet through a ball");
  expect_relation(wide, bar, Relation::cross, -10, "sheet through a bar");
  expect_relation(disc, pipe, Relation::cross, -50, "disc through a pipe");
  expect_relation(disc, ball, Relation::cross, -50, "disc through a ball");
  expect_relation(disc, bar, Relation::cross, -10, "disc through a bar");
}

/// Both witnesses, or the deepest point and the nearest one of the skin that d is measured to.
void expect_points_on_skins(const PlacedPrimitive& a, const PlacedPrimitive& b, const Pair& p) {
  constexpr double kOff = 0.02;
  if (p.d_mm >= 0) {
    EXPECT_NEAR(a.depth(p.on_a_mm), 0, kOff);
    EXPECT_NEAR(b.depth(p.on_b_mm), 0, kOff);
    return;
  }
  EXPECT_GE(a.depth(p.point_mm), -kOff);
  EXPECT_GE(b.depth(p.point_mm), -kOff);
  EXPECT_NEAR((p.deep_in_a ? a : b).depth(p.surface_mm()), 0, kOff);
}

struct Ring {
  Primitive primitive;
  double hole = 0;
  const char* what = "";
};

TEST(CertifiedRelations, RingsRoundAPipe) {
  for (const Ring& r :
       {Ring{RectangularTorusPrimitive{50, 80, 40, kFullTurn / 2}, 50, "half collar"},
        Ring{RectangularTorusPrimitive{50, 80, 40, kFullTurn}, 50, "collar"},
        Ring{RectangularTorusPrimitive{1500, 1600, 100, kFullTurn}, 1500, "3 m"},
        Ring{RectangularTorusPrimitive{10000, 10600, 1000, kFullTurn}, 10000, "20 m"},
        Ring{CircularTorusPrimitive{150, 20, kFullTurn}, 130, "round"},
        Ring{CircularTorusPrimitive{1500, 20, kFullTurn}, 1480, "round, 3 m"}})
    for (const double press : {0.0, 0.3, 4.0})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        test::PrimitiveDraw draw(seed);
        const Placement frame{seed == 1 ? Mat3d{} : draw.turn(), draw.point(500)};
        const PlacedPrimitive ring = placed({r.primitive, {}}, frame);
        const PlacedPrimitive pipe =
            placed({CylinderPrimitive{r.hole + press, 4 * r.hole}, {}}, frame);
        SCOPED_TRACE(std::string(r.what) + ", press " + std::to_string(press) + ", turn " +
                     std::to_string(seed));
        for (const bool turned : {false, true}) {
          const PlacedPrimitive &a = turned ? pipe : ring, &b = turned ? ring : pipe;
          const Pair p = pair_of(a, b);
          EXPECT_LE(p.d_lower_mm, -press + 3e-3);
          EXPECT_GE(p.d_upper_mm, -press - 3e-3);
          EXPECT_NEAR(p.d_mm, -press, 0.02) << p.d_lower_mm << ' ' << p.d_upper_mm;
          EXPECT_EQ(name(p.cls), name(press > 1 ? Class::hit : Class::contact));
          EXPECT_EQ(name(p.relation),
                    name(press > 0 ? Relation::interfere : Relation::abut_outside));
          expect_points_on_skins(a, b, p);
        }
      }
}

TEST(CertifiedRelations, ARodAcrossTheHoleOfARingIsNotInTheRing) {
  const PlacedPrimitive ring{CircularTorusPrimitive{500, 50, kFullTurn}, {}};
  expect_relation(ring, {CylinderPrimitive{10, 1000}, {kOnItsSide, {}}}, Relation::interfere, -50,
                  "both ends in the ring");
  expect_relation(ring, {CylinderPrimitive{10, 980}, {kOnItsSide, {15, 0, 0}}}, Relation::interfere,
                  -50, "off the middle");
  expect_relation(ring, {CylinderPrimitive{10, 40}, {kOnItsSide, {500, 0, 0}}}, Relation::b_in_a,
                  -50, "in the tube");
}

/// A channel of one solid, 120 x 110 along x with walls of 10 mm.
geometry::TriangleMesh channel_mesh() {
  constexpr std::array<std::array<double, 2>, 8> kOutline{
      {{0, 0}, {120, 0}, {120, 110}, {110, 110}, {110, 10}, {10, 10}, {10, 110}, {0, 110}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 3> kEnds{
      {{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 5, 6, 7}}};
  geometry::TriangleMesh mesh;
  for (const double x : {0.0, 1200.0})
    for (const auto& p : kOutline) mesh.vertices.push_back({x, p[0], p[1]});
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a, d, c});
  };
  for (std::uint32_t i = 0; i < 8; ++i) quad(i, i + 8, (i + 1) % 8 + 8, (i + 1) % 8);
  for (const auto& q : kEnds) {
    quad(q[0], q[1], q[2], q[3]);
    quad(q[3] + 8, q[2] + 8, q[1] + 8, q[0] + 8);
  }
  return mesh;
}

/// All its corners are on the channel's skin, or within what the snap made of it; it is not in it.
TEST(CertifiedRelations, WhatFillsAChannelIsNotInIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Draw draw(seed);
    const Placement turn{draw.rotation(), {}};
    test::ClashModel m;
    m.object("a").body(channel_mesh(), turn);
    m.object("b").body(test::box_mesh({0, 10, 10}, {1000, 110, 110}), turn);
    const Report report = m.detect();
    ASSERT_EQ(report.pairs.size(), 1U) << "seed " << seed;
    const Pair& p = report.pairs.front();
    EXPECT_EQ(p.cls, Class::contact) << "seed " << seed;
    EXPECT_TRUE(p.relation == Relation::abut_outside || p.d_mm < -0.001) << "seed " << seed;
    EXPECT_NE(p.relation, Relation::abut_inside) << "seed " << seed;
  }
}

}  // namespace
}  // namespace strake::clash
