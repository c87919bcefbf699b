// SPDX-License-Identifier: Apache-2.0
// What the source's numbers and the grid leave open: the flag of an exact threshold survives a turn
// of the model, and bodies whose numbers are coarse touch as far as these can tell.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "support/draw.hpp"
#include "support/expect_pair.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;
using test::only;

/// A box of whole millimetres, as a mesh with its numbers turned or as a primitive with its place
/// turned.
void add_box(ClashModel& m, const char* id, const Vec3d& lo, const Vec3d& size, const Mat3d& turn,
             bool primitive) {
  if (primitive) {
    m.object(id).body(geometry::BoxPrimitive{size.x, size.y, size.z},
                      {turn, turn * (lo + size * 0.5)});
    return;
  }
  TriangleMesh mesh = test::box_mesh(lo, lo + size);
  for (Vec3d& v : mesh.vertices) v = turn * v;
  m.object(id).body(std::move(mesh));
}

Pair beside(double gap, const Mat3d& turn, bool primitive, std::uint64_t seed) {
  test::Draw draw(seed);
  const auto length = [&] { return 2.0 * draw.whole(20, 300); };
  const Vec3d a{length(), length(), length()}, b{length(), length(), length()};
  ClashModel m;
  add_box(m, "a", {}, a, turn, primitive);
  add_box(m, "b", {a.x + gap, a.y / 4, a.z / 4}, b, turn, primitive);
  return only(m, {.tolerances = {.clearance_mm = 25}});
}

TEST(SourceErrors, AnExactThresholdIsBorderlineHoweverTheModelStands) {
  constexpr std::array<std::pair<double, Class>, 3> kThresholds{
      std::pair{25.0, Class::clearance_violation}, std::pair{1.0, Class::contact},
      std::pair{-1.0, Class::hit}};
  for (const auto& [gap, cls] : kThresholds)
    for (const bool primitive : {false, true})
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::to_string(gap) +
                     (primitive ? " primitives" : " meshes"));
        test::Draw draw(seed * 977);
        for (const Mat3d& turn : {Mat3d{}, draw.rotation()}) {
          const Pair p = beside(gap, turn, primitive, seed);
          EXPECT_EQ(name(p.cls), name(cls));
          EXPECT_EQ(p.flags, kBorderline);
          EXPECT_LE(p.d_lower_mm, gap);
          EXPECT_GE(p.d_upper_mm, gap);
        }
      }
}

/// A hundredth of a millimetre beside a threshold there is nothing to flag.
TEST(SourceErrors, BesideAThresholdTheClassIsSure) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Draw draw(seed * 977);
    const Mat3d turn = draw.rotation();
    for (const auto& [gap, cls] :
         {std::pair{24.99, Class::clearance_violation}, std::pair{1.01, Class::clearance_violation},
          std::pair{0.99, Class::contact}, std::pair{-0.99, Class::contact},
          std::pair{-1.01, Class::hit}}) {
      const Pair p = beside(gap, turn, seed % 2 == 0, seed);
      EXPECT_EQ(name(p.cls), name(cls)) << seed << ' ' << gap;
      EXPECT_EQ(p.flags, 0) << seed << ' ' << gap;
    }
  }
}

/// What is on the grid is not widened, wherever it stands.
TEST(SourceErrors, WhatTheSnapDidNotMoveKeepsItsBracket) {
  const auto p = [](const Vec3d& at) {
    ClashModel m;
    m.box("a", at, at + Vec3d{100, 100, 100});
    m.box("b", at + Vec3d{110.123, 0, 0}, at + Vec3d{200, 100, 100});
    return only(m, {.tolerances = {.clearance_mm = 25}});
  };
  for (const Vec3d& at : {Vec3d{}, Vec3d{0.001, 1234.567, -98765.432}, Vec3d{5e8, -3e8, 1e8}}) {
    EXPECT_LT(p(at).d_upper_mm - p(at).d_lower_mm, 1e-9);
    EXPECT_NEAR(p(at).d_mm, 10.123, 1e-9);
  }
}

