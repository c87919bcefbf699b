// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "strake/geometry/part_pair.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;

struct Expected {
  Meeting meeting;
  bool boundaries_meet, a_within_b, b_within_a;
};

Meeting swapped(Meeting m) {
  if (m == Meeting::a_inside_b) return Meeting::b_inside_a;
  if (m == Meeting::b_inside_a) return Meeting::a_inside_b;
  return m;
}

void check(const Subject& a, const Subject& b, const Expected& expected) {
  QueryContext work;
  const MeetingResult ab = meet(a.treed(), b.treed(), work);
  EXPECT_EQ(ab.meeting, expected.meeting);
  EXPECT_EQ(ab.boundaries_meet, expected.boundaries_meet);
  EXPECT_EQ(ab.a_within_b, expected.a_within_b);
  EXPECT_EQ(ab.b_within_a, expected.b_within_a);
  const MeetingResult ba = meet(b.treed(), a.treed(), work);
  EXPECT_EQ(ba.meeting, swapped(expected.meeting));
  EXPECT_EQ(ba.boundaries_meet, expected.boundaries_meet);
  EXPECT_EQ(ba.a_within_b, expected.b_within_a);
  EXPECT_EQ(ba.b_within_a, expected.a_within_b);
}

void check(const IndexedMesh& a, const IndexedMesh& b, const Expected& expected) {
  for (const Vec3l& origin : {Vec3l{0, 0, 0}, Vec3l{1LL << 45, -(1LL << 44), 12345678901}}) {
    check(Subject(a, origin), Subject(b, origin), expected);
  }
}

const Expected kApart{Meeting::apart, false, false, false};
const Expected kTouching{Meeting::touching, true, false, false};
const Expected kCrossing{Meeting::crossing, true, false, false};

IndexedMesh hollow_box(const Vec3i& lo, const Vec3i& hi, const Vec3i& inner_lo,
                       const Vec3i& inner_hi) {
  IndexedMesh m = box_mesh(lo, hi);
  m.append(box_mesh(inner_lo, inner_hi).flipped());
  return m;
}

/// A block with a square hole through it along z.
IndexedMesh frame(std::int32_t outer, std::int32_t inner, std::int32_t height) {
  IndexedMesh m;
  for (const std::int32_t r : {outer, inner})
    for (const std::int32_t z : {0, height})
      for (const Vec3i& p : {Vec3i{-r, -r, z}, Vec3i{r, -r, z}, Vec3i{r, r, z}, Vec3i{-r, r, z}})
        m.vertices.push_back(p);
  const auto quad = [&m](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    quad(i, j, j + 4, i + 4);            // outer wall
    quad(j + 8, i + 8, i + 12, j + 12);  // hole wall
    quad(j, i, i + 8, j + 8);            // bottom
    quad(i + 4, j + 4, j + 12, i + 12);  // top
  }
  return m;
}

TEST(MeetTest, BoxesApart) {
  check(box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({11, 0, 0}, {20, 10, 10}), kApart);
  // Boxes of the boxes overlap, the bodies do not.
  const std::vector<Vec3i> triangle{{0, 0, 0}, {20, 0, 0}, {0, 20, 0}};
  check(testing::prism_mesh(triangle, 0, 10), box_mesh({11, 11, 0}, {20, 20, 10}), kApart);
}

TEST(MeetTest, BoxesTouchAtFaceEdgeVertex) {
  const IndexedMesh a = box_mesh({0, 0, 0}, {10, 10, 10});
  check(a, box_mesh({10, 0, 0}, {20, 10, 10}), kTouching);
  check(a, box_mesh({10, 3, -4}, {20, 5, 30}), kTouching);
  check(a, box_mesh({10, 10, 0}, {20, 20, 10}), kTouching);
  check(a, box_mesh({10, 10, 10}, {20, 20, 20}), kTouching);
}

