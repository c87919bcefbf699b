// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "strake/geometry/separating_axis.hpp"
#include "strake/geometry/triangle_contact.hpp"
#include "support/exact_membership.hpp"
#include "support/lattice_solids.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::as_mesh;
using testing::big;
using testing::Lattice;

constexpr int kRounds = test::rounds(400, 60'000);

using Points = std::vector<Vec3l>;

/// A gap as its square with a sign, over the squared length of its axis: widths that compare.
mpq_class width_of(const mpz_class& gap, const mpz_class& axis_squared) {
  mpq_class w(gap * abs(gap), axis_squared);
  w.canonicalize();
  return w;
}

mpz_class along(const Vec3<Int128>& axis, const Vec3l& p) {
  return big(axis.x) * static_cast<long>(p.x) + big(axis.y) * static_cast<long>(p.y) +
         big(axis.z) * static_cast<long>(p.z);
}

/// How far b lies beyond a along an axis.
mpz_class gap_along(const Vec3<Int128>& axis, const Points& a, const Points& b) {
  mpz_class high = along(axis, a[0]), low = along(axis, b[0]);
  for (const Vec3l& p : a) high = std::max(high, along(axis, p));
  for (const Vec3l& p : b) low = std::min(low, along(axis, p));
  return low - high;
}

mpq_class width_of(const SeparatingAxis& s) {
  return width_of(big(s.gap), big(s.axis.x) * big(s.axis.x) + big(s.axis.y) * big(s.axis.y) +
                                  big(s.axis.z) * big(s.axis.z));
}

/// That the axis says what it says, and that of overlapping shapes no other is better.
void check_axis(const SeparatingAxis& s, const Points& a, const Points& b) {
  ASSERT_NE(s.axis, Vec3<Int128>{});
  ASSERT_EQ(big(s.gap), gap_along(s.axis, a, b));
  ASSERT_EQ(s.separation == Separation::apart, s.gap > 0);
  ASSERT_EQ(s.separation == Separation::touching, s.gap == 0);
  if (s.separation == Separation::apart) return;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3<Int128> axis{x, y, z};
        ASSERT_LE(width_of(gap_along(axis, a, b), x * x + y * y + z * z), width_of(s));
      }
}

template <class A, class B>
void check_swap(const A& a, const B& b) {
  const SeparatingAxis s = separating_axis(a, b), t = separating_axis(b, a);
  ASSERT_EQ(s.separation, t.separation);
  ASSERT_EQ(s.gap, t.gap);
  if (s.axis != -t.axis) {
    ASSERT_TRUE(s.axis == t.axis && s.axis > Vec3<Int128>{});
  }
}

class SeparatingAxisProperty : public ::testing::TestWithParam<int> {
 protected:
  Lattice lattice{static_cast<std::uint64_t>(GetParam())};
};

TEST_P(SeparatingAxisProperty, TrianglesAgainstDistanceAndContact) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds * 3; ++round) {
    SCOPED_TRACE(round);
    const TriangleCorners t = lattice.triangle(), u = lattice.triangle();
    const SeparatingAxis s = separating_axis(t, u);
    ++case_counts[static_cast<int>(s.separation)];
    check_axis(s, {t.begin(), t.end()}, {u.begin(), u.end()});
    check_swap(t, u);
    ASSERT_EQ(s.separation == Separation::apart,
              testing::squared_distance(as_mesh(t), as_mesh(u)) > 0);
    if (HasFatalFailure()) return;
    if (!testing::spans(t) || !testing::spans(u)) continue;
    const TriangleContact c = contact(ExactTriangle(t), ExactTriangle(u));
    ASSERT_EQ(s.separation == Separation::apart, c.touch == Touch::none);
    ASSERT_EQ(s.separation == Separation::overlapping,
              c.touch == Touch::segment && !c.coplanar && c.edge_a < 0 && c.edge_b < 0);
  }
  for (const int n : case_counts) EXPECT_GT(n, kRounds / 10);
}

/// A box by its corners and as tetrahedra.
struct Parallelepiped {
  GridBox box;
  Points points;
  std::vector<Triangle> triangles;
  std::vector<testing::Tetrahedron> pieces;
};

Parallelepiped make(const GridBox& box) {
  Parallelepiped r{box, {}, {}, {}};
  for (unsigned i = 0; i < 8; ++i) {
    Vec3l p = box.corner;
    for (unsigned k = 0; k < 3; ++k)
      if ((i >> k & 1U) != 0) p = p + box.edge[k];
    r.points.push_back(p);
  }
  // Six tetrahedra round the diagonal from corner 0 to corner 7.
  constexpr std::array<std::uint32_t, 7> kRing{1, 3, 2, 6, 4, 5, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto at = [&](std::uint32_t k) { return r.points[k].as<std::int32_t>(); };
    r.pieces.push_back({at(0), at(kRing[i]), at(kRing[i + 1]), at(7)});
    r.triangles.push_back({0, kRing[i], kRing[i + 1]});
    r.triangles.push_back({kRing[i], kRing[i + 1], 7});
  }
  return r;
}

testing::IndexedMesh skin(const Parallelepiped& p) {
  testing::IndexedMesh mesh;
  for (const Vec3l& v : p.points) mesh.vertices.push_back(v.as<std::int32_t>());
  mesh.triangles = p.triangles;
  return mesh;
}

