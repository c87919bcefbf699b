// SPDX-License-Identifier: Apache-2.0
// Sheets that lie on each other, folded and turned every way: the snap makes them pass through each
// other by a fraction of a unit here and there, which is no crossing. What passes through by more
// than the contact distance is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/drawn_sheets.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::TriangleMesh;
using geometry::Vec3d;

constexpr int kTurns = test::rounds(40, 400);
/// The contact distance, mm, as far as a snap of both sheets may blur it.
constexpr double kBand = 0.003, kBlur = 0.002;

using test::arc;
using test::drawn;
using test::placed;
using test::Profile;
using test::refined;
using test::shuffled;

Pair pair_of(const TriangleMesh& a, const TriangleMesh& b, const parallel::Context& context = {},
             const Options& options = {}) {
  test::ClashModel m;
  m.object("a").body(a);
  m.object("b").body(b);
  const Report report = m.detect(options, context);
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? Pair{} : report.pairs.front();
}

/// Looks at the pair in many places.
template <class Expect>
void turn_every_way(const TriangleMesh& a, const TriangleMesh& b, Expect&& expect) {
  test::Draw draw(7);
  for (int i = 0; i < kTurns; ++i) {
    SCOPED_TRACE(i);
    const Mat3d turn = draw.rotation();
    Vec3d move;
    move.x = draw.between(-2000, 2000);
    move.y = draw.between(-2000, 2000);
    move.z = draw.between(-2000, 2000);
    expect(pair_of(placed(a, turn, move), placed(b, turn, move)));
  }
}

void expect_touch(const Pair& p, Relation relation = Relation::abut_outside) {
  EXPECT_EQ(p.cls, Class::contact) << p.d_mm;
  EXPECT_EQ(p.relation, relation);
  EXPECT_LE(std::fabs(p.d_mm), kBand);
  EXPECT_GE(p.d_lower_mm, -kBand);
}

