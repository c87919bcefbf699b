// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/depth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "../../support/nonconvex_bodies.hpp"
#include "geometry/interior_depth/solid_depth_search.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::channel;
using testing::cylinder;
using testing::depth_at;
using testing::depth_from_touch;
using testing::depth_of;
using testing::IndexedMesh;
using testing::interiors_meet;
using testing::Subject;
using testing::turned;

void expect_depth(const Subject& a, const Subject& b, double expected, double width = 1e-3) {
  const Depth d = depth_of(a, b), e = depth_of(b, a);
  EXPECT_NEAR(d.value, expected, width);
  EXPECT_NEAR(e.value, expected, width);
  EXPECT_LE(d.lower, expected + width / 2);
  EXPECT_GE(d.upper, expected - width / 2);
  EXPECT_LE(d.upper - d.lower, width);
}

TEST(Depth, AlignedWallsOverlapAtTheirEnds) {
  const Subject a(box_mesh({0, 0, 0}, {3'000'000, 200'000, 2'500'000}));
  const Subject b(box_mesh({0, 0, 0}, {3'000'000, 200'000, 2'500'000}), {2'950'000, 0, 0});
  expect_depth(a, b, 50'000);
  const Subject c(box_mesh({0, 0, 0}, {3'000'000, 200'000, 2'500'000}), {2'950'000, 2'000, 0});
  expect_depth(a, c, 50'000);
}

TEST(Depth, CrossingPlatesAreHalfAPlateDeep) {
  const Subject a(box_mesh({0, 0, 0}, {1'000'000, 2'000, 500'000}));
  const Subject b(box_mesh({0, 0, 0}, {2'000, 1'000'000, 500'000}), {499'000, -499'000, 0});
  expect_depth(a, b, 1'000);
}

TEST(Depth, PipeThroughAWallIsAsDeepAsThePipe) {
  const Subject wall(box_mesh({0, 0, 0}, {3'000'000, 3'000'000, 12'000}));
  const Subject pipe(box_mesh({0, 0, 0}, {100'000, 100'000, 900'000}),
                     {1'000'000, 1'000'000, -400'000});
  expect_depth(wall, pipe, 50'000);
}

TEST(Depth, NestedAndDuplicateBodies) {
  const Subject tank(box_mesh({0, 0, 0}, {1'000'000, 1'000'000, 1'000'000}));
  const Subject inside(box_mesh({0, 0, 0}, {10'000, 10'000, 10'000}), {300'000, 400'000, 500'000});
  // Deepest point of the small box: its far corner side, 310 mm from the tank's nearest wall.
  expect_depth(tank, inside, 310'000);
  expect_depth(tank, tank, 500'000);
}

TEST(Depth, TheSameWhereverAndHoweverTurned) {
  const IndexedMesh wall =
      box_mesh({-1'500'000, -100'000, -1'000'000}, {1'500'000, 100'000, 1'000'000});
  IndexedMesh other = wall;
  for (Vec3i& v : other.vertices) v = v + Vec3i{2'950'000, 2'000, 0};
  const Subject a(turned(wall), {900'000'000'000, 5, -7}),
      b(turned(other), {900'000'000'000, 5, -7});
  expect_depth(a, b, 50'000, 8);
}

TEST(Depth, CylinderPushedIntoABox) {
  // One corner of the prism points down: it is 7 mm in the floor.
  const Subject pipe(cylinder(24, 100'000, -500'000, 500'000), {0, 0, 93'000 - 100'000});
  const Subject floor(box_mesh({-200'000, -200'000, -600'000}, {200'000, 200'000, -500'000}));
  expect_depth(floor, pipe, 7'000, 1);
}

TEST(Depth, OneGridUnitDeep) {
  const Subject a(box_mesh({0, 0, 0}, {1000, 1000, 1000}));
  const Subject b(box_mesh({0, 0, 0}, {1000, 1000, 1000}), {999, 0, 0});
  expect_depth(a, b, 1);
}

TEST(Depth, BodyInTheHollowOfAChannel) {
  // A bar that lies in the channel and sinks 3 mm into its floor; its hull is deep in the hull of
  // the channel, so only the search can tell.
  const Subject a(channel(1'000'000, 100'000, 80'000, 10'000));
  const Subject bar(box_mesh({0, 0, 0}, {200'000, 40'000, 40'000}), {400'000, 30'000, 7'000});
  DepthOptions goal;
  goal.threshold = 1000;
  const Depth d = depth_of(a, bar, goal);
  EXPECT_LE(d.lower, 3000);
  EXPECT_GE(d.upper, 3000);
  EXPECT_GT(d.lower, 1000) << "the class is decided";
  EXPECT_LE(d.upper - d.lower, 60);
  EXPECT_LT(d.cells, 200U);
}

/// Two channels, one turned over the other: the arms of one stand in the other's walls and floor.
TEST(Depth, ChannelsStuckIntoEachOther) {
  const Subject a(channel(1'000'000, 100'000, 80'000, 10'000));
  IndexedMesh upside = channel(1'000'000, 100'000, 80'000, 10'000).flipped();
  for (Vec3i& v : upside.vertices) v.z = -v.z;
  // Arms 16 mm into a floor of 10: 10 mm of arm in 10 mm of floor, and half of that is deepest.
  const Subject b(upside, {0, 45'000, 84'000});
  const Depth d = depth_of(a, b, {.threshold = 1000});
  EXPECT_NEAR(d.value, 5'000, 100);
  EXPECT_LE(d.lower, 5'000);
  EXPECT_GE(d.upper, 5'000);
  EXPECT_LE(d.upper - d.lower, 100);
}

/// The search ends with a narrow bracket round any depth of bodies that are not convex, or says
/// that its work limit ended it.
TEST(Depth, BracketsOfConcaveBodiesAreNarrow) {
  int met = 0, cut_short = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const IndexedMesh u = channel(draw(40, 90) * 1000, 60'000, 40'000, draw(4, 12) * 1000);
    const Subject a(seed % 2 == 0 ? u : turned(u));
    const IndexedMesh other = seed % 3 == 0
                                  ? channel(draw(40, 90) * 1000, 30'000, 50'000, draw(4, 12) * 1000)
                                  : cylinder(draw(3, 24), draw(5'000, 20'000), -20'000, 20'000);
    const Subject b(turned(other), {draw(0, 40'000), draw(0, 40'000), draw(0, 20'000)});
    if (!interiors_meet(a, b)) continue;
    ++met;
    const Depth d = depth_from_touch(a, b, {.threshold = 1000, .cells_decided = 10'000});
    EXPECT_LE(d.upper - d.lower, std::max(8.0, 0.02 * d.upper)) << "seed " << seed;
    EXPECT_TRUE(d.complete) << "seed " << seed;
    const Depth ended = depth_from_touch(a, b, {.cells_undecided = 1, .cells_decided = 1});
    if (!ended.complete) ++cut_short;
    EXPECT_TRUE(!ended.complete || is_tight(ended, {}, 0.01)) << "seed " << seed;
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(cut_short, 0);
}

TEST(Depth, ShallowContactInTheHollowOfATurnedChannel) {
  // 20 µm deep in the floor of a channel that stands askew: that it is no more than a contact must
  // be certain, and cheap.
  const Subject a(turned(channel(1'000'000, 100'000, 80'000, 10'000)));
  const Subject b(turned(box_mesh({400'000, 30'000, 9'980}, {600'000, 70'000, 50'000})));
  ASSERT_TRUE(interiors_meet(a, b));
  const Depth d = depth_from_touch(a, b, {.threshold = 1000});
  EXPECT_NEAR(d.value, 20, 3);
  EXPECT_LE(d.lower, 22);
  EXPECT_GE(d.upper, 18);
  EXPECT_LE(d.upper, 1000);
  EXPECT_LT(d.cells, 1000U);
}

/// The bracket holds against a dense sampling of the definition.
TEST(Depth, NoSampleIsDeeperThanTheBracket) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const Subject a(seed % 2 == 0
                        ? channel(draw(40, 90) * 1000, 60'000, 40'000, draw(4, 12) * 1000)
                        : turned(box_mesh({0, 0, 0}, {draw(20, 90) * 1000, 30'000, 20'000})));
    const Subject b(turned(cylinder(draw(3, 12), draw(5'000, 20'000), -20'000, 20'000)),
                    {draw(0, 40'000), draw(0, 40'000), draw(0, 20'000)});
    QueryContext work;
    if (meet(a.treed(), b.treed(), work).meeting == Meeting::apart) continue;
    const Depth d = depth_of(a, b);
    EXPECT_LE(d.lower, d.value);
    EXPECT_LE(d.value, d.upper);
    for (int i = 0; i < 400; ++i) {
      const Vec3l p{draw(a.part.box.lo.x, a.part.box.hi.x + 1),
                    draw(a.part.box.lo.y, a.part.box.hi.y + 1),
                    draw(a.part.box.lo.z, a.part.box.hi.z + 1)};
      EXPECT_LE(depth_at(a, b, p), d.upper + 1e-3) << "seed " << seed;
    }
  }
}

TEST(Depth, ChangesByNoMoreThanTheMove) {
  const Subject a(channel(90'000, 60'000, 40'000, 8'000));
  double before = 0;
  for (int i = 0; i < 15; ++i) {
    const Subject b(cylinder(9, 15'000, 0, 30'000), {20'000, 20'000 + i * 700, 1'000});
    const Depth d = depth_of(a, b,
                             {.threshold = 0,
                              .tolerance = 1,
                              .relative = 0.001,
                              .cells_undecided = 1'000,
                              .cells_decided = 1'000});
    if (i > 0) {
      EXPECT_LE(std::fabs(d.value - before), 700 + d.upper - d.lower + 20);
    }
    before = d.value;
  }
}

/// More triangles than levels are asked of, and no point that counts: the search must not ask the
/// same again.
TEST(Depth, WhatNoLevelDecidesEnds) {
  const IndexedMesh pipe = testing::tube(2500, 1'000'000, 900'000, 0, 500'000);
  const Subject a(pipe), b(pipe, {100, 0, 0});
  const Depth d = testing::depth_of(
      a, b, {.within = a.part.box.as<double>(), .belongs = [](const Vec3d&) { return false; }});
  EXPECT_EQ(d.value, 0);
  EXPECT_GT(d.upper, 40'000);
}

TEST(FaceKdop, AreWhatAWalkOverTheVerticesFinds) {
  for (const int sides : {5, 40, 300}) {
    const Part part = testing::build_part(turned(cylinder(sides, 100'000, -50'000, 90'000)));
    const FaceKdop planes = make_face_kdop(part);
    EXPECT_TRUE(planes.nearly_convex);
    EXPECT_GE(planes.planes.size(), static_cast<std::size_t>(sides));
    for (const FaceKdop::Plane& plane : planes.planes) {
      double most = -1e300;
      for (const Vec3i& v : part.vertices) most = std::max(most, dot(plane.normal, v.as<double>()));
      EXPECT_GE(plane.support, most);
      EXPECT_LE(plane.support, most + 1e-6);
      EXPECT_EQ(planes.vertices.support_along(plane.normal).value, most);
    }
  }
}

TEST(SupportTree, FindsTheFarthestOfAnyPoints) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    // Many equal coordinates: a lattice of a few steps.
    const auto draw = [&](int n) {
      return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(n)) * 1'000'003 -
             1'000'000'000;
    };
    std::vector<Vec3i> points(random() % 400);
    for (Vec3i& p : points) p = {draw(7), draw(900), draw(2)};
    const SupportTree tree(points);
    EXPECT_EQ(tree.empty(), points.empty());
    for (int i = 0; i < 50; ++i) {
      const Vec3d n{draw(1000) * 1e-9, draw(1000) * 1e-9, i % 5 == 0 ? 0 : draw(1000) * 1e-9};
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3i& p : points) most = std::max(most, dot(n, p.as<double>()));
      const SupportTree::SupportPoint found = tree.support_along(n);
      EXPECT_EQ(found.value, most);
      if (!points.empty()) {
        EXPECT_EQ(dot(n, found.vertex.as<double>()), most);
      }
    }
  }
}

TEST(FaceKdop, FlatFacesCountOnceHoweverFinelyCut) {
  // 2 x 40 x 40 squares on two sides of a slab, by hashing; the same slab uncut, by sorting.
  IndexedMesh fine;
  constexpr std::int32_t kCut = 40, kStep = 1000;
  for (std::int32_t x = 0; x < kCut; ++x)
    for (std::int32_t y = 0; y < kCut; ++y) {
      fine.append(testing::quad_mesh({x * kStep, y * kStep, kStep}, {kStep, 0, 0}, {0, kStep, 0}));
      fine.append(testing::quad_mesh({x * kStep, y * kStep, 0}, {0, kStep, 0}, {kStep, 0, 0}));
    }
  const FaceKdop planes = make_face_kdop(Subject(fine).part);
  ASSERT_EQ(planes.planes.size(), 2U);
  EXPECT_EQ(planes.planes[0].normal, (Vec3d{0, 0, -1}));
  EXPECT_EQ(planes.planes[1].normal, (Vec3d{0, 0, 1}));
  EXPECT_NEAR(planes.planes[1].support, kStep, 1e-6);
}

TEST(FaceKdop, NeedlesOfOneFaceMakeOnePlane) {
  // The needles of either end look many ways once they are snapped, none quite along the axis.
  const Part part = testing::build_part(turned(cylinder(3000, 100'000, -5'000, 5'000)));
  const FaceKdop planes = make_face_kdop(part);
  EXPECT_LE(planes.planes.size(), 1024U);
  const Vec3d axis{22.0 / 30, 20.0 / 30, 4.0 / 30};
  int ends = 0;
  for (const FaceKdop::Plane& plane : planes.planes) {
    EXPECT_NEAR(dot(plane.normal, plane.normal), 1, 1e-14);
    double most = -1e300;
    for (const Vec3i& v : part.vertices) most = std::max(most, dot(plane.normal, v.as<double>()));
    EXPECT_GE(plane.support, most);
    EXPECT_LE(plane.support, most + 1e-6);
    const double along = dot(plane.normal, axis);
    ends += along * along > 1 - 1e-10 && plane.support < 5'002 ? 1 : 0;
  }
  EXPECT_EQ(ends, 2);
}

TEST(KdopSeparation, IsNoMoreThanTheDistanceAndNoLessThanTheWidestGap) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const Subject a(turned(cylinder(draw(3, 90), draw(5'000, 40'000), -20'000, 20'000)));
    const Subject b(cylinder(draw(3, 90), draw(5'000, 40'000), -20'000, 20'000),
                    {draw(-90'000, 90'000), draw(-90'000, 90'000), draw(-50'000, 50'000)});
    const FaceKdop pa = make_face_kdop(a.part), pb = make_face_kdop(b.part);
    const double bound = kdop_separation({a.treed(), &pa}, {b.treed(), &pb});
    double widest = -1e300;
    const auto along = [&](const FaceKdop& planes, const Subject& to, const Vec3l& shift) {
      for (const FaceKdop::Plane& p : planes.planes) {
        double least = 1e300;
        for (const Vec3i& v : to.part.vertices)
          least = std::min(least, dot(p.normal, (v.as<std::int64_t>() + shift).as<double>()));
        widest = std::max(widest, least - p.support);
      }
    };
    along(pa, b, b.origin - a.origin);
    along(pb, a, a.origin - b.origin);
    EXPECT_NEAR(bound, widest, 1e-3) << "seed " << seed;
    QueryContext work;
    const bool apart = meet(a.treed(), b.treed(), work).meeting == Meeting::apart;
    if (bound > 0) {
      EXPECT_TRUE(apart);
      EXPECT_GE(find_closest_pair(a.treed(), b.treed(), 1e9, work)->distance, bound);
    } else if (!apart) {
      EXPECT_LE(depth_of(a, b).lower, -bound + 1e-3) << "moving it out by that much parts them";
    }
  }
}

TEST(Depth, ATieNeedsNoSearch) {
  const Subject a(turned(box_mesh({0, 0, -12'000}, {6'000'000, 4'000'000, 0})));
  const Subject b(turned(box_mesh({1'000'000, 500'000, 0}, {2'000'000, 900'000, 700'000})));
  const FaceKdop pa = make_face_kdop(a.part), pb = make_face_kdop(b.part);
  const double gap = kdop_separation({a.treed(), &pa}, {b.treed(), &pb});
  EXPECT_LE(std::fabs(gap), 2);
  const Depth d = depth_of(a, b, {.threshold = 1000, .known_upper = std::max(0.0, -gap)});
  EXPECT_LE(d.upper, 2);
  EXPECT_EQ(d.lower, 0);
}

TEST(SheetDepth, PlateSheetIntoABox) {
  const Subject sheet(testing::quad_mesh({-100'000, 0, 0}, {200'000, 0, 0}, {0, 300'000, 0}));
  const Subject box(box_mesh({-50'000, 250'000, -40'000}, {50'000, 900'000, 60'000}));
  const FaceKdop ps = make_face_kdop(sheet.part), pb = make_face_kdop(box.part);
  QueryContext work;
  const Depth d = sheet_in_solid_depth({sheet.treed(), &ps}, {box.treed(), &pb}, {}, work);
  // The sheet's edge lies 50 mm in, midway between walls 100 mm apart, 40 mm above the bottom.
  EXPECT_LE(d.lower, 40'000);
  EXPECT_GE(d.upper, 40'000);
  EXPECT_LE(d.upper - d.lower, 1000);
}

TEST(SheetDepth, TheWorkLimitGoesByTheWholeOfALargeSheet) {
  // Only what is near the box is searched, and no less thoroughly for that.
  constexpr int kSide = 80;
  IndexedMesh grid;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j)
      grid.vertices.push_back({20'000 * i, 20'000 * j,
                               static_cast<std::int32_t>(9000 * std::sin(0.9 * i) * std::cos(j))});
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const std::uint32_t p = i * (kSide + 1) + j, q = p + kSide + 1;
      grid.triangles.push_back({p, q, q + 1});
      grid.triangles.push_back({p, q + 1, p + 1});
    }
  const Subject sheet(grid), box(box_mesh({801'000, 803'000, -30'000}, {915'000, 907'000, 28'000}));
  const FaceKdop ps = make_face_kdop(sheet.part), pb = make_face_kdop(box.part);
  ASSERT_GE(sheet.part.vertices.size(), kManyVertices);
  QueryContext work;
  const DepthOperand s{sheet.treed(), &ps}, b{box.treed(), &pb};
  const Depth fine = sheet_in_solid_depth(s, b, {.tolerance = 0.5, .relative = 0}, work);
  ASSERT_LE(fine.upper - fine.lower, 0.5);
  const Depth reported = sheet_in_solid_depth(
      s, b, {.threshold = fine.lower - 1, .cells_undecided = 0, .cells_decided = 0}, work);
  EXPECT_GT(reported.lower, fine.lower - 1);
}

TEST(SheetDepth, FromWhereTheWorkLimitEndsTheSearchAPointClimbs) {
  const Subject sheet(testing::quad_mesh({-90'000, -80'000, 0}, {200'000, 0, 0}, {0, 170'000, 0}));
  const Subject rod(cylinder(24, 50'000, -500'000, 500'000));
  const FaceKdop ps = make_face_kdop(sheet.part), pr = make_face_kdop(rod.part);
  QueryContext work;
  const DepthOperand s{sheet.treed(), &ps}, r{rod.treed(), &pr};
  const DepthOptions none{.cells_undecided = 0, .cells_decided = 0};
  const double known = 50'000 * std::cos(std::numbers::pi / 24);
  for (const DepthOptions& goal : {DepthOptions(), none}) {
    const Depth d = sheet_in_solid_depth(s, r, goal, work);
    // The hull of the rod says how deep it may be at most.
    EXPECT_TRUE(d.complete);
    EXPECT_NEAR(d.value, known, 0.01 * known);
    EXPECT_LE(d.upper - d.lower, 0.01 * known + 2);
  }
}

TEST(SheetDepth, StatesWhetherAWorkLimitEndedTheSearch) {
  const Subject sheet(
      testing::quad_mesh({300'000, -40'000, -30'000}, {0, 190'000, 0}, {70'000, 0, 150'000}));
  const Subject u(channel(1'000'000, 100'000, 80'000, 10'000));
  const FaceKdop ps = make_face_kdop(sheet.part), pu = make_face_kdop(u.part);
  QueryContext work;
  const DepthOperand s{sheet.treed(), &ps}, c{u.treed(), &pu};
  const Depth whole = sheet_in_solid_depth(s, c, {}, work);
  EXPECT_TRUE(whole.complete);
  EXPECT_LE(whole.upper - whole.lower, 0.01 * whole.upper);
  const Depth ended = sheet_in_solid_depth(s, c, {.cells_undecided = 0, .cells_decided = 0}, work);
  EXPECT_FALSE(ended.complete);
  EXPECT_FALSE(is_tight(ended, {}, 0.01));
  EXPECT_LE(ended.lower, whole.upper);
  EXPECT_GE(ended.upper, whole.lower);
}

TEST(SheetDepth, SheetsThatCross) {
  const Subject a(testing::quad_mesh({0, 0, 0}, {100'000, 0, 0}, {0, 100'000, 0}));
  const Subject b(testing::quad_mesh({50'000, 20'000, -30'000}, {0, 500'000, 0}, {0, 0, 60'000}));
  QueryContext work;
  const Depth d = sheet_crossing_depth(a.treed(), b.treed(), {}, work);
  // Along x = 50 mm: 30 mm from b's edges above and below, up to 40 mm from a's far edge.
  EXPECT_LE(d.lower, 30'000);
  EXPECT_GE(d.upper, 30'000);
  EXPECT_LE(d.upper - d.lower, 700);
}

/// A strip drawn out along x from 0 to 100 mm over the points of a profile in y and z.
IndexedMesh profile(const std::vector<Vec3i>& points) {
  IndexedMesh mesh;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    mesh.append(testing::quad_mesh(points[i], {100'000, 0, 0}, points[i + 1] - points[i]));
  return mesh;
}

Depth crossing_depth(const IndexedMesh& a, const IndexedMesh& b) {
  const Subject x(a), y(b);
  QueryContext work;
  DepthOptions goal;
  goal.relative = 0;
  return sheet_crossing_depth(x.treed(), y.treed(), goal, work);
}

TEST(SheetDepth, AFlangeInTheSheetsPlaneIsAsDeepAsOneBesideIt) {
  const IndexedMesh floor =
      testing::quad_mesh({-100'000, -100'000, 0}, {300'000, 0, 0}, {0, 300'000, 0});
  for (const std::int32_t z : {-10, 0, 10}) {
    const IndexedMesh web =
        profile({{0, 0, z + 50'000}, {0, 0, z}, {0, 60'000, z}, {0, 60'000, z - 50'000}});
    for (const Depth& d : {crossing_depth(web, floor), crossing_depth(floor, web)}) {
      EXPECT_NEAR(d.value, 50'000, 18) << z;
      EXPECT_LE(d.lower, 50'000);
      EXPECT_GE(d.upper, 49'990);
    }
  }
}

TEST(SheetDepth, ATouchAlongAFoldDoesNotCount) {
  IndexedMesh fold = profile({{0, -50'000, 50'000}, {0, 0, 0}, {0, 50'000, 50'000}});
  const IndexedMesh floor =
      testing::quad_mesh({-100'000, -100'000, 0}, {300'000, 0, 0}, {0, 300'000, 0});
  // A tip that hangs from one rim and goes 0.3 mm through the floor.
  fold.append(
      {{{0, -50'000, 50'000}, {100'000, -50'000, 50'000}, {50'000, -60'000, -300}}, {{0, 1, 2}}});
  const Depth d = crossing_depth(fold, floor);
  EXPECT_GT(d.value, 100);
  EXPECT_LT(d.upper, 310);
}

}  // namespace
}  // namespace strake::geometry