TEST(MeetTest, BoxesCross) {
  const IndexedMesh a = box_mesh({0, 0, 0}, {10, 10, 10});
  check(a, box_mesh({9, 9, 9}, {20, 20, 20}), kCrossing);
  // Aligned walls: no vertex of either lies strictly inside the other.
  check(a, box_mesh({5, 0, 0}, {15, 10, 10}), kCrossing);
  check(a, box_mesh({3, 3, -5}, {6, 6, 15}), kCrossing);
}

TEST(MeetTest, DuplicateAndAbuttingInside) {
  const IndexedMesh a = box_mesh({0, 0, 0}, {10, 10, 10});
  check(a, a, {Meeting::crossing, true, true, true});
  check(box_mesh({0, 0, 0}, {5, 10, 10}), a, {Meeting::crossing, true, true, false});
  check(box_mesh({3, 3, 0}, {6, 6, 4}), a, {Meeting::crossing, true, true, false});
}

TEST(MeetTest, NestedWithoutContact) {
  const IndexedMesh a = box_mesh({2, 2, 2}, {8, 8, 8}), b = box_mesh({0, 0, 0}, {10, 10, 10});
  check(a, b, {Meeting::a_inside_b, false, true, false});
  const IndexedMesh hollow = hollow_box({0, 0, 0}, {10, 10, 10}, {1, 1, 1}, {9, 9, 9});
  check(a, hollow, kApart);
  // Exactly filling the cavity touches, without a plane that separates.
  check(box_mesh({1, 1, 1}, {9, 9, 9}), hollow, kTouching);
  check(box_mesh({1, 1, 1}, {5, 9, 9}), hollow, kTouching);
  check(hollow, b, {Meeting::crossing, true, true, false});
  // Between the cavity and the skin: inside the outer box, round the cavity.
  const IndexedMesh thick = hollow_box({0, 0, 0}, {20, 20, 20}, {8, 8, 8}, {12, 12, 12});
  check(box_mesh({4, 4, 4}, {16, 16, 16}), thick, {Meeting::crossing, false, false, false});
  check(hollow_box({4, 4, 4}, {16, 16, 16}, {6, 6, 6}, {14, 14, 14}), thick,
        {Meeting::a_inside_b, false, true, false});
}

TEST(MeetTest, PressFitTouchesAndOversizeCrosses) {
  const IndexedMesh plate = frame(100, 10, 20);
  check(box_mesh({-10, -10, -5}, {10, 10, 25}), plate, kTouching);
  check(box_mesh({-10, -10, 0}, {10, 10, 20}), plate, kTouching);
  check(box_mesh({-9, -9, -5}, {9, 9, 25}), plate, kApart);
  check(box_mesh({-11, -10, -5}, {10, 10, 25}), plate, kCrossing);
}

TEST(MeetTest, EdgesOnFaces) {
  // A convex edge standing on a face.
  const std::vector<Vec3i> roof{{0, 0, 0}, {4, -4, 0}, {4, 4, 0}};
  check(testing::prism_mesh(roof, 2, 8), box_mesh({-10, -10, 0}, {0, 10, 10}), kTouching);
  check(testing::prism_mesh(roof, 2, 8), box_mesh({-10, -10, 0}, {1, 10, 10}), kCrossing);
  // The inner corner of an L, full of material, runs along the middle of a face of the box.
  const IndexedMesh l = frame(10, 5, 10);
  check(l, box_mesh({5, -3, 2}, {8, 3, 8}), {Meeting::crossing, true, false, true});
}

/// A bar bent round to a square ring whose last arm runs through its first.
IndexedMesh ring_through_itself() {
  const std::vector<Vec3i> rim{{0, 0, 0},     {1000, 0, 0},   {1000, 1000, 0}, {0, 1000, 0},
                               {0, -200, 0},  {200, -200, 0}, {200, 800, 0},   {800, 800, 0},
                               {800, 200, 0}, {0, 200, 0}};
  IndexedMesh m;
  for (const std::int32_t z : {0, 100})
    for (const Vec3i& p : rim) m.vertices.push_back(p + Vec3i{0, 0, z});
  const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t t) {
    m.triangles.push_back({p, q, r});
    m.triangles.push_back({p, r, t});
  };
  for (std::uint32_t i = 0; i < 10; ++i) quad(i, (i + 1) % 10, 10 + (i + 1) % 10, 10 + i);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t inner = 9 - i;
    quad(i, inner, inner - 1, i + 1);
    quad(10 + i, 11 + i, 9 + inner, 10 + inner);
  }
  return m;
}

