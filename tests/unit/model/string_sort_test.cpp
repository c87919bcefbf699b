// SPDX-License-Identifier: Apache-2.0
#include "model/string_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace strake::model {
namespace {

using Order = std::vector<std::uint32_t>;

/// Sorts by plain comparison and checks that sort_strings agrees.
void expect_sorted(const std::vector<std::string>& texts) {
  const std::vector<std::string_view> views(texts.begin(), texts.end());
  Order order(texts.size());
  std::iota(order.begin(), order.end(), 0U);
  Order expected = order;
  std::reverse(order.begin(), order.end());
  std::sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
    return views[a] != views[b] ? views[a] < views[b] : a < b;
  });
  std::vector<std::string> unique = texts;
  std::sort(unique.begin(), unique.end());
  const bool distinct = std::unique(unique.begin(), unique.end()) == unique.end();
  EXPECT_EQ(sort_strings(views, order), distinct);
  EXPECT_EQ(order, expected);
}

TEST(StringSort, EmptyAndSingle) {
  expect_sorted({});
  expect_sorted({""});
  expect_sorted({"a", ""});
}

TEST(StringSort, ZeroBytesAndEndsDiffer) {
  std::vector<std::string> texts;
  for (std::size_t n = 0; n < 40; ++n) {
    texts.push_back(std::string(n % 20, '\0'));
    texts.push_back("a" + std::string(n % 20, '\0') + (n < 20 ? "" : "x"));
  }
  expect_sorted(texts);
}

TEST(StringSort, BytesAboveAsciiComeLast) {
  std::vector<std::string> texts;
  for (int c = 0; c < 256; ++c) texts.push_back(std::string("prefix-") + static_cast<char>(c));
  std::reverse(texts.begin(), texts.end());
  expect_sorted(texts);
}

TEST(StringSort, AgreesWithComparisonOnAnyTexts) {
  for (unsigned number = 1; number <= 200; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    const std::size_t count = random() % 400;
    const auto letters = 1 + random() % 3;
    const std::string prefix(random() % 30, 'p');
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) {
      std::string text = random() % 8 == 0 ? "" : prefix;
      for (std::size_t length = random() % 40; length > 0; --length)
        text.push_back(static_cast<char>(random() % letters + (random() % 50 == 0 ? 200 : 0)));
      texts.push_back(text);
    }
    expect_sorted(texts);
  }
}

TEST(StringSort, ManyCopiesOfLongTexts) {
  const std::vector<std::string> texts(3000, std::string(4000, 'x'));
  expect_sorted(texts);
}

}  // namespace
}  // namespace strake::model
