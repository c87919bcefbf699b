// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "strake/geometry/closest.hpp"
#include "support/exact_membership.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::as_mesh;
using testing::exact;
using testing::Lattice;

constexpr int kRounds = test::rounds(700, 60'000);

using Point = std::array<Vec3l, 1>;

ClosestPoints closest(const Point& a, const Point& b) { return closest_points(a[0], b[0]); }
template <std::size_t N>
ClosestPoints closest(const Point& a, const std::array<Vec3l, N>& b) {
  return closest_points(a[0], b);
}
template <class A, class B>
ClosestPoints closest(const A& a, const B& b) {
  return closest_points(a, b);
}

/// The corners that a place names.
template <class Shape>
std::vector<testing::RationalPoint> feature(const Shape& shape, FeatureMask place) {
  std::vector<testing::RationalPoint> r;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if ((place >> i & 1U) != 0) r.push_back(exact(shape[i]));
  return r;
}

template <class Shape>
bool strictly_on(const Shape& shape, FeatureMask place, const RationalPoint& p) {
  const auto corners = feature(shape, place);
  if (corners.empty()) return false;
  const auto w = testing::weights(corners, exact(p));
  return w && std::ranges::all_of(*w, [](const mpq_class& x) { return x > 0; });
}

template <class A, class B>
void check(const A& a, const B& b) {
  const ClosestPoints c = closest(a, b);
  ASSERT_EQ(exact(c.squared), testing::squared_distance(as_mesh(a), as_mesh(b)));
  const auto gap = testing::minus(exact(c.on_b), exact(c.on_a));
  ASSERT_EQ(testing::inner(gap, gap), exact(c.squared));
  ASSERT_TRUE(strictly_on(a, c.feature_a, c.on_a));
  ASSERT_TRUE(strictly_on(b, c.feature_b, c.on_b));
}

template <class A, class B>
void check_motion(const A& a, const B& b, Lattice& lattice) {
  const testing::GridMotion m = testing::random_motion(lattice, 3);
  const ClosestPoints c = closest(a, b), moved = closest(m(a), m(b));
  const mpq_class scale(static_cast<long>(m.scale));
  ASSERT_EQ(exact(moved.squared), exact(c.squared) * scale * scale);
  ASSERT_EQ(moved.feature_a, c.feature_a);
  ASSERT_EQ(moved.feature_b, c.feature_b);
  ASSERT_TRUE(strictly_on(m(a), moved.feature_a, moved.on_a));
  const auto gap = testing::minus(exact(moved.on_b), exact(moved.on_a));
  ASSERT_EQ(testing::inner(gap, gap), exact(moved.squared));
}

class ClosestProperty : public ::testing::TestWithParam<int> {};

TEST_P(ClosestProperty, NormalEquationsInRationalsAgree) {
  Lattice lattice(static_cast<std::uint64_t>(GetParam()));
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const Point p{lattice.point()}, q{lattice.point()};
    const Segment s = lattice.segment(), r = lattice.segment();
    const TriangleCorners t = lattice.triangle(), u = lattice.triangle();
    check(p, q);
    check(p, s);
    check(p, t);
    check(s, r);
    check(s, t);
    check(t, u);
    if (HasFatalFailure()) return;
  }
}

TEST_P(ClosestProperty, MotionsOfTheGridKeepTheAnswerAtTheEdgeOfTheRange) {
  Lattice lattice(static_cast<std::uint64_t>(GetParam() + 100));
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const Point p{lattice.point()};
    const Segment s = lattice.segment(), r = lattice.segment();
    const TriangleCorners t = lattice.triangle(), u = lattice.triangle();
    check_motion(p, s, lattice);
    check_motion(p, t, lattice);
    check_motion(s, r, lattice);
    check_motion(s, t, lattice);
    check_motion(t, u, lattice);
    if (HasFatalFailure()) return;
    ASSERT_EQ(closest_points(s, r).squared, closest_points(r, s).squared);
    ASSERT_EQ(closest_points(t, u).squared, closest_points(u, t).squared);
    ASSERT_EQ(closest_points(s, t).squared,
              closest_points(Segment{s[1], s[0]}, TriangleCorners{t[1], t[0], t[2]}).squared);
  }
}

TEST_P(ClosestProperty, PointAndBox) {
  Lattice lattice(static_cast<std::uint64_t>(GetParam() + 200));
  for (int round = 0; round < 4 * kRounds; ++round) {
    Box3l box{lattice.point(), {}};
    box.hi = box.lo;
    box.include(lattice.point());
    const Vec3l p = lattice.point(5);
    const ClosestOnBox c = closest_points(p, box);
    // By looking at every lattice point of the box.
    std::int64_t least = INT64_MAX;
    for (std::int64_t x = box.lo.x; x <= box.hi.x; ++x)
      for (std::int64_t y = box.lo.y; y <= box.hi.y; ++y)
        for (std::int64_t z = box.lo.z; z <= box.hi.z; ++z) {
          const Vec3l d = Vec3l{x, y, z} - p;
          least = std::min(least, dot(d, d));
        }
    ASSERT_EQ(exact(c.squared), mpq_class(static_cast<long>(least)));
    const Vec3l d = c.on_box - p;
    ASSERT_EQ(dot(d, d), least);
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ((c.place >> (2 * k) & 1) != 0, c.on_box[k] == box.lo[k]);
      ASSERT_EQ((c.place >> (2 * k + 1) & 1) != 0, c.on_box[k] == box.hi[k]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClosestProperty, strake::test::seeds(3));

TEST(Closest, PlacesAreExactWhereDoublesAreNot) {
  // The foot of (1, 0, 0) on the line through (0, 0, 0) and (1, 2, 3) is a fourteenth of it.
  const ClosestPoints c = closest_points(Vec3l{1, 0, 0}, Segment{Vec3l{0, 0, 0}, Vec3l{1, 2, 3}});
  EXPECT_EQ(c.feature_b, 3);
  EXPECT_EQ(exact(c.on_b)[0], mpq_class(1, 14));
  EXPECT_EQ(exact(c.squared), mpq_class(13, 14));
  EXPECT_EQ(c.squared.distance(), std::sqrt(13.0 / 14.0));
}

}  // namespace
}  // namespace strake::geometry
