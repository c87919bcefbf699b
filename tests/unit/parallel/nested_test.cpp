// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/nested.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

using Lengths = std::vector<std::size_t>;

/// Rows that make trouble: none, one, empty ones first, last and in a row, a giant.
const std::vector<Lengths> kTables{
    {}, {0}, {5}, {0, 0, 0}, {0, 0, 3, 0, 0, 1, 0}, {1, 1, 1, 1}, {2, 5000, 0, 1, 7}, {5000, 0, 0}};

TEST(Nested, every_element_once_with_its_row_and_column) {
  for (const Lengths& table : kTables)
    for (const unsigned threads : {1U, 2U, 8U, 64U})
      for (const std::size_t grain : {1U, 3U, 1000U})
        for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks}) {
          Team team(threads);
          std::vector<std::vector<int>> runs;
          for (const std::size_t length : table) runs.emplace_back(length, 0);
          ASSERT_TRUE(for_each_nested(
              {.team = &team}, {.name = "nested", .schedule = schedule, .grain = grain},
              table.size(), [&](std::size_t row) { return table[row]; },
              [&](std::size_t row, std::size_t column) { ++runs.at(row).at(column); }));
          for (const auto& row : runs)
            for (const int count : row) ASSERT_EQ(count, 1);
        }
}

TEST(Nested, an_order_may_be_given) {
  std::vector<std::uint32_t> backwards(10);
  std::iota(backwards.rbegin(), backwards.rend(), 0U);
  std::vector<std::pair<std::size_t, std::size_t>> observed;
  ASSERT_TRUE(for_each_nested(
      {}, {.name = "backwards", .order = backwards}, 4, [](std::size_t row) { return row + 1; },
      [&](std::size_t row, std::size_t column) { observed.emplace_back(row, column); }));
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t row = 4; row-- > 0;)
    for (std::size_t column = row + 1; column-- > 0;) expected.emplace_back(row, column);
  EXPECT_EQ(observed, expected);
}

TEST(Nested, the_lowest_failing_element_is_reported) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    Team team(threads);
    const auto run = [&](auto&& body) {
      return for_each_nested(
          {.team = &team}, {.name = "failing"}, 100, [](std::size_t row) { return row % 3; }, body);
    };
    const Status status = run([](std::size_t row, std::size_t column) -> Status {
      if (row < 50) return {};
      return Error{ErrorCode::input, std::to_string(row) + ":" + std::to_string(column), {}, {}};
    });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "50:0");
    const Status thrown = run([](std::size_t row, std::size_t column) {
      if (row == 2 && column == 1) throw std::runtime_error("here");
    });
    ASSERT_FALSE(thrown);
    EXPECT_EQ(thrown.error().where, "region 'failing', item 2");
  }
}

TEST(Nested, more_elements_than_can_be_counted_are_an_error) {
  const Status status = for_each_nested(
      {}, {.name = "huge"}, 3,
      [](std::size_t) { return std::numeric_limits<std::size_t>::max() / 2; },
      [](std::size_t, std::size_t) { FAIL(); });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::input);
}

TEST(Pieces, cut_evenly_covers_all_without_gaps) {
  for (const unsigned count : {0U, 1U, 2U, 7U, 31U, 32U, 33U, 64U, 65U, 1000U})
    for (const unsigned limit : {0U, 1U, 2U, 32U, 999U, 1000U, 5000U}) {
      unsigned end = 0, runs = 0, least = count, most = 0;
      cut_evenly(count, limit, [&](unsigned first, unsigned last) {
        EXPECT_EQ(first, end);
        EXPECT_LT(first, last);
        end = last;
        ++runs;
        least = std::min(least, last - first);
        most = std::max(most, last - first);
      });
      EXPECT_EQ(end, count);
      const unsigned bound = std::max(limit, 1U);
      EXPECT_EQ(runs, (count + bound - 1) / bound) << count << " by " << limit;
      EXPECT_LE(most, bound);
      if (runs > 0) {
        EXPECT_LE(most - least, 1U);
      }
    }
}

TEST(Pieces, of_the_greatest_counts_do_not_overflow) {
  constexpr std::size_t kMax = std::numeric_limits<std::size_t>::max();
  const auto all = pieces(2, [](std::size_t) { return kMax; }, kMax / 2);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), 6U);
  EXPECT_EQ(all->back().last, kMax);
  EXPECT_EQ((*all)[2].last, kMax);
}

TEST(Pieces, by_item_then_ascending_none_for_nothing) {
  const Lengths lengths{0, 5, 0, 1, 4};
  const auto all = pieces(lengths.size(), [&](std::size_t i) { return lengths[i]; }, 2);
  ASSERT_TRUE(all);
  EXPECT_EQ(*all,
            (std::vector<Piece>{{1, 0, 2}, {1, 2, 4}, {1, 4, 5}, {3, 0, 1}, {4, 0, 2}, {4, 2, 4}}));
}

TEST(Pieces, results_by_piece_are_those_by_item) {
  const Lengths lengths{3, 100000, 0, 17, 1};
  const auto work = pieces(lengths.size(), [&](std::size_t i) { return lengths[i]; }, 1000);
  ASSERT_TRUE(work);
  using Element = std::pair<std::uint32_t, std::size_t>;
  std::vector<Element> expected;
  for (std::uint32_t i = 0; i < lengths.size(); ++i)
    for (std::size_t e = 0; e < lengths[i]; ++e) expected.emplace_back(i, e);
  for (const unsigned threads : {1U, 2U, 8U, 64U}) {
    Team team(threads);
    const auto got = collect<Element>({.team = &team}, {.name = "pieces", .n = work->size()},
                                      [&](std::size_t k, std::vector<Element>& out) {
                                        const Piece& piece = (*work)[k];
                                        for (std::size_t e = piece.first; e < piece.last; ++e)
                                          out.emplace_back(piece.item, e);
                                      });
    ASSERT_TRUE(got);
    EXPECT_EQ(*got, expected);
  }
}

}  // namespace
}  // namespace strake::parallel
