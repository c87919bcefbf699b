// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/contact_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/interior_depth/bounds/convexity.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::quad_mesh;
using testing::Subject;

constexpr std::int32_t kMm = 1000;

/// A closed surface over rings of equally many points, its ends closed by their own rings' fans.
IndexedMesh swept(const std::vector<std::vector<Vec3i>>& rings, bool closed) {
  IndexedMesh m;
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  const auto k = static_cast<std::uint32_t>(rings.size());
  for (const auto& ring : rings) m.vertices.insert(m.vertices.end(), ring.begin(), ring.end());
  for (std::uint32_t r = 0; r + (closed ? 0 : 1) < k; ++r)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = r * n + i, q = r * n + (i + 1) % n;
      const std::uint32_t s = (r + 1) % k * n + i, t = (r + 1) % k * n + (i + 1) % n;
      m.triangles.push_back({p, q, t});
      m.triangles.push_back({p, t, s});
    }
  if (closed) return m;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    m.triangles.push_back({0, i + 1, i});
    m.triangles.push_back({(k - 1) * n, (k - 1) * n + i, (k - 1) * n + i + 1});
  }
  return m;
}

std::vector<Vec3i> circle(double r, double cx, double cy, std::int32_t z, int sides = 16) {
  std::vector<Vec3i> ring;
  for (int i = 0; i < sides; ++i) {
    const double t = 2 * 3.14159265358979 * i / sides;
    ring.push_back({static_cast<std::int32_t>(std::lround(cx + r * std::cos(t))),
                    static_cast<std::int32_t>(std::lround(cy + r * std::sin(t))), z});
  }
  return ring;
}

IndexedMesh pipe(double r, double cx, double cy, std::int32_t z0, std::int32_t z1) {
  return swept({circle(r, cx, cy, z0), circle(r, cx, cy, z1)}, false);
}

/// Outer and inner skin and the two rings between them.
IndexedMesh tube(double outer, double inner, double cx, double cy, std::int32_t z0,
                 std::int32_t z1) {
  return swept({circle(outer, cx, cy, z0), circle(outer, cx, cy, z1), circle(inner, cx, cy, z1),
                circle(inner, cx, cy, z0)},
               true);
}

/// A pipe bent twice by right angles: up, across, down.
IndexedMesh bridge_pipe(std::int32_t r, std::int32_t span, std::int32_t height) {
  const auto ring = [&](std::int32_t x, std::int32_t z, std::int32_t dx, std::int32_t dz) {
    // Mitred: the square ring spans y and the given direction.
    return std::vector<Vec3i>{{x - dx * r, -r, z - dz * r},
                              {x + dx * r, -r, z + dz * r},
                              {x + dx * r, r, z + dz * r},
                              {x - dx * r, r, z - dz * r}};
  };
  return swept(
      {ring(0, 0, 1, 0), ring(0, height, 1, -1), ring(span, height, -1, -1), ring(span, 0, -1, 0)},
      false);
}

struct RegionQuery {
  double reach_mm = 1;
  bool interiors_meet = false;
};

std::vector<ContactRegion> places(const IndexedMesh& a, const IndexedMesh& b,
                                  const RegionQuery& query) {
  const Subject x(a), y(b, {});
  QueryContext work;
  const ContactRegionOptions question{.reach = query.reach_mm * kMm,
                                      .interiors_meet = query.interiors_meet};
  const auto found = contact_regions(x.treed(), y.treed(), question, work);
  const auto turned = contact_regions(y.treed(), x.treed(), question, work);
  EXPECT_TRUE(found && turned);
  if (!found || !turned) return {};
  EXPECT_EQ(found->size(), turned->size());
  return *found;
}

IndexedMesh table(std::int32_t gap) {
  // One mesh of five boxes: they share no vertices, and hang together as one part of five shells.
  IndexedMesh m = box_mesh({0, 0, 700 * kMm}, {1000 * kMm, 600 * kMm, 720 * kMm});
  for (const std::int32_t x : {0, 940})
    for (const std::int32_t y : {0, 540})
      m.append(box_mesh({x * kMm, y * kMm, gap}, {(x + 60) * kMm, (y + 60) * kMm, 700 * kMm}));
  return m;
}

