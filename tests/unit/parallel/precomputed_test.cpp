// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/precomputed.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

TEST(Precomputed, makes_what_is_wanted_once_and_nothing_else) {
  for (const unsigned threads : {1U, 2U, 8U, 64U}) {
    Team team(threads);
    Precomputed<std::string> table(1000);
    EXPECT_EQ(table.size(), 1000U);
    EXPECT_EQ(table.find(3), nullptr);
    std::vector<std::atomic<int>> made(1000);
    const auto make = [&](std::size_t key) {
      ++made[key];
      return std::to_string(key);
    };
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t k = 0; k < 3000; ++k) wanted.push_back(k * 7 % 500 * 2);
    ASSERT_TRUE(table.fill({.team = &team}, {.name = "fill"}, wanted, make));
    // Some of what is there already, some not, by weight.
    std::vector<std::uint32_t> more;
    for (std::uint32_t k = 0; k < 1000; k += 3) more.push_back(k);
    ASSERT_TRUE(table.fill_by_weight(
        {.team = &team}, {.name = "more"}, 100.0, more,
        [](std::size_t key) { return key == 3 ? 1e6 : 1.0; }, make));
    for (std::size_t key = 0; key < 1000; ++key) {
      const bool there = key % 2 == 0 || key % 3 == 0;
      ASSERT_EQ(made[key], there ? 1 : 0) << key;
      ASSERT_EQ(table.find(key) != nullptr, there) << key;
      if (there) {
        EXPECT_EQ(*table.find(key), std::to_string(key));
      }
    }
  }
}

TEST(Precomputed, nothing_can_be_found_of_a_fill_that_failed) {
  Team team(3);
  Precomputed<int> table(10);
  const std::vector<std::uint32_t> first{1, 2}, second{2, 3, 4};
  ASSERT_TRUE(table.fill({.team = &team}, {.name = "good"}, first, [](std::size_t) { return 5; }));
  const Status failed =
      table.fill({.team = &team}, {.name = "bad"}, second, [](std::size_t key) -> int {
        if (key == 4) throw std::runtime_error("key 4");
        return 6;
      });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "key 4");
  EXPECT_EQ(*table.find(1), 5);
  EXPECT_EQ(*table.find(2), 5);
  EXPECT_EQ(table.find(3), nullptr);
  EXPECT_EQ(table.find(4), nullptr);
  // And it can be tried again.
  ASSERT_TRUE(
      table.fill({.team = &team}, {.name = "again"}, second, [](std::size_t) { return 7; }));
  EXPECT_EQ(*table.find(2), 5);
  EXPECT_EQ(*table.find(4), 7);
}

TEST(Precomputed, is_empty_once_it_is_cleared_and_can_be_filled_again) {
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    Team team(threads);
    const Context context{.team = &team};
    constexpr std::uint32_t kKeys = 100'000;
    Precomputed<std::string> table(kKeys);
    std::vector<std::uint32_t> wanted(kKeys);
    std::iota(wanted.begin(), wanted.end(), 0U);
    const auto make = [](std::size_t key) { return "the value of " + std::to_string(key); };
    ASSERT_TRUE(table.fill(context, {.name = "fill"}, wanted, make));
    table.clear(context);
    EXPECT_EQ(table.size(), kKeys);
    EXPECT_EQ(table.find(7), nullptr);
    ASSERT_TRUE(table.fill(context, {.name = "again"}, std::span(wanted).first(10), make));
    ASSERT_NE(table.find(7), nullptr);
    EXPECT_EQ(*table.find(7), "the value of 7");
    EXPECT_EQ(table.find(10), nullptr);
  }
}

