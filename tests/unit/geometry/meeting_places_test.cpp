// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/meeting_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

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

struct Asked {
  double reach_mm = 1;
  bool interiors_meet = false;
};

std::vector<MeetingPlace> places(const IndexedMesh& a, const IndexedMesh& b, const Asked& asked) {
  const Subject x(a), y(b, {});
  PairWork work;
  const PlacesQuestion question{.reach = asked.reach_mm * kMm,
                                .interiors_meet = asked.interiors_meet};
  const auto found = meeting_places(x.treed(), y.treed(), question, work);
  const auto turned = meeting_places(y.treed(), x.treed(), question, work);
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

TEST(MeetingPlacesTest, FourFeetOnADeck) {
  const IndexedMesh deck =
      box_mesh({-2000 * kMm, -2000 * kMm, -10 * kMm}, {2000 * kMm, 2000 * kMm, 0});
  const auto found = places(table(0), deck, {});
  ASSERT_EQ(found.size(), 4U);
  for (const MeetingPlace& p : found) {
    EXPECT_EQ(p.nearest.distance, 0);
    EXPECT_LT(p.extent.hi.x - p.extent.lo.x, 66 * kMm);
    EXPECT_LT(p.extent.hi.z - p.extent.lo.z, 6 * kMm);
  }
  // Half a millimetre above it they stand as near; a reach of less sees none of them.
  EXPECT_EQ(places(table(kMm / 2), deck, {}).size(), 4U);
  EXPECT_TRUE(places(table(kMm / 2), deck, {.reach_mm = 0.4}).empty());
}

TEST(MeetingPlacesTest, APipeThroughAWallIsOne) {
  const IndexedMesh wall =
      box_mesh({-1000 * kMm, -1000 * kMm, 0}, {1000 * kMm, 1000 * kMm, 200 * kMm});
  const Asked hit{.interiors_meet = true};
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

TEST(MeetingPlacesTest, APipeThatComesBackMeetsTwice) {
  const IndexedMesh wall =
      box_mesh({-1000 * kMm, -1000 * kMm, 100 * kMm}, {3000 * kMm, 1000 * kMm, 110 * kMm});
  const auto found =
      places(bridge_pipe(40 * kMm, 800 * kMm, 600 * kMm), wall, {.interiors_meet = true});
  ASSERT_EQ(found.size(), 2U);
  std::vector<double> from;
  for (const MeetingPlace& p : found) from.push_back(p.extent.lo.x);
  std::ranges::sort(from);
  EXPECT_NEAR(from[0], -40 * kMm, 4 * kMm);
  EXPECT_NEAR(from[1], 760 * kMm, 4 * kMm);
}

TEST(MeetingPlacesTest, ASheetThroughTwoPipes) {
  IndexedMesh pipes = pipe(50 * kMm, 0, 0, -500 * kMm, 500 * kMm);
  pipes.append(pipe(50 * kMm, 400 * kMm, 0, -500 * kMm, 500 * kMm));
  const IndexedMesh sheet =
      quad_mesh({-900 * kMm, -900 * kMm, 10 * kMm}, {1800 * kMm, 0, 0}, {0, 1800 * kMm, 0});
  EXPECT_EQ(places(pipes, sheet, {.interiors_meet = true}).size(), 2U);
}

TEST(MeetingPlacesTest, NothingNearForOneFarInsideTheOther) {
  EXPECT_TRUE(places(box_mesh({0, 0, 0}, {900 * kMm, 900 * kMm, 900 * kMm}),
                     box_mesh({300 * kMm, 300 * kMm, 300 * kMm}, {400 * kMm, 400 * kMm, 400 * kMm}),
                     {.interiors_meet = true})
                  .empty());
}

TEST(MeetingPlacesTest, GivesUpWhereThereAreMorePairsThanAskedFor) {
  const Subject a(pipe(50 * kMm, 0, 0, 0, 500 * kMm)), b(pipe(50 * kMm, 0, 0, 0, 500 * kMm));
  PairWork work;
  EXPECT_FALSE(
      meeting_places(a.treed(), b.treed(), {.reach = 1 * kMm, .most_pairs = 10}, work).has_value());
}

TEST(MeetingPlacesTest, AWideReachIsToldWithoutAListOfNearTriangles) {
  // Two tubes side by side are far from convex, and nearly all their triangles are near each other.
  const auto one = tube(50 * kMm, 45 * kMm, 0, 0, 0, 400 * kMm);
  const Subject a(one), b(one, {130 * kMm, 0, 0});
  const auto ask = [&](OnePlace what, std::uint64_t most) {
    PairWork work;
    const auto found = meeting_places(
        a.treed(), b.treed(), {.reach = 300.0 * kMm, .one = what, .most_pairs = most}, work);
    EXPECT_LE(work.triangle_pairs, 5 * (a.part.triangles.size() + b.part.triangles.size()));
    return found;
  };
  for (const OnePlace what : {OnePlace::counted, OnePlace::boxed}) {
    const auto found = ask(what, 100);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->size(), 1U);
  }
  EXPECT_FALSE(ask(OnePlace::described, 100).has_value());
}

TEST(MeetingPlacesTest, NearlyConvexAllowsForTheSlackAlone) {
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

TEST(MeetingPlacesTest, OneFlatPlaceNeedsOneConvexFaceOfEach) {
  const auto one = [](const IndexedMesh& a, const IndexedMesh& b, double reach_mm) {
    const Subject x(a), y(b);
    const PartFrame f = make_frame(x.part), g = make_frame(y.part);
    const bool found =
        in_one_flat_place({x.treed().placed, &f}, {y.treed().placed, &g}, reach_mm * kMm);
    EXPECT_EQ(found,
              in_one_flat_place({y.treed().placed, &g}, {x.treed().placed, &f}, reach_mm * kMm));
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
