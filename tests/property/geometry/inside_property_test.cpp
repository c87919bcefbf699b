// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "strake/geometry/inside.hpp"
#include "strake/geometry/part_pair.hpp"
#include "support/exact_membership.hpp"
#include "support/lattice_solids.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::exact;
using testing::Lattice;
using testing::RationalPoint;

constexpr int kRounds = test::rounds(1500, 100'000);

RationalPoint exact(const ScaledPoint& p) {
  RationalPoint r = testing::exact(p.numerator);
  for (mpq_class& c : r) c /= static_cast<long>(p.denominator);
  return r;
}

ScaledPoint random_point(Lattice& lattice, std::int64_t reach = 3) {
  const std::int64_t d =
      lattice.below(2) == 0 ? 1 : 1 + lattice.below(lattice.below(2) == 0 ? 4 : 4096);
  return {lattice.point(reach * d), d};
}

/// Twice the area of a, b, p in the first two coordinates.
mpq_class area(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// By the edges that a segment to a far point crosses properly; the far point is such that no
/// lattice point lies on the way.
PointSide true_side(const std::vector<std::vector<Vec3l>>& contours, const RationalPoint& p) {
  const RationalPoint far{p[0] + 100'003, p[1] + mpq_class(77'001, 7919) + mpq_class(1, 104'729),
                          0};
  int crossings = 0;
  for (const std::vector<Vec3l>& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const RationalPoint a = exact(contour[i]), b = exact(contour[(i + 1) % contour.size()]);
      const mpq_class here = area(a, b, p);
      if (here == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
          std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]))
        return PointSide::on_boundary;
      const int from = sgn(area(p, far, a)), to = sgn(area(p, far, b));
      EXPECT_NE(from, 0);
      if (from != to && sgn(here) != sgn(area(a, b, far))) ++crossings;
    }
  return crossings % 2 == 1 ? PointSide::inside : PointSide::outside;
}

class InsideProperty : public ::testing::TestWithParam<int> {
 protected:
  Lattice lattice{static_cast<std::uint64_t>(GetParam())};
};

TEST_P(InsideProperty, PointsOfTriangles) {
  int case_counts[8] = {};
  for (int round = 0; round < 4 * kRounds; ++round) {
    TriangleCorners t = lattice.triangle();
    if (!testing::spans(t)) continue;
    ScaledPoint p = random_point(lattice);
    if (lattice.below(2) == 0) {
      // In the plane of the triangle.
      const std::int64_t u = lattice.below(7) - 2, v = lattice.below(7) - 2;
      p = {t[0] * 4 + (t[1] - t[0]) * u + (t[2] - t[0]) * v, 4};
    }
    const FeatureMask place = feature_of(t, p);
    ASSERT_EQ(place, testing::true_place(t, exact(p))) << round;
    ++case_counts[place];
    const testing::GridMotion m = testing::random_motion(lattice, 9);
    if (m.scale > 1 && p.denominator > 4) continue;
    const Vec3l image = testing::turned(p.numerator, m.symmetry) * m.scale;
    const TriangleCorners near = testing::GridMotion{m.symmetry, m.scale, {}}(t);
    ASSERT_EQ(feature_of(near, {image, p.denominator}), place);
  }
  for (const int n : case_counts) EXPECT_GT(n, kRounds / 50);
}

TEST_P(InsideProperty, PointsOfPolygonsWithHoles) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    // Contours that touch, cross, repeat points and double back: the rule is the same.
    std::vector<std::vector<Vec3l>> contours(1 + static_cast<std::size_t>(lattice.below(3)));
    for (auto& contour : contours) {
      contour.resize(static_cast<std::size_t>(lattice.below(8)));
      for (Vec3l& p : contour) p = lattice.point();
    }
    const ScaledPoint p = random_point(lattice);
    const PointSide truth = true_side(contours, exact(p));
    ++case_counts[static_cast<int>(truth)];
    for (int axis = 0; axis < 3; ++axis) {
      // The same picture, so that it is seen along this axis.
      const auto placed = [&](const Vec3l& q) {
        return axis == 0 ? Vec3l{q.z, q.x, q.y} : axis == 1 ? Vec3l{q.y, q.z, q.x} : q;
      };
      std::vector<Vec3l> points;
      std::vector<std::uint32_t> first{0};
      for (const auto& contour : contours) {
        for (const Vec3l& q : contour) points.push_back(placed(q));
        first.push_back(static_cast<std::uint32_t>(points.size()));
      }
      ASSERT_EQ(side_of_polygon(points, first, axis, {placed(p.numerator), p.denominator}), truth);
      // Any sense and any start.
      for (std::size_t c = 0; c + 1 < first.size(); ++c) {
        const auto from = points.begin() + first[c], to = points.begin() + first[c + 1];
        if (lattice.below(2) == 0) std::reverse(from, to);
        if (from != to) std::rotate(from, from + lattice.below(to - from), to);
      }
      ASSERT_EQ(side_of_polygon(points, first, axis, {placed(p.numerator), p.denominator}), truth);
    }
  }
  for (const int n : case_counts) EXPECT_GT(n, kRounds / 50);
}

TEST_P(InsideProperty, PointsOfPolyhedraWithAndWithoutATree) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds / 30; ++round) {
    SCOPED_TRACE(round);
    const testing::LatticeSolid body = testing::random_pair(lattice.rng()).a;
    const testing::Subject subject(body.mesh);
    for (int i = 0; i < 12; ++i) {
      // Anywhere in the box of the body, or on one of its triangles.
      ScaledPoint p{{}, 1 + lattice.below(4)};
      const Box3i& box = subject.part.box;
      for (int k = 0; k < 3; ++k)
        p.numerator[k] =
            box.lo[k] * p.denominator + lattice.below((box.hi[k] - box.lo[k]) * p.denominator + 1);
      if (i % 3 == 0) {
        const Triangle& t = body.mesh.triangles[static_cast<std::size_t>(
            lattice.below(static_cast<std::int64_t>(body.mesh.triangles.size())))];
        p = {{}, 4};
        for (const std::uint32_t v : {t[0], t[0], t[1], t[2]})
          p.numerator = p.numerator + body.mesh.vertices[v].as<std::int64_t>();
      }
      QueryContext work;
      const PointSide side = side_of_polyhedron(subject.part, p);
      ++case_counts[static_cast<int>(side)];
      ASSERT_EQ(side, side_of(subject.treed(), p.numerator, p.denominator, work));
      // On the skin is on a triangle; anything else is in a piece or in none.
      bool on_skin = false, in_piece = false;
      for (const Triangle& t : body.mesh.triangles)
        on_skin |= testing::true_place(TriangleCorners{body.mesh.vertices[t[0]].as<std::int64_t>(),
                                                       body.mesh.vertices[t[1]].as<std::int64_t>(),
                                                       body.mesh.vertices[t[2]].as<std::int64_t>()},
                                       exact(p)) != 0;
      ASSERT_EQ(side == PointSide::on_boundary, on_skin);
      for (const testing::Tetrahedron& t : body.pieces) in_piece |= testing::holds(t, exact(p));
      if (!on_skin) {
        ASSERT_EQ(side == PointSide::inside, in_piece);
      }
    }
  }
  for (const int n : case_counts) EXPECT_GT(n, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, InsideProperty, strake::test::seeds(3));

}  // namespace
}  // namespace strake::geometry