/// Joined where they share corners.
TriangleMesh all_of(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const geometry::Triangle& t : mesh.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

const Profile kFloor{{0, 0}, {1000, 0}};
const Profile kAngle{{0, 300}, {0, 0}, {300, 0}};

TEST(CoplanarSheets, FlatOnesTouch) {
  const TriangleMesh floor = drawn(kFloor, 0, 1000);
  const TriangleMesh grid = drawn(refined(kFloor, 7), 0, 1000, 6, true);
  const Profile part{{500, 0}, {1500, 0}};
  for (const TriangleMesh& other : {drawn({{100, 0}, {900, 0}}, 100, 900), drawn(part, 500, 1500),
                                    drawn(refined(part, 5), 333, 1200, 4), drawn(part, 1000, 1500)})
    turn_every_way(floor, other, [](const Pair& p) { expect_touch(p); });
  turn_every_way(floor, grid, [](const Pair& p) { expect_touch(p, Relation::duplicate); });
}

TEST(CoplanarSheets, FoldedOnesTouchAFloorFromOneSide) {
  const TriangleMesh floor = drawn(refined(kFloor, 3), 0, 1000, 3);
  for (const Profile& profile :
       {Profile{{300, 100}, {500, 0}, {700, 100}},
        Profile{{300, 100}, {300, 0}, {700, 0}, {700, 200}},
        Profile{{300, -200}, {300, 0}, {700, 0}, {700, -200}},
        Profile{{500, -200}, {500, 0}, {2000, 0}},
        Profile{{100, 0}, {300, 0}, {300, 100}, {600, 100}, {600, 0}, {800, 0}},
        Profile{{500, 0}, {500, 300}}})
    turn_every_way(floor, drawn(profile, 200, 800), [](const Pair& p) { expect_touch(p); });
}

TEST(CoplanarSheets, BentOnesTouchWhatTheyLieOn) {
  const auto touches = [](const TriangleMesh& a, const TriangleMesh& b) {
    turn_every_way(a, b, [](const Pair& p) { expect_touch(p); });
  };
  const Profile channel{{0, 200}, {0, 0}, {400, 0}, {400, 200}};
  const Profile hat{{0, 0}, {200, 0}, {200, 150}, {400, 150}, {400, 0}, {600, 0}};
  const TriangleMesh pipe = drawn(arc(500, 0, 24), 0, 1000);
  // A pipe on a pipe, or a saddle on it, of the same facets cut in other places.
  touches(pipe, drawn(arc(500, 0, 24), 200, 1300, 3, true));
  touches(pipe, drawn(arc(500, 2, 9), 100, 900, 2));
  touches(drawn(arc(500, 0, 12), 0, 1000, 5, true), drawn(arc(500, 3, 15), 300, 1200, 4));
  // A panel on a facet, inside and outside, and on a ridge.
  const double middle = std::numbers::pi / 24, flat = 500 * std::cos(middle);
  const auto panel = [](double angle, double radius) {
    const double x = std::cos(angle), z = std::sin(angle);
    return drawn({{radius * x - 200 * z, radius * z + 200 * x},
                  {radius * x + 200 * z, radius * z - 200 * x}},
                 200, 800);
  };
  touches(drawn(arc(500, 0, 12), 0, 1000, 3), panel(5 * middle, flat));
  touches(drawn(arc(500, 0, 12), 0, 1000, 3), panel(4 * middle, 500));
  touches(drawn(kAngle, 0, 1000), drawn(kAngle, 100, 900));
  touches(drawn(kAngle, 0, 1000), drawn({{0, 200}, {0, 0}, {200, 0}}, 100, 1200, 3));
  touches(drawn(kAngle, 0, 1000), drawn({{0, 400}, {0, 0}, {400, 0}, {400, 50}}, 300, 800, 2));
  touches(drawn(channel, 0, 1000), drawn({{0, 150}, {0, 0}, {400, 0}, {400, 150}}, -200, 700, 3));
  touches(drawn(hat, 0, 1000),
          drawn({{-100, 0}, {250, 0}, {250, -100}, {350, -100}, {350, 0}, {700, 0}}, 100, 900, 2));
  touches(drawn(hat, 0, 1000), drawn(refined(hat, 3), 100, 1100, 4, true));
}

TEST(CoplanarSheets, GridsOnGridsTouch) {
  const TriangleMesh grid = drawn(refined(kFloor, 10), 0, 1000, 10, true);
  for (const double by : {10.0, 25.0, 333.3})
    turn_every_way(grid, drawn(refined({{by, 0}, {1000 + by, 0}}, 10), by / 2, 1000 + by / 2, 10),
                   [](const Pair& p) { expect_touch(p); });
}

// No move to one side is enough: their rims have to leave what they end on as well.
TEST(CoplanarSheets, OnesThatEndInFoldsTouch) {
  const auto touches = [](const Profile& on, const Profile& what, int bays = 1) {
    SCOPED_TRACE(testing::PrintToString(on) + " and " + testing::PrintToString(what));
    turn_every_way(drawn(on, 0, 120), drawn(what, 0, 100, bays),
                   [](const Pair& p) { expect_touch(p); });
    turn_every_way(drawn(refined(what, 3), 10, 130, 4, true), drawn(refined(on, 2), 0, 120, 3),
                   [](const Pair& p) { expect_touch(p); });
  };
  // A plate on the web of a Z, whose flanges leave to different sides, at any angle.
  for (const double slope : {-20, -10, 0, 30, 100})
    touches({{0, -slope}, {50, 0}, {50, 80}, {100, 80 + slope}}, {{50, 0}, {50, 80}});
  touches({{0, 0}, {50, 0}, {50, 80}, {100, 80}}, {{50, 30}, {50, 80}}, 5);
  touches({{0, 0}, {50, 0}, {50, 80}, {100, 80}}, {{50, 0}, {50, 80}, {20, 80}}, 2);
  touches({{0, 0}, {50, 0}, {50, 80}, {100, 80}}, {{90, 60}, {50, 80}, {50, 0}}, 2);
  touches({{0, 0}, {50, 0}, {50, 80}, {100, 80}}, {{25, 0}, {50, 0}, {50, 80}, {20, 60}});
  // One that stands on a floor, flush with a wall of it.
  touches({{100, 0}, {0, 0}, {0, 60}}, {{0, 0}, {0, 40}, {50, 40}, {50, 0}});
  // A plate on the web between the flanges of an I, and on a wall in the corner of three.
  const TriangleMesh plate = drawn({{0, 0}, {0, 80}}, 0, 100, 2);
  const TriangleMesh beam =
      all_of({drawn({{0, 0}, {0, 80}}, 0, 120), drawn({{-40, 80}, {0, 80}, {40, 80}}, 0, 120),
              drawn({{-40, 0}, {0, 0}, {40, 0}}, 0, 120)});
  TriangleMesh side = drawn({{0, 0}, {50, 0}}, 0, 90);
  for (Vec3d& v : side.vertices) v = {v.x, 0, v.y};
  const TriangleMesh corner = all_of({drawn({{50, 0}, {0, 0}, {0, 90}}, 0, 120), side});
  for (const TriangleMesh& on : {beam, corner})
    turn_every_way(on, plate, [](const Pair& p) { expect_touch(p); });
}

TEST(CoplanarSheets, WhatGoesOnToBothSidesCrosses) {
  const auto crosses = [](const Pair& p) {
    EXPECT_EQ(p.cls, Class::hit) << p.d_mm;
    EXPECT_EQ(p.relation, Relation::cross);
    EXPECT_LE(p.d_mm, -99);
  };
  const TriangleMesh floor = drawn(refined(kFloor, 3), 0, 1000, 3, true);
  turn_every_way(floor, drawn({{300, -100}, {300, 0}, {700, 0}, {700, 200}}, 200, 800), crosses);
  turn_every_way(floor, drawn({{500, -100}, {500, 300}}, 200, 800), crosses);
  turn_every_way(floor, drawn({{100, -0.02}, {900, 0.02}}, 100, 900), crosses);
  turn_every_way(drawn(kAngle, 0, 1000),
                 drawn({{-100, 200}, {0, 200}, {0, 0}, {200, 0}, {200, 150}}, 150, 850), crosses);
  turn_every_way(drawn(arc(500, 0, 24), 0, 1000), drawn({{0, 0}, {1000, 300}}, 100, 900), crosses);
}

TEST(CoplanarSheets, SeparationChangesByNoMoreThanTheMoveWithinTheContactDistance) {
  const TriangleMesh floor = drawn(kFloor, 0, 1000);
  for (const double down : {-0.010, -0.003, -0.001, 0.0, 0.001, 0.006, 0.1}) {
    SCOPED_TRACE(down);
    const Profile fold{{300, 100}, {500, -down}, {700, 100}};
    turn_every_way(floor, drawn(fold, 200, 800), [&](const Pair& p) {
      if (down > kBand + kBlur) {
        EXPECT_EQ(p.relation, Relation::cross);
        EXPECT_LE(p.d_mm, -100);
        return;
      }
      EXPECT_EQ(p.cls, Class::contact) << p.d_mm;
      EXPECT_NEAR(p.d_mm, std::max(0.0, -down), std::max(down, 0.0) + kBlur);
    });
  }
}

/// What a pair is judged to be, but for which of the two is a.
auto evaluation(const Pair& p) {
  return std::tuple(p.cls, p.relation, p.flags, p.d_mm, p.d_lower_mm, p.d_upper_mm, p.point_mm);
}

TEST(CoplanarSheets, AreClassifiedTheSameWhicheverWayTheyAreWrittenDown) {
  test::Draw draw(11);
  parallel::Team team(3);
  const TriangleMesh half = drawn(arc(500, 0, 12), 0, 1000, 5, true);
  // Nothing but a touch, one that ends in folds, a touch here and a crossing there, and a crossing
  // where they touch.
  const std::vector<std::pair<TriangleMesh, TriangleMesh>> pairs{
      {half, drawn(arc(500, 3, 15), 300, 1200, 4)},
      {drawn({{0, 0}, {50, 0}, {50, 80}, {100, 80}}, 0, 120), drawn({{50, 0}, {50, 80}}, 0, 100)},
      {drawn({{0, 0}, {1000, 0}, {1000, 400}, {0, 400}}, 0, 1000, 3),
       drawn({{100, 0}, {800, 0}, {800, 200}, {600, 200}, {600, 700}}, 100, 900, 2, true)},
      {drawn(refined(kFloor, 3), 0, 1000, 3, true),
       drawn({{300, -100}, {300, 0}, {700, 0}, {700, 200}}, 200, 800)}};
  for (const auto& [a, b] : pairs)
    for (int i = 0; i < kTurns; ++i) {
      SCOPED_TRACE(i);
      const Mat3d turn = draw.rotation();
      const TriangleMesh x = placed(a, turn, {1, 2, 3}), y = placed(b, turn, {1, 2, 3});
      const Pair p = pair_of(x, y);
      EXPECT_EQ(evaluation(pair_of(y, x)), evaluation(p));
      EXPECT_EQ(evaluation(pair_of(x, y, {.team = &team})), evaluation(p));
      EXPECT_EQ(evaluation(pair_of(shuffled(x, draw), shuffled(y, draw))), evaluation(p));
    }
}

TEST(CoplanarSheets, OneOnASolidIsAContact) {
  const TriangleMesh plate = test::box_mesh({100, 100, 0}, {900, 900, 50});
  for (const TriangleMesh& sheet :
       {drawn(kFloor, 0, 1000), drawn(refined(kFloor, 6), 0, 1000, 6, true),
        drawn({{300, -100}, {300, 0}, {700, 0}, {700, -100}}, 200, 800)})
    turn_every_way(sheet, plate, [](const Pair& p) {
      EXPECT_EQ(p.cls, Class::contact) << p.d_mm;
      EXPECT_EQ(p.relation, Relation::abut_outside);
      EXPECT_LE(std::fabs(p.d_mm), kBand);
    });
}

TEST(CoplanarSheets, AWideContactDistanceHidesNoHit) {
  const TriangleMesh floor = drawn(kFloor, 0, 1000);
  const auto fold = [&](double down, double contact_distance_mm) {
    const Options options{.contact_distance_mm = contact_distance_mm};
    return pair_of(floor, drawn({{300, 100}, {500, -down}, {700, 100}}, 200, 800), {}, options);
  };
  EXPECT_EQ(fold(3, 2).cls, Class::hit);
  EXPECT_EQ(fold(3, 2).flags & kUncertain, 0);
  for (const double down : {1.2, 3.0}) {
    const Pair p = fold(down, 4);
    EXPECT_EQ(p.cls, Class::hit) << p.d_mm;
    EXPECT_NE(p.flags & kUncertain, 0);
    EXPECT_LT(p.d_lower_mm, -100);
    EXPECT_EQ(p.d_upper_mm, 0) << "moves of " << down << " mm part them";
  }
  // Within the touch overlap it is a touch as any.
  expect_touch(fold(0.5, 4));
}

}  // namespace
}  // namespace strake::clash
