// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "strake/geometry/part_pair.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::Subject;

TEST(ClosestTest, BoxesAtAGap) {
  QueryContext work;
  const Subject a(box_mesh({0, 0, 0}, {10, 10, 10}));
  const Subject face(box_mesh({17, 2, 2}, {20, 8, 8}));
  const auto r = find_closest_pair(a.treed(), face.treed(), 100, work);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->squared, 49);
  EXPECT_EQ(r->distance, 7);
  EXPECT_EQ(r->on_a.x, 10);
  EXPECT_EQ(r->on_b.x, 17);
  EXPECT_EQ(r->on_a.y, r->on_b.y);
  EXPECT_FALSE(find_closest_pair(a.treed(), face.treed(), 7, work));
  EXPECT_TRUE(find_closest_pair(a.treed(), face.treed(), std::nextafter(7.0, 8.0), work));

  const Subject corner(box_mesh({12, 13, 16}, {20, 20, 20}));
  const auto c = find_closest_pair(a.treed(), corner.treed(), INFINITY, work);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->squared, 4 + 9 + 36);
  EXPECT_EQ(c->on_a, (Vec3d{10, 10, 10}));
  EXPECT_EQ(c->on_b, (Vec3d{12, 13, 16}));
}

TEST(ClosestTest, ZeroWhenTheSurfacesMeet) {
  QueryContext work;
  const Subject a(box_mesh({0, 0, 0}, {10, 10, 10}));
  const Subject touching(box_mesh({10, 10, 5}, {20, 20, 8}));
  const auto r = find_closest_pair(a.treed(), touching.treed(), 1, work);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->squared, 0);
  EXPECT_EQ(r->on_a, r->on_b);
  EXPECT_EQ(r->on_a.x, 10);
  EXPECT_EQ(r->on_a.y, 10);
  // Nested without contact: the distance of the surfaces.
  const Subject inside(box_mesh({3, 4, 4}, {6, 6, 6}));
  EXPECT_EQ(find_closest_pair(a.treed(), inside.treed(), INFINITY, work)->squared, 9);
}

TEST(ClosestTest, EdgesAcrossAndFarOrigins) {
  QueryContext work;
  // Two skew edges: (-10..10, 0, 0) and (0, -10..10, 5), as the ridges of two roofs.
  const std::array<Vec3i, 3> section{Vec3i{0, 0, 0}, {-4, -8, 0}, {4, -8, 0}};
  testing::IndexedMesh low = testing::prism_mesh(section, -10, 10);
  for (Vec3i& v : low.vertices) v = {v.z, v.x, v.y};
  testing::IndexedMesh high = low;
  for (Vec3i& v : high.vertices) v = {v.y, v.x, -v.z};
  const Subject a(low, {1LL << 49, -5, 7}), b(high, {1LL << 49, -5, 12});
  const auto r = find_closest_pair(a.treed(), b.treed(), INFINITY, work);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->squared, 25);
  EXPECT_EQ(r->on_a, (Vec3d{0, 0, 0}));
  EXPECT_EQ(r->on_b, (Vec3d{0, 0, 5}));
}

TEST(DistanceToSurfaceTest, InsideOutsideAndLimit) {
  const Subject a(box_mesh({0, 0, 0}, {10, 10, 10}));
  EXPECT_EQ(distance_to_surface(a.treed(), {5, 5, 8}), 2);
  EXPECT_EQ(distance_to_surface(a.treed(), {13, 14, 5}), 5);
  EXPECT_EQ(distance_to_surface(a.treed(), {10, 10, 5}), 0);
  EXPECT_EQ(distance_to_surface(a.treed(), {13, 14, 5}, 3), 3);
}

}  // namespace
}  // namespace strake::geometry
