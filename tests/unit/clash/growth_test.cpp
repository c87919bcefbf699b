// SPDX-License-Identifier: Apache-2.0
// How what a pair costs grows with the pair, in counts, which hold on any machine.
// bench_clash_growth has the times.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "strake/clash/clash.hpp"
#include "support/clash_model.hpp"
#include "support/growing_meshes.hpp"

namespace strake::clash {
namespace {

using geometry::TriangleMesh;
using namespace strake::test;

Report clash_of(TriangleMesh a, TriangleMesh b) {
  ClashModel m;
  m.object("a").body(std::move(a));
  m.object("b").body(std::move(b));
  return m.detect();
}

double exponent(std::uint64_t few, std::uint64_t many, double times) {
  return std::log(static_cast<double>(many) / static_cast<double>(few)) / std::log(times);
}

TEST(ClashGrowth, TwoSurveysOfOneGround) {
  const auto surveys = [](std::uint32_t side) {
    Report report = clash_of(terrain_mesh(side, 1), terrain_mesh(side, 2));
    EXPECT_EQ(report.pairs.size(), 1U);
    EXPECT_EQ(report.pairs.front().cls, Class::hit);
    EXPECT_GT(report.pairs.front().regions, side);
    return report.counters;
  };
  const Counters few = surveys(20), many = surveys(80);
  EXPECT_LT(exponent(few.triangle_pairs, many.triangle_pairs, 16), 1.2);
  EXPECT_LT(exponent(few.depth_cells, many.depth_cells, 16), 1.2);
}

TEST(ClashGrowth, ScatteredTrianglesCostWhatTheirCrossingsCost) {
  const auto scattered = [](std::uint32_t count) {
    Report report = clash_of(scattered_triangles(count, 1), scattered_triangles(count, 2));
    EXPECT_EQ(report.pairs.front().cls, Class::hit);
    return std::pair(report.pairs.front().regions, report.counters);
  };
  const auto [few_places, few] = scattered(25);
  const auto [many_places, many] = scattered(100);
  ASSERT_GT(many_places, 10 * few_places);
  // Sixteen times as many crossings.
  EXPECT_LT(exponent(few.triangle_pairs, many.triangle_pairs, 16), 1.2);
  EXPECT_LT(exponent(few.depth_cells, many.depth_cells, 16), 1.2);
}

}  // namespace
}  // namespace strake::clash
