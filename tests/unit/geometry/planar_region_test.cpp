// SPDX-License-Identifier: Apache-2.0
// Two faces of one outline have one place in common, whatever their shape.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/contact_regions/contact_regions.hpp"
#include "support/draw.hpp"
#include "support/part_builder.hpp"
#include "support/rounds.hpp"
#include "support/voxels.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;

constexpr std::int32_t kCell = 10'000;
constexpr std::int32_t kTall = 500'000;

/// Columns over cells of a plane, from z0 on.
IndexedMesh columns(const std::set<Vec3i>& cells, std::int32_t z0) {
  auto [vertices, triangles] = test::voxel_skin({cells.begin(), cells.end()});
  for (Vec3i& v : vertices) v = {v.x * kCell, v.y * kCell, z0 + v.z * kTall};
  return {std::move(vertices), std::move(triangles)};
}

/// Rows of text, a cell for each character that is not blank.
std::set<Vec3i> drawn(const std::vector<std::string_view>& rows) {
  std::set<Vec3i> cells;
  for (std::int32_t y = 0; const std::string_view row : rows) {
    for (std::int32_t x = 0; const char c : row) {
      if (c != ' ') cells.insert({x, y, 0});
      ++x;
    }
    ++y;
  }
  return cells;
}

bool in_one(const IndexedMesh& a, const IndexedMesh& b, double reach) {
  const Subject x(a), y(b);
  const OrientedBox f = make_oriented_box(x.part), g = make_oriented_box(y.part);
  const PartWithObb framed_x{x.treed().placed, &f}, framed_y{y.treed().placed, &g};
  const bool found = meet_in_one_planar_region(framed_x, framed_y, reach);
  EXPECT_EQ(found, meet_in_one_planar_region(framed_y, framed_x, reach));
  return found;
}

/// On end of each other, `gap` apart, the second moved along x.
bool on_end(const std::set<Vec3i>& cells, double reach, std::int32_t gap = 0,
            std::int32_t aside = 0) {
  IndexedMesh above = columns(cells, gap);
  for (Vec3i& v : above.vertices) v.x += aside;
  return in_one(columns(cells, -kTall), above, reach);
}

TEST(PlanarRegionTest, FacesOfOneOutlineAreOnePlace) {
  const auto angle = drawn({"x  ",  //
                            "x  ", "xxx"});
  EXPECT_TRUE(on_end(angle, 1000));
  EXPECT_TRUE(on_end(angle, 1000, 500));
  EXPECT_TRUE(on_end(angle, 1000, 500, 30));
  EXPECT_FALSE(on_end(angle, 1000, 0, 200)) << "not one outline";
  EXPECT_FALSE(on_end(angle, 1000, 1100)) << "out of reach";
  EXPECT_TRUE(on_end(drawn({"xxx", "  x", "  x"}), 9000));
  EXPECT_TRUE(on_end(drawn({"xx", "xx", " x"}), 15'000)) << "across the face itself";
  EXPECT_TRUE(on_end(drawn({"xxx", "x x", "xxx"}), 1000)) << "a ring";
  EXPECT_FALSE(on_end(drawn({"x x", "x x"}), 1000)) << "two feet";
  EXPECT_FALSE(on_end(drawn({"x ", " x"}), 1000)) << "two that touch in an edge";
}

TEST(PlanarRegionTest, ANarrowGapMayHaveAPlaceOfItsOwn) {
  const auto keyhole = drawn({"xxxx",  //
                              "x  x", "xx x"});
  EXPECT_TRUE(on_end(keyhole, 9000));
  EXPECT_FALSE(on_end(keyhole, 11'000));
  EXPECT_FALSE(on_end(drawn({"xxx", "x x", "xxx"}), 11'000)) << "a hole as wide";
}

TEST(PlanarRegionTest, WhatElseReachesThePlaneIsNotForgotten) {
  const auto ring = drawn({"xxx", "x x", "xxx"});
  const IndexedMesh below = columns(ring, -kTall);
  IndexedMesh spike = columns(ring, 0);
  const auto v = static_cast<std::uint32_t>(spike.vertices.size());
  const std::int32_t c = kCell * 3 / 2;
  // A needle in the middle of the hole, its point in the plane.
  for (const Vec3i& p : {Vec3i{c, c, 0}, Vec3i{c - 300, c - 300, 9000},
                         Vec3i{c + 300, c - 300, 9000}, Vec3i{c, c + 300, 9000}})
    spike.vertices.push_back(p);
  for (const Triangle& t : {Triangle{v, v + 2, v + 1}, Triangle{v, v + 3, v + 2},
                            Triangle{v, v + 1, v + 3}, Triangle{v + 1, v + 2, v + 3}})
    spike.triangles.push_back(t);
  EXPECT_TRUE(in_one(below, columns(ring, 0), 1000));
  EXPECT_FALSE(in_one(below, spike, 1000));
}

TEST(PlanarRegionTest, AgreesWithPlacesReportedByTriangles) {
  std::size_t found = 0, several = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds(300U, 20'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const auto some_cells = [&] {
      std::set<Vec3i> cells;
      const std::size_t size = 1 + draw.below(14);
      for (std::size_t i = 0; i < size; ++i) cells.insert({draw.whole(0, 4), draw.whole(0, 4), 0});
      return cells;
    };
    const std::set<Vec3i> cells = some_cells(), others = draw.one_in(3) ? some_cells() : cells;
    const std::int32_t gap = draw.one_in(2) ? 0 : draw.whole(0, 2 * kCell);
    const std::int32_t aside = draw.whole(-20, 20);
    const double reach = gap + draw.between(100, 2 * kCell);
    IndexedMesh above = columns(others, gap);
    for (Vec3i& v : above.vertices) v.x += aside;
    const IndexedMesh below = columns(cells, -kTall);
    const Subject x(below), y(above);
    QueryContext work;
    const auto places = contact_regions(x.treed(), y.treed(), {.reach = reach}, work);
    ASSERT_TRUE(places);
    several += places->size() > 1 ? 1U : 0U;
    if (places->empty() || !in_one(below, above, reach)) continue;
    ++found;
    EXPECT_EQ(places->size(), 1U) << reach << ' ' << gap;
  }
  EXPECT_GT(found, test::rounds(300U, 20'000U) / 15);
  EXPECT_GT(several, test::rounds(300U, 20'000U) / 10);
}

}  // namespace
}  // namespace strake::geometry
