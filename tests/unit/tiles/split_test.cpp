// SPDX-License-Identifier: Apache-2.0
// Cells fill space, hold what reaches into them, and are as small as requested where that can be.
#include "tiles/split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace strake::tiles {
namespace {

std::vector<Extent> scattered(std::size_t objects) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> place(-1'000'000, 1'000'000), size(0, 90'000);
  std::vector<Extent> extents(objects);
  for (Extent& extent : extents) {
    const geometry::Vec3l lo{place(random), place(random), place(random) / 8};
    extent.box = {lo, lo + geometry::Vec3l{size(random), size(random), size(random)}};
    extent.bytes = 10;
  }
  extents[objects / 2].box = geometry::empty_box<std::int64_t>();
  return extents;
}

bool reaches(const geometry::Box3l& box, const clash::Cell& cell) {
  for (int k = 0; k < 3; ++k)
    if (box.lo[k] >= cell.hi[k] || box.hi[k] < cell.lo[k]) return false;
  return true;
}

TEST(Split, cells_fill_space_and_hold_what_reaches_into_them) {
  const std::vector<Extent> extents = scattered(3000);
  const std::vector<CutCell> cells = cut_space(extents, 2000);
  ASSERT_GT(cells.size(), 15U);
  for (const CutCell& cell : cells) {
    EXPECT_LE(cell.bytes, 2000U);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t o = 0; o < extents.size(); ++o)
      if (!extents[o].box.empty() && reaches(extents[o].box, cell.cell)) expected.push_back(o);
    EXPECT_EQ(cell.objects, expected);
  }
  for (const Extent& extent : extents) {
    if (extent.box.empty()) continue;
    EXPECT_EQ(std::ranges::count_if(
                  cells, [&](const CutCell& c) { return c.cell.contains(extent.box.lo); }),
              1);
  }
}

TEST(Split, what_lies_at_one_place_stays_in_one_cell) {
  std::vector<Extent> extents(500, Extent{{{0, 0, 0}, {1000, 1000, 1000}}, 100});
  EXPECT_EQ(cut_space(extents, 1000).size(), 1U);
  extents.push_back({{{5000, 0, 0}, {6000, 1000, 1000}}, 100});
  const std::vector<CutCell> cells = cut_space(extents, 1000);
  std::size_t largest = 0;
  for (const CutCell& cell : cells) largest = std::max(largest, cell.objects.size());
  EXPECT_LE(cells.size(), 2U);
  EXPECT_GE(largest, 500U);
}

TEST(Split, there_is_a_cell_where_nothing_has_a_place) {
  const std::vector<CutCell> cells = cut_space(std::vector<Extent>(3), 1000);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_TRUE(cells.front().objects.empty());
}

}  // namespace
}  // namespace strake::tiles