// The wedge touches nothing but an inner face and, with its far corners, the arm's own skin.
TEST(MeetTest, InsideABodyThatRunsThroughItself) {
  const Subject ring(ring_through_itself());
  IndexedMesh wedge;
  wedge.vertices = {{200, 60, 20}, {200, 140, 20}, {400, 200, 50}, {400, 60, 100}};
  wedge.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
  const Subject other(wedge);
  ASSERT_EQ(ring.treed().placed.part->kind, PartKind::solid);
  ASSERT_EQ(other.treed().placed.part->kind, PartKind::solid);
  QueryContext work;
  EXPECT_EQ(meet(ring.treed(), other.treed(), work).meeting, Meeting::crossing);
  EXPECT_EQ(meet(other.treed(), ring.treed(), work).meeting, Meeting::crossing);
}

TEST(MeetTest, SheetAgainstSolid) {
  const IndexedMesh solid = box_mesh({0, 0, 0}, {10, 10, 10});
  const auto sheet = [](std::int32_t z, std::int32_t lo, std::int32_t size) {
    return testing::quad_mesh({lo, lo, z}, {size, 0, 0}, {0, size, 0});
  };
  check(sheet(5, -5, 20), solid, kCrossing);
  check(sheet(5, 2, 5), solid, {Meeting::a_inside_b, false, true, false});
  check(sheet(10, 2, 5), solid, {Meeting::touching, true, true, false});
  check(sheet(10, -5, 20), solid, kTouching);
  check(sheet(12, -5, 20), solid, kApart);
  check(sheet(5, 0, 10), solid, {Meeting::crossing, true, true, false});
  check(sheet(5, -10, 10), solid, kTouching);  // by a corner of the sheet on an edge
}

TEST(MeetTest, SheetAgainstSheet) {
  const IndexedMesh flat = testing::quad_mesh({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  check(flat, testing::quad_mesh({5, 2, -5}, {0, 5, 0}, {0, 0, 10}), kCrossing);
  check(flat, testing::quad_mesh({5, 2, 0}, {0, 5, 0}, {0, 0, 10}), kTouching);
  check(flat, testing::quad_mesh({10, 2, -5}, {0, 5, 0}, {0, 0, 10}), kTouching);
  check(flat, testing::quad_mesh({5, 5, 0}, {10, 0, 0}, {0, 10, 0}), kTouching);
  check(flat, flat, {Meeting::touching, true, true, true});
  check(testing::quad_mesh({2, 2, 0}, {3, 0, 0}, {0, 3, 0}), flat,
        {Meeting::touching, true, true, false});
  check(flat, testing::quad_mesh({0, 0, 3}, {10, 0, 0}, {0, 10, 0}), kApart);
}

TEST(SideOfTest, PointsOnAndOffABox) {
  const Subject box(box_mesh({0, 0, 0}, {10, 10, 10}));
  QueryContext work;
  const auto side = [&](const Vec3l& n, std::int64_t d) {
    return side_of(box.treed(), n, d, work);
  };
  EXPECT_EQ(side({5, 5, 5}, 1), PointSide::inside);
  EXPECT_EQ(side({10, 5, 5}, 1), PointSide::on_boundary);
  EXPECT_EQ(side({10, 10, 10}, 1), PointSide::on_boundary);
  EXPECT_EQ(side({11, 5, 5}, 1), PointSide::outside);
  EXPECT_EQ(side({40959, 5 * 4096, 5 * 4096}, 4096), PointSide::inside);
  EXPECT_EQ(side({40961, 5 * 4096, 5 * 4096}, 4096), PointSide::outside);
  EXPECT_EQ(side({40960, 1, 1}, 4096), PointSide::on_boundary);
}

}  // namespace
}  // namespace strake::geometry
