// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/bounds/inscribed_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "../../support/draw.hpp"
#include "../../support/nonconvex_bodies.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// Half-spaces of an axis-aligned box; weight 1 bounds the ball, weight 0 its centre.
void add_box(std::vector<BallConstraint>& rows, const Box3d& box, double weight) {
  for (int k = 0; k < 3; ++k) {
    Vec3d n;
    n[k] = 1;
    rows.push_back({n, weight, box.hi[k]});
    n[k] = -1;
    rows.push_back({n, weight, -box.lo[k]});
  }
}

std::vector<BallConstraint> ball_in_box(const Box3d& box) {
  std::vector<BallConstraint> rows;
  for (const Vec3d& n : tetrahedral_directions()) {
    double support = -1e300;
    for (unsigned i = 0; i < 8; ++i)
      support = std::max(support, dot(n, Vec3d{(i & 1U) != 0 ? box.lo.x : box.hi.x,
                                               (i & 2U) != 0 ? box.lo.y : box.hi.y,
                                               (i & 4U) != 0 ? box.lo.z : box.hi.z}));
    rows.push_back({n, 1, support});
  }
  add_box(rows, box, 1);
  return rows;
}

TEST(InscribedBallTest, TetrahedralDirectionsAreDualFeasible) {
  Vec3d sum;
  for (const Vec3d& n : tetrahedral_directions()) {
    EXPECT_NEAR(dot(n, n), 1, 1e-15);
    sum = sum + n;
  }
  EXPECT_NEAR(dot(sum, sum), 0, 1e-30);
}

TEST(InscribedBallTest, BallInABoxIsHalfItsShortestSide) {
  const InscribedBall s =
      largest_inscribed_ball({ball_in_box({{-300, -20, -7}, {100, 30, 11}}), 1000});
  EXPECT_TRUE(s.optimal);
  EXPECT_NEAR(s.r, 9, 1e-9);
  EXPECT_NEAR(s.x.z, 2, 1e-9);
  EXPECT_GE(s.upper, 9);
  EXPECT_NEAR(s.upper, 9, 1e-6);
}

TEST(InscribedBallTest, CentreHeldInAnotherBox) {
  // Walls 200 thick that overlap by 50 at their ends: the centre may go 50 deep.
  auto rows = ball_in_box({{0, -100, 0}, {3000, 100, 2500}});
  add_box(rows, {{2950, -100, 0}, {5950, 100, 2500}}, 0);
  const InscribedBall s = largest_inscribed_ball({rows, 6000});
  EXPECT_TRUE(s.optimal);
  EXPECT_NEAR(s.r, 50, 1e-9);
  EXPECT_NEAR(s.x.x, 2950, 1e-9);
}

TEST(InscribedBallTest, BodiesApartHaveANegativeRadius) {
  auto rows = ball_in_box({{0, 0, 0}, {10, 10, 10}});
  add_box(rows, {{20, 20, 20}, {30, 30, 30}}, 0);
  const InscribedBall s = largest_inscribed_ball({rows, 100});
  EXPECT_TRUE(s.optimal);
  EXPECT_LT(s.upper, -9.9);
}

TEST(InscribedBallTest, ContradictionEndsWithoutAnOptimum) {
  auto rows = ball_in_box({{0, 0, 0}, {10, 10, 10}});
  add_box(rows, {{6, 0, 0}, {4, 10, 10}}, 0);
  const InscribedBall s = largest_inscribed_ball({rows, 100});
  EXPECT_FALSE(s.optimal);
}

TEST(InscribedBallTest, AContradictionIsProvedAndNothingElse) {
  const auto rows = ball_in_box({{0, 0, 0}, {10, 10, 10}});
  const auto after = [&](double min_x) {
    const std::span<const BallConstraint> all = rows;
    DualSimplex simplex(all.first<4>(), 100);
    EXPECT_TRUE(simplex.load());
    EXPECT_TRUE(simplex.exchange({{1, 0, 0}, 0, 4}, 4));
    EXPECT_TRUE(simplex.load());
    const BallConstraint opposite{{-1, 0, 0}, 0, -min_x};
    return std::pair(simplex.exchange(opposite, 5), simplex.proves_empty(opposite));
  };
  EXPECT_EQ(after(6), std::pair(false, true));
  EXPECT_EQ(after(4.001), std::pair(false, true));
  // One point is left, to within rounding; and a slab of them.
  EXPECT_FALSE(after(4).second);
  EXPECT_FALSE(after(3).second);
}

