// SPDX-License-Identifier: Apache-2.0
#include "strake/core/shared_array.hpp"

#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace strake {
namespace {

TEST(SharedArray, NothingIsEmpty) {
  const SharedArray<int> none, made = std::vector<int>{};
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.begin(), none.end());
  EXPECT_EQ(none, made);
  EXPECT_FALSE(none < made);
  EXPECT_TRUE(none.to_vector().empty());
}

TEST(SharedArray, CopiesShareTheirValues) {
  const SharedArray<int> a = std::vector<int>{1, 2, 3};
  const SharedArray<int> b = a;  // NOLINT(performance-unnecessary-copy-initialization): the point
  EXPECT_EQ(a.data(), b.data());
  EXPECT_EQ(b.front(), 1);
  EXPECT_EQ(b.back(), 3);
  std::vector<int> changed = b.to_vector();
  changed[0] = 9;
  EXPECT_EQ(a[0], 1);
}

TEST(SharedArray, OutlivesWhatItWasCopiedFrom) {
  SharedArray<int> kept;
  {
    const SharedArray<int> made{4, 5};
    kept = made;
  }
  EXPECT_EQ(kept.to_vector(), (std::vector<int>{4, 5}));
}

TEST(SharedArray, ComparesByValue) {
  const std::vector<int> values{1, 2};
  const SharedArray<int> a(std::span<const int>{values}), b{1, 2}, longer{1, 2, 3}, higher{1, 3};
  EXPECT_NE(a.data(), b.data());
  EXPECT_EQ(a, b);
  EXPECT_FALSE(a == longer);
  EXPECT_TRUE(a < longer);
  EXPECT_TRUE(longer < higher);
  EXPECT_FALSE(b < a);
}

}  // namespace
}  // namespace strake