TEST_P(SeparatingAxisProperty, BoxesAgainstCommonVolumeAndDistance) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds / 5; ++round) {
    SCOPED_TRACE(round);
    const auto random_box = [&] {
      GridBox box{lattice.point(), {}};
      do
        for (Vec3l& e : box.edge) e = lattice.point(2);
      while (dot(box.edge[0], cross(box.edge[1], box.edge[2])) == 0);
      return make(box);
    };
    const Parallelepiped a = random_box(), b = random_box();
    const SeparatingAxis s = separating_axis(a.box, b.box);
    ++case_counts[static_cast<int>(s.separation)];
    check_axis(s, a.points, b.points);
    check_swap(a.box, b.box);
    ASSERT_EQ(s.separation == Separation::overlapping,
              testing::common_volume6(a.pieces, b.pieces) > 0);
    if (s.separation != Separation::overlapping) {
      ASSERT_EQ(s.separation == Separation::apart, testing::squared_distance(skin(a), skin(b)) > 0);
    }
    // As surfaces: more candidates, the same class; overlapping, the same least move.
    const SeparatingAxis surface =
        separating_axis(ConvexSurface{a.points, a.triangles}, ConvexSurface{b.points, b.triangles});
    ASSERT_EQ(surface.separation, s.separation);
    if (s.separation == Separation::apart) {
      ASSERT_GE(width_of(surface), width_of(s));
    } else if (s.separation == Separation::overlapping) {
      ASSERT_EQ(surface.axis, s.axis);
      ASSERT_EQ(surface.gap, s.gap);
    }
    check_swap(ConvexSurface{a.points, a.triangles}, ConvexSurface{b.points, b.triangles});
    if (HasFatalFailure()) return;
  }
  for (const int n : case_counts) EXPECT_GT(n, 0);
}

TEST_P(SeparatingAxisProperty, AxisParallelBoxes) {
  for (int round = 0; round < kRounds * 4; ++round) {
    const auto random_box = [&] {
      Box3l box{lattice.point(), {}};
      box.hi = box.lo;
      box.include(lattice.point());
      return box;
    };
    const Box3l a = random_box(), b = random_box();
    const SeparatingAxis s = separating_axis(a, b);
    ASSERT_EQ(s.separation != Separation::apart, a.meets(b));
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const bool flat_both = a.lo[k] == a.hi[k] && b.lo[k] == b.hi[k];
      inside = inside && !flat_both && a.lo[k] < b.hi[k] && b.lo[k] < a.hi[k];
    }
    ASSERT_EQ(s.separation == Separation::overlapping, inside) << round;
  }
}

/// Points, segments, polygons and bodies against each other.
TEST_P(SeparatingAxisProperty, ConvexShapesOfEveryDimension) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const auto shape = [&](Points& points, std::vector<Triangle>& triangles) {
      const std::int64_t corners = 1 + lattice.below(4);
      for (std::int64_t i = 0; i < corners; ++i) points.push_back(lattice.point(2));
      if (corners >= 3) triangles.push_back({0, 1, 2});
      if (corners == 4) triangles.insert(triangles.end(), {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    };
    Points a, b;
    std::vector<Triangle> of_a, of_b;
    shape(a, of_a);
    shape(b, of_b);
    // A tetrahedron's inside is no part of its triangles: compare with whole tetrahedra.
    const SeparatingAxis s = separating_axis(ConvexSurface{a, of_a}, ConvexSurface{b, of_b});
    ++case_counts[static_cast<int>(s.separation)];
    check_axis(s, a, b);
    const auto mesh = [](const Points& points, const std::vector<Triangle>& triangles) {
      if (triangles.empty()) return as_mesh(points);
      testing::IndexedMesh m;
      for (const Vec3l& p : points) m.vertices.push_back(p.as<std::int32_t>());
      m.triangles = triangles;
      return m;
    };
    const auto solid_holds = [](const Points& body, const Vec3l& p) {
      if (body.size() < 4) return false;
      testing::Tetrahedron t;
      for (std::size_t i = 0; i < 4; ++i) t[i] = body[i].as<std::int32_t>();
      const Vec3l u = body[1] - body[0], v = body[2] - body[0], w = body[3] - body[0];
      return dot(cross(u, v), w) != 0 && testing::holds(t, testing::exact(p));
    };
    const bool meet = testing::squared_distance(mesh(a, of_a), mesh(b, of_b)) == 0 ||
                      solid_holds(a, b[0]) || solid_holds(b, a[0]);
    ASSERT_EQ(s.separation != Separation::apart, meet);
    if (HasFatalFailure()) return;
    const testing::GridMotion m = testing::random_motion(lattice, 2);
    Points ma, mb;
    for (const Vec3l& p : a) ma.push_back(m(p));
    for (const Vec3l& p : b) mb.push_back(m(p));
    const SeparatingAxis t = separating_axis(ConvexSurface{ma, of_a}, ConvexSurface{mb, of_b});
    ASSERT_EQ(t.separation, s.separation);
    if (s.separation == Separation::overlapping) {
      ASSERT_EQ(width_of(t), width_of(s) * static_cast<long>(m.scale) * static_cast<long>(m.scale));
    }
  }
  for (const int n : case_counts) EXPECT_GT(n, kRounds / 50);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SeparatingAxisProperty, strake::test::seeds(3));

}  // namespace
}  // namespace strake::geometry
