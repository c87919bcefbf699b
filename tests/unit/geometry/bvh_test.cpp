// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/parallel/team.hpp"

namespace strake::geometry {
namespace {

struct Recipe {
  std::uint64_t seed = 1;
  std::size_t count = 500;
  std::int64_t spread = 100'000, size = 20'000;
  Vec3l origin{};
};

/// Boxes of very unequal size on a coarse lattice, so that many touch exactly; some empty, some of
/// one set, some of a common owner.
std::vector<BoxItem> random_items(const Recipe& recipe) {
  std::mt19937_64 random(recipe.seed);
  const auto draw = [&](std::int64_t n) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
  };
  const std::int64_t step = recipe.spread / 50;
  std::vector<BoxItem> items(recipe.count);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::int64_t size = i % 40 == 0 ? recipe.size * 4 : recipe.size;
    for (int k = 0; k < 3; ++k) {
      items[i].box.lo[k] = recipe.origin[k] + draw(recipe.spread) / step * step;
      items[i].box.hi[k] = items[i].box.lo[k] + draw(size) / step * step;
    }
    if (i % 97 == 0) items[i].box = empty_box<std::int64_t>();
    items[i].owner = static_cast<std::uint32_t>(i / 3);
    items[i].sets = static_cast<std::uint8_t>(draw(4));
  }
  return items;
}

std::vector<IndexPair> by_tree(const std::vector<BoxItem>& items,
                               const parallel::Context& context) {
  const auto tree = SceneBvh::build(items, context);
  EXPECT_TRUE(tree);
  const auto pairs = overlapping_box_pairs(*tree, context);
  EXPECT_TRUE(pairs);
  return *pairs;
}

/// The definition, word by word.
std::vector<IndexPair> by_definition(const std::vector<BoxItem>& items) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < items.size(); ++i)
    for (std::uint32_t j = i + 1; j < items.size(); ++j) {
      const BoxItem &x = items[i], &y = items[j];
      const bool sets =
          ((x.sets & kSetA) && (y.sets & kSetB)) || ((x.sets & kSetB) && (y.sets & kSetA));
      if (sets && x.owner != y.owner && !x.box.empty() && !y.box.empty() && x.box.meets(y.box))
        pairs.push_back({i, j});
    }
  return pairs;
}

TEST(SceneBvh, NothingHasNoPairs) {
  EXPECT_TRUE(by_tree({}, {}).empty());
  EXPECT_TRUE(by_tree({BoxItem{{{0, 0, 0}, {1, 1, 1}}, 0}}, {}).empty());
  EXPECT_TRUE(overlapping_box_pairs_brute_force({}, {})->empty());
}

TEST(SceneBvh, TooManyPairsAreAnErrorForAnyTeam) {
  const std::vector<BoxItem> items = [] {
    std::vector<BoxItem> same;
    for (std::uint32_t i = 0; i < 1000; ++i) same.push_back({{{0, 0, 0}, {10, 10, 10}}, i});
    return same;
  }();
  constexpr std::uint64_t kAll = 1000 * 999 / 2;
  parallel::Team team(3);
  for (const parallel::Context& context : {parallel::Context{}, parallel::Context{.team = &team}}) {
    const auto tree = SceneBvh::build(items, context);
    ASSERT_TRUE(tree);
    EXPECT_EQ(overlapping_box_pairs(*tree, context, kAll)->size(), kAll);
    EXPECT_EQ(overlapping_box_pairs_brute_force(items, context, kAll)->size(), kAll);
    for (const auto& pairs : {overlapping_box_pairs(*tree, context, kAll - 1),
                              overlapping_box_pairs_brute_force(items, context, kAll - 1)}) {
      ASSERT_FALSE(pairs);
      EXPECT_EQ(pairs.error().code, ErrorCode::input);
    }
  }
}

TEST(SceneBvh, TouchingBoxesMeet) {
  const std::vector<BoxItem> items{{{{0, 0, 0}, {10, 10, 10}}, 0},
                                   {{{10, 10, 10}, {20, 20, 20}}, 1},
                                   {{{11, 0, 0}, {20, 9, 9}}, 2}};
  EXPECT_EQ(by_tree(items, {}), (std::vector<IndexPair>{{0, 1}}));
}

TEST(SceneBvh, PairsAreThoseOfTheNestedLoop) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto items = random_items({.seed = seed, .count = 20 + seed * 20});
    const auto expected = by_definition(items);
    EXPECT_GT(expected.size(), 2U);
    EXPECT_EQ(by_tree(items, {}), expected);
    EXPECT_EQ(*overlapping_box_pairs_brute_force(items, {}), expected);
  }
}

TEST(SceneBvh, FarFromTheOriginAndFarApart) {
  const std::int64_t far = std::int64_t{1} << 49;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    auto items = random_items({.seed = seed, .count = 300, .origin = {far, -far, far}});
    const auto more = random_items({.seed = seed + 100, .count = 300, .origin = {-far, far, -far}});
    items.insert(items.end(), more.begin(), more.end());
    EXPECT_EQ(by_tree(items, {}), by_definition(items)) << "seed " << seed;
  }
}

TEST(SceneBvh, ManyEqualBoxesEnd) {
  std::vector<BoxItem> items;
  for (std::uint32_t i = 0; i < 300; ++i) items.push_back({{{0, 0, 0}, {5, 5, 5}}, i});
  EXPECT_EQ(by_tree(items, {}).size(), 300U * 299U / 2);
}

TEST(SceneBvh, SameTreeAndPairsForAnyTeam) {
  const auto items =
      random_items({.seed = 7, .count = 30'000, .spread = 2'000'000, .size = 60'000});
  const auto expected = by_tree(items, {});
  const auto nodes = SceneBvh::build(items, {})->nodes();
  EXPECT_GT(expected.size(), 1000U);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    const parallel::Context context{.team = &team};
    EXPECT_EQ(by_tree(items, context), expected) << threads << " threads";
    const auto other = SceneBvh::build(items, context)->nodes();
    ASSERT_EQ(other.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) ASSERT_EQ(other[i].box, nodes[i].box);
  }
  EXPECT_EQ(*overlapping_box_pairs_brute_force(std::span(items).first(3000), {}),
            by_definition({items.begin(), items.begin() + 3000}));
}

TEST(SceneBvh, StopsWhenRequestedTo) {
  const std::stop_source source;
  source.request_stop();
  const auto items = random_items({});
  const auto tree = SceneBvh::build(items, {.team = nullptr, .stop = source.get_token()});
  ASSERT_FALSE(tree);
  EXPECT_EQ(tree.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::geometry
