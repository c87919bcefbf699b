// SPDX-License-Identifier: Apache-2.0
// Lines and points of planes against elimination in big rationals, on lattices so small that every
// second case is degenerate, moved to the edges of the range.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "strake/geometry/plane_intersection.hpp"
#include "support/exact_membership.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::exact;
using testing::Lattice;
using testing::RationalPoint;

constexpr int kRounds = test::rounds(2000, 200'000);
constexpr std::int64_t kReach = 2;

/// The equation n · p = c of a plane, c being the last.
using Equation = std::array<mpq_class, 4>;

RationalPoint across(const RationalPoint& u, const RationalPoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

RationalPoint normal_of(const TriangleCorners& t) {
  return across(testing::minus(exact(t[1]), exact(t[0])), testing::minus(exact(t[2]), exact(t[0])));
}

Equation equation_of(const TriangleCorners& t) {
  const RationalPoint n = normal_of(t);
  return {n[0], n[1], n[2], testing::inner(n, exact(t[0]))};
}

/// The rank of the first columns of some equations, by elimination.
std::size_t rank(std::vector<Equation> rows, std::size_t columns) {
  std::size_t done = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    std::size_t pivot = done;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) continue;
    std::swap(rows[pivot], rows[done]);
    for (std::size_t r = done + 1; r < rows.size(); ++r) {
      const mpq_class share = rows[r][column] / rows[done][column];
      for (std::size_t k = 0; k < 4; ++k) rows[r][k] -= share * rows[done][k];
    }
    ++done;
  }
  return done;
}

CommonOfPlanes true_common(const std::vector<TriangleCorners>& planes) {
  std::vector<Equation> rows;
  for (const TriangleCorners& t : planes) rows.push_back(equation_of(t));
  const std::size_t normals = rank(rows, 3);
  if (rank(rows, 4) != normals) return CommonOfPlanes::nothing;
  return normals == 3   ? CommonOfPlanes::point
         : normals == 2 ? CommonOfPlanes::line
                        : CommonOfPlanes::plane;
}

bool lies_in(const RationalPoint& p, const TriangleCorners& t) {
  return testing::inner(normal_of(t), testing::minus(p, exact(t[0]))) == 0;
}

void check_line(const ExactLine& line, const std::vector<TriangleCorners>& planes) {
  const RationalPoint way{mpq_class(testing::big(line.direction.x)),
                          mpq_class(testing::big(line.direction.y)),
                          mpq_class(testing::big(line.direction.z))};
  ASSERT_NE(testing::inner(way, way), 0);
  ASSERT_GT(line.point.denominator.sign(), 0);
  for (const TriangleCorners& t : planes) {
    ASSERT_TRUE(lies_in(exact(line.point), t));
    ASSERT_EQ(testing::inner(way, normal_of(t)), 0);
  }
}

class PlaneIntersectionProperty : public ::testing::TestWithParam<int> {
 protected:
  Lattice lattice{static_cast<std::uint64_t>(GetParam())};

  TriangleCorners plane() {
    TriangleCorners t = lattice.triangle(kReach);
    while (!testing::spans(t)) t = lattice.triangle(kReach);
    return t;
  }
  /// Now and then the same plane by other corners.
  TriangleCorners plane_beside(const TriangleCorners& t) {
    return lattice.below(6) == 0 ? TriangleCorners{t[2], t[1], t[0]} : plane();
  }
};

TEST_P(PlaneIntersectionProperty, TwoPlanes) {
  std::array<int, 4> counts{};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const testing::GridMotion move = testing::random_motion(lattice, kReach);
    const TriangleCorners p = plane(), q = plane_beside(p), a = move(p), b = move(q);
    const TwoPlanes r = intersect_planes(a, b);
    ASSERT_EQ(r.common, true_common({a, b}));
    ++counts[static_cast<std::size_t>(r.common)];
    if (r.common != CommonOfPlanes::line) continue;
    check_line(r.line, {a, b});
    if (HasFatalFailure()) return;
    const RationalPoint way = across(normal_of(a), normal_of(b));
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(mpq_class(testing::big(r.line.direction[k])), way[static_cast<std::size_t>(k)]);
  }
  for (const CommonOfPlanes common :
       {CommonOfPlanes::nothing, CommonOfPlanes::line, CommonOfPlanes::plane})
    EXPECT_GT(counts[static_cast<std::size_t>(common)], 0);
}