TEST(ContactRegionsTest, FourFeetOnADeck) {
  const IndexedMesh deck =
      box_mesh({-2000 * kMm, -2000 * kMm, -10 * kMm}, {2000 * kMm, 2000 * kMm, 0});
  const auto found = places(table(0), deck, {});
  ASSERT_EQ(found.size(), 4U);
  for (const ContactRegion& p : found) {
    EXPECT_EQ(p.nearest.distance, 0);
    EXPECT_LT(p.extent.hi.x - p.extent.lo.x, 66 * kMm);
    EXPECT_LT(p.extent.hi.z - p.extent.lo.z, 6 * kMm);
  }
  // Half a millimetre above it they stand as near; a reach of less sees none of them.
  EXPECT_EQ(places(table(kMm / 2), deck, {}).size(), 4U);
  EXPECT_TRUE(places(table(kMm / 2), deck, {.reach_mm = 0.4}).empty());
}

TEST(ContactRegionsTest, APipeThroughAWallIsOne) {
  const IndexedMesh wall =
      box_mesh({-1000 * kMm, -1000 * kMm, 0}, {1000 * kMm, 1000 * kMm, 200 * kMm});
  const RegionQuery hit{.interiors_meet = true};
  EXPECT_EQ(places(pipe(50 * kMm, 300 * kMm, 0, -500 * kMm, 700 * kMm), wall, hit).size(), 1U);
  // A hollow one leaves a ring of material in the middle of a triangle of the wall's face.
  EXPECT_EQ(
      places(tube(50 * kMm, 45 * kMm, 400 * kMm, -400 * kMm, -500 * kMm, 700 * kMm), wall, hit)
          .size(),
      1U);
  // Without the material the skins meet in two circles, or four.
  EXPECT_EQ(places(pipe(50 * kMm, 300 * kMm, 0, -500 * kMm, 700 * kMm), wall, {}).size(), 2U);
  EXPECT_EQ(places(tube(50 * kMm, 45 * kMm, 400 * kMm, -400 * kMm, -500 * kMm, 700 * kMm), wall, {})
                .size(),
            4U);
}

TEST(ContactRegionsTest, APipeThatComesBackMeetsTwice) {
  const IndexedMesh wall =
      box_mesh({-1000 * kMm, -1000 * kMm, 100 * kMm}, {3000 * kMm, 1000 * kMm, 110 * kMm});
  const auto found =
      places(bridge_pipe(40 * kMm, 800 * kMm, 600 * kMm), wall, {.interiors_meet = true});
  ASSERT_EQ(found.size(), 2U);
  std::vector<double> from;
  for (const ContactRegion& p : found) from.push_back(p.extent.lo.x);
  std::ranges::sort(from);
  EXPECT_NEAR(from[0], -40 * kMm, 4 * kMm);
  EXPECT_NEAR(from[1], 760 * kMm, 4 * kMm);
}

TEST(ContactRegionsTest, ASheetThroughTwoPipes) {
  IndexedMesh pipes = pipe(50 * kMm, 0, 0, -500 * kMm, 500 * kMm);
  pipes.append(pipe(50 * kMm, 400 * kMm, 0, -500 * kMm, 500 * kMm));
  const IndexedMesh sheet =
      quad_mesh({-900 * kMm, -900 * kMm, 10 * kMm}, {1800 * kMm, 0, 0}, {0, 1800 * kMm, 0});
  EXPECT_EQ(places(pipes, sheet, {.interiors_meet = true}).size(), 2U);
}

TEST(ContactRegionsTest, NothingNearForOneFarInsideTheOther) {
  EXPECT_TRUE(places(box_mesh({0, 0, 0}, {900 * kMm, 900 * kMm, 900 * kMm}),
                     box_mesh({300 * kMm, 300 * kMm, 300 * kMm}, {400 * kMm, 400 * kMm, 400 * kMm}),
                     {.interiors_meet = true})
                  .empty());
}

TEST(ContactRegionsTest, GivesUpWhereThereAreMorePairsThanRequested) {
  const Subject a(pipe(50 * kMm, 0, 0, 0, 500 * kMm)), b(pipe(50 * kMm, 0, 0, 0, 500 * kMm));
  QueryContext work;
  EXPECT_FALSE(
      contact_regions(a.treed(), b.treed(), {.reach = 1 * kMm, .max_pairs = 10}, work).has_value());
}

