// SPDX-License-Identifier: Apache-2.0
#include "core/union_find.hpp"

#include <gtest/gtest.h>

namespace strake {
namespace {

TEST(UnionFind, roots_are_the_lowest_members_whatever_the_order_of_the_joins) {
  UnionFind forth(6), back(6);
  forth.join(1, 4), forth.join(4, 2), forth.join(5, 3);
  back.join(3, 5), back.join(2, 4), back.join(4, 1);
  for (UnionFind* sets : {&forth, &back}) {
    EXPECT_EQ(sets->root(4), 1U);
    EXPECT_EQ(sets->root(2), 1U);
    EXPECT_EQ(sets->root(5), 3U);
    EXPECT_EQ(sets->root(0), 0U);
    EXPECT_EQ(sets->count(), 3U);
  }
}

TEST(UnionFind, a_join_reports_whether_it_changed_anything) {
  UnionFind sets(3);
  EXPECT_TRUE(sets.join(0, 1));
  EXPECT_FALSE(sets.join(1, 0));
  EXPECT_TRUE(sets.joined(0, 1));
  EXPECT_FALSE(sets.joined(0, 2));
  EXPECT_EQ(sets.count(), 2U);
}

TEST(UnionFind, reset_forgets_all_joins) {
  UnionFind sets(3);
  sets.join(0, 2);
  sets.reset(2);
  EXPECT_FALSE(sets.joined(0, 1));
  EXPECT_EQ(sets.count(), 2U);
  sets.reset(4);
  EXPECT_EQ(sets.root(3), 3U);
  EXPECT_EQ(sets.count(), 4U);
}

}  // namespace
}  // namespace strake