TEST_P(PlaneIntersectionProperty, ThreePlanes) {
  std::array<int, 4> counts{};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const testing::GridMotion move = testing::random_motion(lattice, kReach);
    const TriangleCorners p = plane(), q = plane_beside(p);
    const TriangleCorners a = move(p), b = move(q), c = move(plane_beside(q));
    const ThreePlanes r = intersect_planes(a, b, c);
    ASSERT_EQ(r.common, true_common({a, b, c}));
    ++counts[static_cast<std::size_t>(r.common)];
    if (r.common == CommonOfPlanes::line) check_line(r.line, {a, b, c});
    if (HasFatalFailure()) return;
    const ThreePlanes other = intersect_planes(c, a, b), turned = intersect_planes(b, a, c);
    ASSERT_EQ(other.common, r.common);
    ASSERT_EQ(turned.common, r.common);
    if (r.common != CommonOfPlanes::point) continue;
    ASSERT_GT(r.point.denominator.sign(), 0);
    for (const TriangleCorners& t : {a, b, c}) ASSERT_TRUE(lies_in(exact(r.point), t));
    ASSERT_EQ(other.point, r.point);
    ASSERT_EQ(turned.point, r.point);
  }
  for (const CommonOfPlanes common : {CommonOfPlanes::nothing, CommonOfPlanes::point,
                                      CommonOfPlanes::line, CommonOfPlanes::plane})
    EXPECT_GT(counts[static_cast<std::size_t>(common)], 0);
}

/// Corners at random in the whole range, and planes that a unit of it tells from parallel ones.
TEST_P(PlaneIntersectionProperty, TheWholeRange) {
  constexpr std::int64_t kHalf = std::int64_t{1} << 30, kFar = (std::int64_t{1} << 50) - kHalf;
  const auto near_a_corner = [&] {
    const auto along = [&] {
      return (lattice.below(2) == 0 ? -1 : 1) * (kHalf - lattice.below(3));
    };
    const std::int64_t x = along(), y = along(), z = along();
    return Vec3l{x + kFar, y - kFar, z + kFar};
  };
  int points = 0, outside = 0;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    std::vector<TriangleCorners> planes;
    while (planes.size() < 3) {
      const TriangleCorners t{near_a_corner(), near_a_corner(), near_a_corner()};
      const RationalPoint n = normal_of(t);
      if (testing::inner(n, n) != 0) planes.push_back(t);
    }
    const ThreePlanes r = intersect_planes(planes[0], planes[1], planes[2]);
    ASSERT_EQ(r.common, true_common(planes));
    if (r.common != CommonOfPlanes::point) continue;
    ++points;
    for (const TriangleCorners& t : planes) ASSERT_TRUE(lies_in(exact(r.point), t));
    const auto on_grid = nearest_on_grid(r.point);
    if (!on_grid) ++outside;
    const RationalPoint p = exact(r.point);
    for (std::size_t k = 0; on_grid && k < 3; ++k) {
      const mpq_class off = abs(p[k] - exact(*on_grid)[k]);
      ASSERT_LE(off, mpq_class(1, 2));
    }
  }
  EXPECT_GT(points, kRounds / 4);
  EXPECT_GT(outside, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlaneIntersectionProperty, test::seeds(4));

TEST(PlaneIntersection, WallsAndFloorMeetInTheirCorner) {
  const TriangleCorners floor{{{0, 0, 7}, {1, 0, 7}, {0, 1, 7}}};
  const TriangleCorners wall{{{5, 0, 0}, {5, 1, 0}, {5, 0, 1}}};
  const TriangleCorners bulkhead{{{0, -3, 0}, {0, -3, 1}, {1, -3, 0}}};
  const ThreePlanes corner = intersect_planes(floor, wall, bulkhead);
  ASSERT_EQ(corner.common, CommonOfPlanes::point);
  EXPECT_EQ(corner.point, WideRationalPoint(Vec3l{5, -3, 7}));
  EXPECT_EQ(nearest_on_grid(corner.point), (Vec3l{5, -3, 7}));
  const TwoPlanes skirting = intersect_planes(floor, wall);
  ASSERT_EQ(skirting.common, CommonOfPlanes::line);
  EXPECT_EQ(skirting.line.direction, (Vec3<Int128>{0, 1, 0}));
  EXPECT_EQ(skirting.line.point, geometry::RationalPoint(Vec3l{5, 0, 7}));
}

}  // namespace
}  // namespace strake::geometry
