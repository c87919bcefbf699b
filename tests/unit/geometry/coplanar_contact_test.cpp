// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "../../support/part_builder.hpp"
#include "geometry/intersect/coplanar_faces.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::prism_mesh;
using testing::quad_mesh;
using testing::Subject;

TEST(CoplanarContact, PostOnADeck) {
  const Subject deck(box_mesh({0, 0, 0}, {100, 100, 10}));
  const Subject post(box_mesh({0, 0, 0}, {4, 4, 50}), {40, 60, 10});
  const CoplanarContact c = find_coplanar_contact(deck.treed().placed, post.treed().placed);
  EXPECT_TRUE(c.separated);
  EXPECT_TRUE(c.touching);
  EXPECT_EQ(c.point.z, 10);
}

TEST(CoplanarContact, BoxesThatTouchWithoutTheirBodies) {
  // Two wedges whose boxes share a face, and nothing else.
  const std::array<Vec3i, 3> low{Vec3i{0, 0, 0}, Vec3i{100, 0, 0}, Vec3i{0, 100, 0}};
  const std::array<Vec3i, 3> high{Vec3i{100, 60, 0}, Vec3i{160, 60, 0}, Vec3i{160, 90, 0}};
  const Subject a(prism_mesh(low, 0, 50)), b(prism_mesh(high, 0, 50));
  const CoplanarContact c = find_coplanar_contact(a.treed().placed, b.treed().placed);
  EXPECT_TRUE(c.separated);
  EXPECT_FALSE(c.touching);
}

TEST(CoplanarContact, BoxesThatOverlapStateNothing) {
  const Subject a(box_mesh({0, 0, 0}, {100, 100, 10})), b(box_mesh({0, 0, 9}, {10, 10, 20}));
  EXPECT_FALSE(find_coplanar_contact(a.treed().placed, b.treed().placed).separated);
}

IndexedMesh random_mesh(std::mt19937_64& random) {
  const auto draw = [&](int lo, int hi) {
    return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
  };
  switch (draw(0, 3)) {
    case 0:
      return box_mesh({0, 0, 0}, {draw(1, 5), draw(1, 5), draw(1, 5)});
    case 1: {
      const std::array<Vec3i, 3> corners{Vec3i{0, 0, 0}, Vec3i{draw(1, 5), draw(0, 3), 0},
                                         Vec3i{draw(-1, 2) - 1, draw(3, 6), 0}};
      return prism_mesh(corners, 0, draw(1, 4));
    }
    default:
      return quad_mesh({0, 0, 0}, {draw(1, 4), draw(0, 2), 0}, {0, 0, draw(1, 4)});
  }
}

/// Tiny lattices, where everything touches everything: never another answer than meet() and
/// closest() give.
TEST(CoplanarContact, AgreesWithTheGeneralTests) {
  int separated = 0, touching = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    std::mt19937_64 random(seed);
    const Subject a(random_mesh(random));
    const auto draw = [&](int n) {
      return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)) - n / 2;
    };
    const Subject b(random_mesh(random), {draw(11), draw(11), draw(9)});
    const CoplanarContact c = find_coplanar_contact(a.treed().placed, b.treed().placed);
    QueryContext work;
    const Meeting meeting = meet(a.treed(), b.treed(), work).meeting;
    if (c.separated) {
      ++separated;
      EXPECT_EQ(meeting, c.touching ? Meeting::touching : Meeting::apart) << "seed " << seed;
    }
    if (c.touching) {
      ++touching;
      EXPECT_NEAR(distance_to_surface(a.treed(), c.point), 0, 1e-9) << "seed " << seed;
      EXPECT_NEAR(distance_to_surface(b.treed(), c.point - b.origin.as<double>()), 0, 1e-9)
          << "seed " << seed;
    }
    const FaceKdop pa = make_face_kdop(a.part), pb = make_face_kdop(b.part);
    const double gap = kdop_separation({a.treed(), &pa}, {b.treed(), &pb});
    if (gap > 0) {
      EXPECT_EQ(meeting, Meeting::apart) << "seed " << seed;
    }
    const auto near = find_closest_pair(a.treed(), b.treed(), 1e9, work);
    ASSERT_TRUE(near);
    if (meeting == Meeting::apart) {
      EXPECT_LE(gap, near->distance) << "seed " << seed;
    }
  }
  EXPECT_GT(separated, 500);
  EXPECT_GT(touching, 100);
}

}  // namespace
}  // namespace strake::geometry