/// With tolerances of 0 the grid itself is asked, also of what the snap moved.
TEST(SourceErrors, TolerancesOfZeroAreTakenFromTheGrid) {
  const auto p = [](double gap) {
    ClashModel m;
    m.box("a", {0, 0, 0.0001}, {100, 100, 100});
    m.box("b", {100 + gap, 0, 0.0001}, {200, 100, 100});
    return only(m, {.tolerances = {.touch_gap_mm = 0, .touch_overlap_mm = 0}});
  };
  EXPECT_EQ(p(0.001).cls, Class::no_hit);
  EXPECT_EQ(p(0).cls, Class::contact);
  EXPECT_EQ(p(-0.001).cls, Class::hit);
  for (const double gap : {0.0, -0.001}) EXPECT_EQ(p(gap).flags, 0) << gap;
}

/// Two boxes, or a box and a sheet, one step over or apart, far from the origin.
Pair at_steps(double steps, double step_mm, bool sheet, double contact_distance = -1) {
  const double far = step_mm * (1 << 23);
  ClashModel m;
  m.box("a", {far, 0, 0}, {far + 20'000, 6'000, 4'000});
  const double x = far + 20'000 + steps * step_mm;
  if (sheet) {
    TriangleMesh mesh;
    mesh.vertices = {{x, 500, 500}, {x + 900, 500, 500}, {x, 900, 3500}};
    mesh.triangles = {{0, 1, 2}};
    m.object("b").body(std::move(mesh));
  } else {
    m.box("b", {x, 500, 500}, {x + 9'000, 5'000, 3'000});
  }
  for (model::Body& body : m.model.bodies)
    body.precision_um = static_cast<float>(step_mm * 1000 / 2);
  return only(m, {.contact_distance_mm = contact_distance});
}

TEST(SourceErrors, AStepOfCoarseNumbersIsAContactAndUncertain) {
  for (const double step : {1.953125, 3.90625, 62.5})
    for (const bool sheet : {false, true}) {
      SCOPED_TRACE(std::to_string(step) + (sheet ? " sheet" : " solids"));
      const Pair apart = at_steps(1, step, sheet), over = at_steps(-1, step, sheet);
      EXPECT_EQ(name(apart.cls), name(Class::contact));
      EXPECT_EQ(apart.flags & kUncertain, kUncertain);
      EXPECT_LE(apart.d_lower_mm, 0.01);
      EXPECT_EQ(name(over.cls), name(Class::contact));
      EXPECT_EQ(over.flags & kUncertain, kUncertain);
      EXPECT_EQ(name(over.severest), name(Class::hit));
      EXPECT_GE(over.d_upper_mm, -0.01);
      EXPECT_EQ(name(at_steps(3, step, sheet).cls), name(Class::no_hit));
      const Pair deep = at_steps(-3, step, sheet);
      EXPECT_EQ(name(deep.cls), name(Class::hit));
      EXPECT_EQ(deep.flags & kUncertain, 0);
    }
}

/// Numbers finer than the tolerances say what they say, and so does a contact distance that is
/// given.
TEST(SourceErrors, WhatIsNoCoarserThanATouchIsClassifiedAsItStands) {
  EXPECT_EQ(at_steps(-1, 0.25, false).flags, 0);
  EXPECT_NEAR(at_steps(-1, 0.25, false).d_mm, -0.25, 1e-3);
  EXPECT_EQ(name(at_steps(-1, 3.90625, false, 0.01).cls), name(Class::hit));
  EXPECT_EQ(at_steps(-1, 3.90625, false, 0.01).flags, 0);
}

/// A mesh whose source says how far it lies from its surface is not one whose seams were closed:
/// what that leaves open beyond all tolerances is not told.
TEST(SourceErrors, ASagThatIsKnownIsNoWeld) {
  for (const double gap : {0.25, 0.75, 1.5}) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100});
    TriangleMesh mesh = test::box_mesh({100 + gap, 0, 0}, {200, 100, 100});
    mesh.sag_mm = 1;
    m.object("b").body(std::move(mesh));
    EXPECT_TRUE(m.detect({.tolerances = {.clearance_mm = 0.2, .touch_gap_mm = 0}}).pairs.empty())
        << gap;
  }
}

}  // namespace
}  // namespace strake::clash