/// A point stood askew on the grid.
Vec3i askew(const Vec3d& p) {
  return {static_cast<std::int32_t>(std::lround(0.6 * p.x + 0.8 * p.z)),
          static_cast<std::int32_t>(std::lround(p.y)),
          static_cast<std::int32_t>(std::lround(0.6 * p.z - 0.8 * p.x))};
}

/// A disc whose caps are fans of needles from their centres, stood askew on the grid.
IndexedMesh fan_disc(double radius, std::int32_t height, std::uint32_t sectors, const Vec3i& at) {
  IndexedMesh m;
  const auto add = [&](double x, double y, double z) {
    m.vertices.push_back(askew({x + at.x, y + at.y, z + at.z}));
  };
  for (const std::int32_t z : {0, height}) {
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double angle = (2 * 3.14159265358979 * s + 1) / sectors;
      add(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    add(0, 0, z);
  }
  const std::uint32_t up = sectors + 1;
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t n = (s + 1) % sectors;
    m.triangles.push_back({sectors, n, s});
    m.triangles.push_back({up + sectors, up + s, up + n});
    m.triangles.push_back({s, n, up + n});
    m.triangles.push_back({s, up + n, up + s});
  }
  return m;
}

struct FansCase {
  const char* name;
  Vec3i at;
  std::size_t places;
};

std::vector<FansCase> fans_cases() {
  return {{"touching", {0, 0, 20000}, 1},
          {"aside", {150000, 170000, 20000}, 1},
          {"half a unit of reach apart", {150000, 170000, 20500}, 1},
          {"too far apart", {150000, 170000, 22000}, 0}};
}

TEST(ContactRegionsTest, FansOfNeedlesAreReportedAsTriangleByTriangle) {
  for (const FansCase& fans : fans_cases()) {
    SCOPED_TRACE(fans.name);
    const Subject a(fan_disc(500000, 20000, 400, {})), b(fan_disc(400000, 20000, 400, fans.at));
    QueryContext work;
    const ContactRegionOptions question{.reach = 1.0 * kMm};
    const auto found = contact_regions(a.treed(), b.treed(), question, work);
    // Parts without trees are walked triangle by triangle.
    const TriangleBvh none;
    const auto listed =
        contact_regions({a.treed().placed, &none}, {b.treed().placed, &none}, question, work);
    ASSERT_TRUE(found && listed);
    ASSERT_EQ(found->size(), fans.places);
    ASSERT_EQ(listed->size(), fans.places);
    for (std::size_t i = 0; i < found->size(); ++i) {
      EXPECT_EQ((*found)[i].extent.lo, (*listed)[i].extent.lo);
      EXPECT_EQ((*found)[i].extent.hi, (*listed)[i].extent.hi);
      EXPECT_EQ((*found)[i].least, (*listed)[i].least);
      EXPECT_EQ((*found)[i].nearest.distance, (*listed)[i].nearest.distance);
    }
  }
}

TEST(ContactRegionsTest, FansOfTooManyNeedlesAreGivenUpSoon) {
  for (const FansCase& fans : fans_cases()) {
    SCOPED_TRACE(fans.name);
    const Subject a(fan_disc(500000, 20000, 6000, {})), b(fan_disc(400000, 20000, 6000, fans.at));
    const std::size_t triangles = a.part.triangles.size() + b.part.triangles.size();
    QueryContext work;
    const auto found = contact_regions(a.treed(), b.treed(),
                                       {.reach = 1.0 * kMm, .max_pairs = 2 * triangles}, work);
    EXPECT_EQ(found.has_value(), fans.places == 0);
    EXPECT_LE(work.triangle_pairs, 12 * triangles);
    EXPECT_LE(work.node_pairs, 12 * triangles);
  }
}