/// Random bounded problems against a search over all bases of four rows.
TEST(InscribedBallTest, EqualsTheBestVertexOfSmallProblems) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int n) {
      return static_cast<double>(random() % static_cast<std::uint64_t>(2 * n + 1)) - n;
    };
    auto rows = ball_in_box({{-50 + draw(20), -50 + draw(20), -50 + draw(20)},
                             {50 + draw(20), 50 + draw(20), 50 + draw(20)}});
    for (int i = 0; i < 6; ++i) {
      const Vec3d n{draw(4), draw(4), draw(4)};
      if (n == Vec3d{}) continue;
      rows.push_back({n, i % 2 == 0 ? std::sqrt(dot(n, n)) : 0, 60 + draw(60)});
    }
    const InscribedBall s = largest_inscribed_ball({rows, 1000});
    if (!s.optimal) continue;
    for (const BallConstraint& c : rows)
      EXPECT_LE(dot(c.normal, s.x) + c.weight * s.r, c.offset + 1e-6) << "seed " << seed;
    EXPECT_NEAR(s.upper, s.r, 1e-6) << "seed " << seed;
    EXPECT_GE(s.upper, s.r - 1e-9) << "seed " << seed;
    // Nothing sampled at random beats the certified bound.
    for (int i = 0; i < 200; ++i) {
      const Vec3d x{draw(70), draw(70), draw(70)};
      double r = 1e300;
      for (const BallConstraint& c : rows) {
        const double room = c.offset - dot(c.normal, x);
        r = c.weight > 0 ? std::min(r, room / c.weight) : room < 0 ? -1e300 : r;
        if (r == -1e300) break;
      }
      EXPECT_LE(r, s.upper) << "seed " << seed;
    }
  }
}

/// The planes of a long box, turned and snapped: two triangles of each face, a little askew to each
/// other, that hold the ball's centre, and the same twice over for the ball of two equal bodies.
std::vector<BallConstraint> most_central_of_equals(std::uint64_t seed, double inset) {
  const Mat3d turn = test::Draw(seed).rotation();
  testing::IndexedMesh mesh = testing::box_mesh({}, {3'000'000, 600'000, 320'000});
  for (Vec3i& v : mesh.vertices) {
    const Vec3d p = v.as<double>() - Vec3d{1'500'000, 300'000, 160'000};
    for (int k = 0; k < 3; ++k)
      v[k] = static_cast<std::int32_t>(std::lround(dot(turn.row[static_cast<std::size_t>(k)], p)));
  }
  const auto support = [&](const Vec3d& n) {
    double most = -1e300;
    for (const Vec3i& v : mesh.vertices) most = std::max(most, dot(n, v.as<double>()));
    return most;
  };
  std::vector<BallConstraint> rows, planes;
  for (const Vec3d& n : tetrahedral_directions()) rows.push_back({n, 1, support(n)});
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return mesh.vertices[t[i]].as<double>(); };
    Vec3d n = cross(at(1) - at(0), at(2) - at(0));
    n = n * (1 / std::sqrt(dot(n, n)));
    planes.push_back({n, 1, support(n)});
  }
  for (const BallConstraint& p : planes) rows.push_back({p.normal, 0, p.offset - inset});
  for (int body = 0; body < 2; ++body) rows.insert(rows.end(), planes.begin(), planes.end());
  return rows;
}

TEST(InscribedBallTest, EndsWherePlanesAreNearlyTheSame) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (const double deep : {0.0, 159'000.0, 159'998.0}) {
      const InscribedBall s =
          largest_inscribed_ball({most_central_of_equals(seed, deep), 3'000'000});
      EXPECT_LT(s.steps, 40) << "seed " << seed << ", " << deep << " deep";
      EXPECT_NEAR(s.r, 160'000, 4) << "seed " << seed;
    }
}

}  // namespace
}  // namespace strake::geometry