TEST(Precomputed, takes_makers_that_may_fail) {
  const std::vector<std::uint32_t> good{40, 20, 60}, bad{20, 77, 90, 30};
  const auto make = [](std::size_t key) -> Result<std::string> {
    if (key % 10 != 0) return Error{ErrorCode::input, "odd key", std::to_string(key), {}};
    return std::to_string(key);
  };
  const auto cost = [](std::size_t key) { return key == 90 ? 1e6 : 1.0; };
  for (const unsigned threads : {1U, 2U, 8U}) {
    Team team(threads);
    for (const bool by_weight : {false, true}) {
      Precomputed<std::string> table(100);
      const auto fill = [&](const std::vector<std::uint32_t>& wanted) {
        return by_weight
                   ? table.fill_by_weight({.team = &team}, {.name = "x"}, 100.0, wanted, cost, make)
                   : table.fill({.team = &team}, {.name = "x"}, wanted, make);
      };
      ASSERT_TRUE(fill(good));
      const Status failed = fill(bad);
      ASSERT_FALSE(failed);
      EXPECT_EQ(failed.error().code, ErrorCode::input);
      EXPECT_EQ(failed.error().message, "odd key");
      EXPECT_EQ(failed.error().where, "77");
      for (std::uint32_t key = 0; key < 100; ++key)
        ASSERT_EQ(table.find(key) != nullptr, key == 20 || key == 40 || key == 60) << key;
      EXPECT_EQ(*table.find(60), "60");
    }
  }
}

TEST(Precomputed, takes_what_can_only_be_moved) {
  Precomputed<std::unique_ptr<int>> table(10);
  const std::vector<std::uint32_t> wanted{7, 3};
  ASSERT_TRUE(table.fill({}, {.name = "moved"}, wanted, [](std::size_t key) {
    return Result(std::make_unique<int>(static_cast<int>(key)));
  }));
  EXPECT_EQ(**table.find(7), 7);
  EXPECT_EQ(table.find(4), nullptr);
}

TEST(Precomputed, names_the_lowest_key_whose_maker_throws) {
  const std::vector<std::uint32_t> wanted{10, 90, 77, 20};
  const auto make = [](std::size_t key) -> int {
    if (key > 50) throw std::runtime_error("no");
    return 1;
  };
  for (const unsigned threads : {1U, 2U, 8U}) {
    Team team(threads);
    Precomputed<int> table(100);
    const Status plain = table.fill({.team = &team}, {.name = "plain"}, wanted, make);
    ASSERT_FALSE(plain);
    EXPECT_EQ(plain.error().where, "region 'plain', item 77");
    const Status weighed = table.fill_by_weight(
        {.team = &team}, {.name = "weighed"}, 100.0, wanted,
        [](std::size_t key) { return key == 77 ? 1e6 : 1.0; }, make);
    ASSERT_FALSE(weighed);
    EXPECT_EQ(weighed.error().where, "region 'weighed', item 77");
  }
}

TEST(Precomputed, more_keys_than_a_vector_holds_is_an_error) {
  Precomputed<std::string> table(std::numeric_limits<std::size_t>::max());
  const std::vector<std::uint32_t> wanted{1};
  const Status status = table.fill({}, {.name = "huge"}, wanted, [](std::size_t) { return "x"; });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::memory);
  EXPECT_EQ(table.find(1), nullptr);
}

TEST(Precomputed, a_key_beyond_its_end_is_an_error_and_is_not_found) {
  Precomputed<int> table(5);
  const std::vector<std::uint32_t> wanted = {1, 5};
  const Status status = table.fill({}, {.name = "few"}, wanted, [](std::size_t) { return 7; });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().text(), "region 'few': key 5 of 5");
  EXPECT_EQ(table.find(1), nullptr);
  ASSERT_TRUE(
      table.fill({}, {.name = "few"}, std::span(wanted).first(1), [](std::size_t) { return 7; }));
  EXPECT_EQ(*table.find(1), 7);
  EXPECT_EQ(table.find(5), nullptr);
}

TEST(Precomputed, keys_of_marks_are_ascending) {
  EXPECT_TRUE(keys_of({}).empty());
  EXPECT_EQ(keys_of({false, true, false, true, true}), (std::vector<std::uint32_t>{1, 3, 4}));
}

TEST(Precomputed, an_empty_table_is_a_table) {
  Precomputed<int> table;
  EXPECT_EQ(table.size(), 0U);
  EXPECT_TRUE(table.fill({}, {.name = "nothing"}, {}, [](std::size_t) { return 1; }));
}

}  // namespace
}  // namespace strake::parallel