TEST(ContactRegionsTest, AWideReachIsReportedWithoutAListOfNearTriangles) {
  // Two tubes side by side are far from convex, and nearly all their triangles are near each other.
  const auto one = tube(50 * kMm, 45 * kMm, 0, 0, 0, 400 * kMm);
  const Subject a(one), b(one, {130 * kMm, 0, 0});
  const auto find_regions = [&](SingleRegionDetail what, std::uint64_t most) {
    QueryContext work;
    const auto found = contact_regions(
        a.treed(), b.treed(), {.reach = 300.0 * kMm, .one = what, .max_pairs = most}, work);
    EXPECT_LE(work.triangle_pairs, 5 * (a.part.triangles.size() + b.part.triangles.size()));
    return found;
  };
  for (const SingleRegionDetail what : {SingleRegionDetail::counted, SingleRegionDetail::boxed}) {
    const auto found = find_regions(what, 100);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->size(), 1U);
  }
  EXPECT_FALSE(find_regions(SingleRegionDetail::described, 100).has_value());
}

/// A container with corrugated sides, stood askew on the grid: high needles all round.
IndexedMesh corrugated(std::uint32_t waves, std::int32_t from) {
  constexpr double kStep = 70 * kMm, kDeep = 30 * kMm, kWide = 600 * kMm;
  constexpr std::int32_t kHigh = 1500 * kMm;
  const std::uint32_t steps = 4 * waves, n = 2 * steps;
  IndexedMesh m;
  for (const std::int32_t z : {from, from + kHigh}) {
    const auto add = [&](std::uint32_t i, double side) {
      m.vertices.push_back(askew({kStep * i, side + (i % 4 < 2 ? 0 : kDeep), 1.0 * z}));
    };
    for (std::uint32_t i = 0; i < steps; ++i) add(i, 0);
    for (std::uint32_t i = steps; i-- > 0;) add(i, kWide);
  }
  const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
    m.triangles.push_back({p, q, r});
    m.triangles.push_back({p, r, s});
  };
  for (std::uint32_t i = 0; i < n; ++i) quad(i, (i + 1) % n, n + (i + 1) % n, n + i);
  for (std::uint32_t i = 0; i + 1 < steps; ++i) {
    quad(i, n - 1 - i, n - 2 - i, i + 1);
    quad(n + i, n + i + 1, 2 * n - 2 - i, 2 * n - 1 - i);
  }
  return m;
}

TEST(ContactRegionsTest, CorrugatedContainersOnEachOtherAreOnePlace) {
  for (const std::uint32_t waves : {16U, 32U}) {
    SCOPED_TRACE(waves);
    const Subject a(corrugated(waves, 0)), b(corrugated(waves, 1500 * kMm));
    ASSERT_EQ(a.part.kind, PartKind::solid);
    const auto find_regions = [&](SingleRegionDetail what, QueryContext& work) {
      return contact_regions(a.treed(), b.treed(), {.reach = 1.0 * kMm, .one = what}, work);
    };
    QueryContext work, all;
    const auto boxed = find_regions(SingleRegionDetail::boxed, work);
    const auto described = find_regions(SingleRegionDetail::described, all);
    ASSERT_TRUE(boxed && described);
    ASSERT_EQ(boxed->size(), 1U);
    ASSERT_EQ(described->size(), 1U);
    EXPECT_EQ(boxed->front().extent.lo, described->front().extent.lo);
    EXPECT_EQ(boxed->front().extent.hi, described->front().extent.hi);
    // Boxes along the coordinate axes part needles that stand askew from few others.
    const std::size_t triangles = a.part.triangles.size() + b.part.triangles.size();
    EXPECT_LE(4 * work.triangle_pairs, 7 * triangles);
  }
}

// The far side of a plate thinner than the reach hangs together with the near one through the
// plate.
TEST(ContactRegionsTest, AreTheSameWithoutTrees) {
  const Subject plate(box_mesh({0, 0, 0}, {1000 * kMm, 1000 * kMm, kMm / 2}));
  const Subject block(box_mesh({400 * kMm, 400 * kMm, kMm / 2}, {500 * kMm, 500 * kMm, 90 * kMm}));
  const TriangleBvh none;
  const auto bare = [&](const Subject& s) { return PartWithBvh{s.treed().placed, &none}; };
  const auto count = [](const PartWithBvh& a, const PartWithBvh& b) {
    QueryContext work;
    const auto found = contact_regions(a, b, {.reach = 1.0 * kMm}, work);
    return found ? found->size() : 0;
  };
  EXPECT_EQ(count(plate.treed(), block.treed()), 1U);
  EXPECT_EQ(count(bare(plate), bare(block)), 1U);
  EXPECT_EQ(count(bare(block), bare(plate)), 1U);
}

