// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/near_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace strake::page {
namespace {

using geometry::Box3l;
using geometry::Vec3d;
using geometry::Vec3l;

/// Whether a box comes within the reach of a point: all points are tried.
bool is_near_any(const std::vector<Vec3d>& points_mm, std::int64_t reach, const Box3l& box) {
  return std::ranges::any_of(points_mm, [&](const Vec3d& p) {
    const Vec3l at = (p * 1000.0).as<std::int64_t>();
    return box.inflated(reach).contains({at, at});
  });
}

TEST(NearPoints, FindsWhatTryingAllFinds) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(-20'000, 20'000), size(0, 3'000);
  std::vector<Vec3d> points;
  for (int i = 0; i < 40; ++i)
    points.push_back(Vec3l{place(random), place(random), place(random)}.as<double>());
  const NearPoints near(points, 2000);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3l lo = Vec3l{place(random), place(random), place(random)} * 1000;
    // Some boxes are over nearly all of it.
    const std::int64_t most = i % 10 == 0 ? 9'000 : 1'000;
    const Box3l box{lo, lo + Vec3l{size(random), size(random), size(random)} * most};
    const bool expected = is_near_any(points, 2'000'000, box);
    found += expected ? 1 : 0;
    EXPECT_EQ(near.is_near(box), expected) << i;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 2900);
}

TEST(NearPoints, ReachesExactly) {
  const NearPoints near(std::vector<Vec3d>{{0, 0, 0}}, 2000);
  EXPECT_TRUE(near.is_near({{2'000'000, 0, 0}, {3'000'000, 1, 1}}));
  EXPECT_FALSE(near.is_near({{2'000'001, 0, 0}, {3'000'000, 1, 1}}));
  EXPECT_TRUE(near.is_near({{-3'000'000, 0, 0}, {-2'000'000, 1, 1}}));
  EXPECT_FALSE(near.is_near({{-3'000'000, 0, 0}, {-2'000'001, 1, 1}}));
}

TEST(NearPoints, WithoutPlacesNothingIsNear) {
  const Vec3d nowhere{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  EXPECT_FALSE(NearPoints({}, 2000).is_near({{0, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(NearPoints(std::vector<Vec3d>{nowhere}, 2000).is_near({{0, 0, 0}, {1, 1, 1}}));
}

}  // namespace
}  // namespace strake::page
