// SPDX-License-Identifier: Apache-2.0
#include "hlr/view/view_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "strake/parallel/team.hpp"

namespace strake::hlr {
namespace {

std::vector<ViewBox> some_boxes(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto pick = [&](std::int64_t limit) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(limit));
  };
  std::vector<ViewBox> boxes(count);
  for (ViewBox& box : boxes) {
    if (pick(20) == 0) continue;  // an empty one
    // Coarse places, so that many centres are equal.
    const ViewPoint lo{pick(50) * 100, pick(20) * 100, pick(10) * 100};
    box.include(lo);
    box.include(lo + ViewPoint{pick(300), pick(300), pick(300)});
  }
  return boxes;
}

std::vector<std::uint32_t> found_by(const ViewBvh& bvh, const ViewBox& box) {
  std::vector<std::uint32_t> found;
  bvh.traverse(anything_in(box), [&](std::uint32_t i) {
    found.push_back(i);
    return true;
  });
  return found;
}

std::vector<std::uint32_t> found_by_all_boxes(std::span<const ViewBox> boxes, const ViewBox& box) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty() && anything_in(box).may_be_hidden_by(rounded_outwards(boxes[i])))
      found.push_back(i);
  return found;
}

TEST(ViewBvh, OfAllWorkersIsTheSame) {
  // Sizes about where subtrees begin to have workers of their own, and where halves are uneven.
  for (const unsigned count : {0U, 1U, 4U, 5U, 9U, 2047U, 2048U, 2049U, 6001U, 20000U}) {
    const std::vector<ViewBox> boxes = some_boxes(count, count + 1);
    const ViewBvh one(boxes);
    for (const unsigned threads : {1U, 3U, 8U}) {
      parallel::Team team(threads);
      const auto all = ViewBvh::of(boxes, {.team = &team});
      ASSERT_TRUE(all);
      EXPECT_EQ(all->order(), one.order());
      for (const ViewBox& query : some_boxes(40, 7)) {
        if (query.empty()) continue;
        EXPECT_EQ(found_by(*all, query), found_by(one, query)) << count << " boxes";
      }
    }
  }
}

TEST(ViewBvh, FindsWhatATestOfAllBoxesFinds) {
  const std::vector<ViewBox> boxes = some_boxes(3000, 5);
  const ViewBvh bvh(boxes);
  for (const ViewBox& query : some_boxes(200, 11)) {
    if (query.empty()) continue;
    std::vector<std::uint32_t> found = found_by(bvh, query);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, found_by_all_boxes(boxes, query));
  }
}

}  // namespace
}  // namespace strake::hlr