TEST(ContactRegionsTest, NearlyConvexAllowsForTheSlackAlone) {
  const auto convex = [](const IndexedMesh& mesh, double slack) {
    return nearly_convex(testing::build_part(mesh), slack);
  };
  EXPECT_TRUE(convex(pipe(50 * kMm, 0, 0, 0, 500 * kMm), 4));
  EXPECT_FALSE(convex(tube(50 * kMm, 45 * kMm, 0, 0, 0, 500 * kMm), 250));
  EXPECT_FALSE(convex(bridge_pipe(40 * kMm, 800 * kMm, 600 * kMm), 250));
  // Two convex shells are not a convex part.
  EXPECT_FALSE(convex(table(0), 250));
  EXPECT_FALSE(convex(quad_mesh({0, 0, 0}, {9, 0, 0}, {0, 9, 0}), 250));
  // A dent in the middle of a side.
  IndexedMesh dented = box_mesh({0, 0, 0}, {kMm, kMm, kMm});
  for (Triangle& t : dented.triangles)
    for (std::uint32_t& v : t)
      if (dented.vertices[v] == Vec3i{kMm, kMm, kMm})
        v = static_cast<std::uint32_t>(dented.vertices.size());
  dented.vertices.push_back({kMm - 100, kMm - 100, kMm + 200});
  EXPECT_TRUE(convex(dented, 400));
  EXPECT_FALSE(convex(dented, 50));
}

TEST(ContactRegionsTest, OneFlatPlaceNeedsOneConvexFaceOfEach) {
  const auto one = [](const IndexedMesh& a, const IndexedMesh& b, double reach_mm) {
    const Subject x(a), y(b);
    const OrientedBox f = make_oriented_box(x.part), g = make_oriented_box(y.part);
    const bool found =
        meet_in_one_planar_region({x.treed().placed, &f}, {y.treed().placed, &g}, reach_mm * kMm);
    EXPECT_EQ(found, meet_in_one_planar_region({y.treed().placed, &g}, {x.treed().placed, &f},
                                               reach_mm * kMm));
    return found;
  };
  const IndexedMesh deck =
      box_mesh({-2000 * kMm, -2000 * kMm, -10 * kMm}, {2000 * kMm, 2000 * kMm, 0});
  EXPECT_TRUE(one(tube(50 * kMm, 45 * kMm, 0, 0, -300 * kMm, -10 * kMm), deck, 1) == false);
  EXPECT_TRUE(one(pipe(50 * kMm, 0, 0, 0, 500 * kMm), deck, 1));
  EXPECT_TRUE(one(pipe(50 * kMm, 0, 0, kMm / 2, 500 * kMm), deck, 1));
  EXPECT_FALSE(one(pipe(50 * kMm, 0, 0, 2 * kMm, 500 * kMm), deck, 1));
  EXPECT_FALSE(one(table(0), deck, 1));
  // A second foot that ends just above, still within reach, counts as well.
  IndexedMesh uneven = box_mesh({0, 0, 0}, {100 * kMm, 100 * kMm, 500 * kMm});
  uneven.append(box_mesh({300 * kMm, 0, kMm / 2}, {400 * kMm, 100 * kMm, 500 * kMm}));
  EXPECT_FALSE(one(uneven, deck, 1));
  // So does what leaves the plane at a flat angle.
  const std::vector<Vec3i> foot{
      {0, 0, 0}, {100 * kMm, 0, 0}, {100 * kMm, 100 * kMm, 0}, {0, 100 * kMm, 0}};
  std::vector<Vec3i> wide;
  for (const Vec3i& p : foot) wide.push_back({(p.x - 50 * kMm) * 9, (p.y - 50 * kMm) * 9, 3 * kMm});
  EXPECT_FALSE(one(swept({foot, wide}, false), deck, 1));
  // Interiors that meet have no plane between them.
  EXPECT_FALSE(one(pipe(50 * kMm, 0, 0, -5 * kMm, 500 * kMm), deck, 1));
}

}  // namespace
}  // namespace strake::geometry
