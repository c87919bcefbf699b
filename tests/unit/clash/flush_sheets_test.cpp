// SPDX-License-Identifier: Apache-2.0
// Sheets that lie on each other, folded and turned every way: the snap makes them pass through each
// other by a fraction of a unit here and there, which is no crossing. What passes through by more
// than the contact distance is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/clash_model.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::TriangleMesh;
using geometry::Vec3d;

constexpr int kTurns = test::rounds(10, 400);
/// The contact distance, mm, as far as a snap of both sheets may blur it.
constexpr double kBand = 0.003, kBlur = 0.002;

using Profile = std::vector<std::array<double, 2>>;  ///< x and z

/// A profile drawn out along y, in so many bays whose diagonals alternate or not.
TriangleMesh drawn(const Profile& profile, double y0, double y1, int bays = 1,
                   bool alternate = false) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (int bay = 0; bay <= bays; ++bay)
    for (const auto& [x, z] : profile) mesh.vertices.push_back({x, y0 + (y1 - y0) * bay / bays, z});
  for (std::uint32_t bay = 0; bay < static_cast<std::uint32_t>(bays); ++bay)
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      const std::uint32_t a = bay * count + i, b = a + 1, c = b + count, d = a + count;
      const bool other = alternate && (i + bay) % 2 == 1;
      mesh.triangles.push_back(other ? geometry::Triangle{a, b, d} : geometry::Triangle{a, b, c});
      mesh.triangles.push_back(other ? geometry::Triangle{b, c, d} : geometry::Triangle{a, c, d});
    }
  return mesh;
}

/// A profile with more corners along its straight lines.
Profile refined(const Profile& profile, int parts) {
  Profile fine{profile.front()};
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      const auto &p = profile[i], &q = profile[i + 1];
      fine.push_back({p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t});
    }
  return fine;
}

Profile arc(double radius, int first, int last) {
  Profile profile;
  for (int i = first; i <= last; ++i) {
    const double angle = std::numbers::pi * i / 12;
    profile.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return profile;
}

Mat3d turned(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> any(-1, 1);
  double w = 0, x = 0, y = 0, z = 0, length = 0;
  while (!(length > 0.1 && length < 1)) {
    w = any(rng);
    x = any(rng);
    y = any(rng);
    z = any(rng);
    length = std::sqrt(w * w + x * x + y * y + z * z);
  }
  w /= length;
  x /= length;
  y /= length;
  z /= length;
  return {{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           Vec3d{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           Vec3d{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

TriangleMesh placed(TriangleMesh mesh, const Mat3d& turn, const Vec3d& move) {
  for (Vec3d& v : mesh.vertices)
    v = Vec3d{dot(turn.row[0], v), dot(turn.row[1], v), dot(turn.row[2], v)} + move;
  return mesh;
}

Pair pair_of(const TriangleMesh& a, const TriangleMesh& b) {
  test::ClashModel m;
  m.object("a").body(a);
  m.object("b").body(b);
  const Report report = m.detect();
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? Pair{} : report.pairs.front();
}

/// Looks at the pair in many places.
template <class Expect>
void turn_every_way(const TriangleMesh& a, const TriangleMesh& b, Expect&& expect) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> any(-2000, 2000);
  for (int i = 0; i < kTurns; ++i) {
    SCOPED_TRACE(i);
    const Mat3d turn = turned(rng);
    Vec3d move;
    move.x = any(rng);
    move.y = any(rng);
    move.z = any(rng);
    expect(pair_of(placed(a, turn, move), placed(b, turn, move)));
  }
}

void expect_touch(const Pair& p, Relation relation = Relation::abut_outside) {
  EXPECT_EQ(p.cls, Class::contact) << p.d_mm;
  EXPECT_EQ(p.relation, relation);
  EXPECT_LE(std::fabs(p.d_mm), kBand);
  EXPECT_GE(p.d_lower_mm, -kBand);
}

const Profile kFloor{{0, 0}, {1000, 0}};
const Profile kAngle{{0, 300}, {0, 0}, {300, 0}};

TEST(FlushSheets, FlatOnesTouch) {
  const TriangleMesh floor = drawn(kFloor, 0, 1000);
  const TriangleMesh grid = drawn(refined(kFloor, 7), 0, 1000, 6, true);
  const Profile part{{500, 0}, {1500, 0}};
  for (const TriangleMesh& other : {drawn({{100, 0}, {900, 0}}, 100, 900), drawn(part, 500, 1500),
                                    drawn(refined(part, 5), 333, 1200, 4), drawn(part, 1000, 1500)})
    turn_every_way(floor, other, [](const Pair& p) { expect_touch(p); });
  turn_every_way(floor, grid, [](const Pair& p) { expect_touch(p, Relation::duplicate); });
}

TEST(FlushSheets, FoldedOnesTouchAFloorFromOneSide) {
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

TEST(FlushSheets, WhatGoesOnToBothSidesCrosses) {
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

TEST(FlushSheets, SeparationChangesByNoMoreThanTheMoveWithinTheContactDistance) {
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

TEST(FlushSheets, OneOnASolidIsAContact) {
  const TriangleMesh plate = test::box_mesh({100, 100, 0}, {900, 900, 50});
  for (const TriangleMesh& sheet :
       {drawn(kFloor, 0, 1000), drawn(refined(kFloor, 6), 0, 1000, 6, true),
        drawn({{300, -100}, {300, 0}, {700, 0}, {700, -100}}, 200, 800)})
    turn_every_way(sheet, plate, [](const Pair& p) {
      EXPECT_EQ(p.cls, Class::contact) << p.d_mm;
      EXPECT_LE(std::fabs(p.d_mm), kBand);
    });
}

}  // namespace
}  // namespace strake::clash
