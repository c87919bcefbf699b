// SPDX-License-Identifier: Apache-2.0
#include "model/string_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "strake/parallel/team.hpp"

namespace strake::model {
namespace {

using Order = std::vector<std::uint32_t>;

/// Sorts by plain comparison and checks that sort_strings agrees.
void expect_sorted(const std::vector<std::string>& texts, const parallel::Context& context = {}) {
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
  const auto sorted = sort_strings(views, order, context);
  ASSERT_TRUE(sorted.has_value());
  EXPECT_EQ(*sorted, distinct);
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

/// Returns texts in which runs of equal keys of all lengths begin anywhere, some longer than what a
/// worker takes at once, and two texts are equal if that is requested.
std::vector<std::string> long_list(unsigned number, bool repeated) {
  std::mt19937 random(number);
  std::vector<std::string> texts;
  while (texts.size() < 150'000) {
    const std::string stem =
        "/SHIP/ZONE-" + std::to_string(random() % 7) + "/" + std::string(random() % 3 * 8, 'e');
    const std::size_t run = random() % 4 == 0 ? 30'000 : random() % 40;
    for (std::size_t i = 0; i < run; ++i)
      texts.push_back(stem + std::to_string(texts.size() * 7919 % 1'000'003) +
                      (i % 5 == 0 ? std::string(i % 3, '\0') : ""));
  }
  if (repeated) texts.push_back(texts[texts.size() / 2]);
  return texts;
}

TEST(StringSort, ALongListComesIntoOneOrderForAnyTeam) {
  for (const bool repeated : {false, true})
    for (const unsigned number : {1U, 2U}) {
      const std::vector<std::string> texts = long_list(number, repeated);
      for (const unsigned workers : {1U, 2U, 3U, 8U}) {
        SCOPED_TRACE(std::to_string(number) + ", workers " + std::to_string(workers));
        parallel::Team team(workers);
        expect_sorted(texts, {.team = &team});
      }
      expect_sorted(texts);
    }
}

TEST(StringSort, ALongListOfEqualTextsIsSortedByIndex) {
  parallel::Team team(3);
  expect_sorted(std::vector<std::string>(100'000, "the same"), {.team = &team});
  expect_sorted(std::vector<std::string>(100'000, ""), {.team = &team});
}

TEST(StringSort, ThatIsCancelledIsAnError) {
  std::vector<std::string_view> texts(100'000, "b");
  texts.back() = "a";
  Order order(texts.size());
  std::iota(order.begin(), order.end(), 0U);
  const std::stop_source stop;
  stop.request_stop();
  const auto sorted = sort_strings(texts, order, {.stop = stop.get_token()});
  ASSERT_FALSE(sorted.has_value());
  EXPECT_EQ(sorted.error().code, ErrorCode::cancelled);
}

TEST(StringSort, ManyCopiesOfLongTexts) {
  const std::vector<std::string> texts(3000, std::string(4000, 'x'));
  expect_sorted(texts);
}

}  // namespace
}  // namespace strake::model
