// SPDX-License-Identifier: Apache-2.0
// Lines that lie on each other, found by the index and by every pair, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "strake/parallel/team.hpp"
#include "support/line_sets.hpp"

namespace strake {
namespace {

using drawing::LineInterval;
using drawing::LineIntervals;
using drawing::OverlapRule;
using drawing::PlaneSegment;

using Row = std::tuple<std::uint32_t, bool, double, double>;

std::vector<Row> rows(const LineIntervals& cut_intervals) {
  std::vector<Row> out;
  for (const LineInterval& s : cut_intervals) out.emplace_back(s.line, s.covered, s.from, s.to);
  return out;
}

std::vector<Row> found(const std::vector<PlaneSegment>& lines, const OverlapRule& rule,
                       const parallel::Context& context = {}) {
  const auto overlaps = drawing::cut_overlaps(lines, rule, context);
  EXPECT_TRUE(overlaps);
  std::vector<Row> all = rows(overlaps->cut_intervals);
  for (std::uint32_t i = 0; i < lines.size(); ++i)
    if (overlaps->fully_covered.is_set(i)) all.emplace_back(i, true, 0, 1);
  std::sort(all.begin(), all.end(),
            [](const Row& a, const Row& b) {  // of a line cut in parts by place
              return std::pair(std::get<0>(a), std::get<2>(a)) <
                     std::pair(std::get<0>(b), std::get<2>(b));
            });
  return all;
}

/// As for duplicates, as for ink, and with nothing that is too short to be looked at.
std::vector<OverlapRule> rules(double reach) {
  return {{.least = 2 * reach, .shortest = 2 * reach},
          {.least = 1e-3, .greatest_sine = 0.2, .covers_visible = false, .shortest = 0.5},
          {.least = 1e-3, .greatest_sine = 0.2, .covers_visible = false, .hidden_covers = false},
          {}};
}

/// Counts what is covered, so that a test of nothing fails.
std::size_t compare(const test::LineSetOptions& options, std::uint64_t seeds) {
  std::size_t covered = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const std::vector<PlaneSegment> lines = test::make_lines(seed, options);
    for (const OverlapRule& rule : rules(options.reach)) {
      const std::vector<Row> expected = rows(test::cut_by_all_pairs(lines, rule));
      EXPECT_EQ(found(lines, rule), expected) << "seed " << seed;
      covered += expected.size();
    }
  }
  return covered;
}

TEST(LineOverlaps, AreThoseOfAllPairs) {
  for (unsigned set = 0; set < test::kLineSets; ++set)
    for (const double reach : {0.0, 0.002, 0.25, 5.0}) {
      const std::size_t covered =
          compare({.set = static_cast<test::LineSet>(set), .reach = reach}, 8);
      EXPECT_GE(covered, reach > 0 && set != 0 ? 200U : 0U) << set << " " << reach;
    }
}

TEST(LineOverlaps, AreThoseOfAllPairsFarFromTheOrigin) {
  for (unsigned set = 0; set < test::kLineSets; ++set)
    for (const double offset : {1e6, 1e9})
      compare({.set = static_cast<test::LineSet>(set), .reach = 0.01, .offset = offset}, 8);
}

TEST(LineOverlaps, AreThoseOfAllPairsWithOneLineFarAway) {
  for (unsigned set = 0; set < test::kLineSets; ++set) {
    std::vector<PlaneSegment> lines =
        test::make_lines(set, {.set = static_cast<test::LineSet>(set), .reach = 0.01});
    lines.front() = {
        .ax = 1e9, .ay = -1e9, .bx = 1e9 + 1, .by = -1e9, .rank = drawing::OverlapRank::hidden};
    for (const OverlapRule& rule : rules(0.01))
      EXPECT_EQ(found(lines, rule), rows(test::cut_by_all_pairs(lines, rule)));
  }
}

TEST(LineOverlaps, AreTheSameForAnyTeam) {
  for (unsigned set = 0; set < test::kLineSets; ++set) {
    const std::vector<PlaneSegment> lines =
        test::make_lines(7, {.set = static_cast<test::LineSet>(set), .count = 1500, .reach = 0.05});
    for (const OverlapRule& rule : rules(0.05)) {
      const std::vector<Row> expected = found(lines, rule);
      for (const unsigned workers : {2U, 3U, 8U, 64U}) {
        parallel::Team team(workers);
        EXPECT_EQ(found(lines, rule, {.team = &team}), expected) << workers << " workers";
      }
    }
  }
}

TEST(LineOverlaps, NeedLinesThatAreParallelForTheirLengths) {
  // A second line begins 0.02 before the first ends, at an angle: side by side there, and not one.
  const PlaneSegment first{
      .ax = 0, .ay = 0, .bx = 10, .by = 0, .reach = 0.005, .rank = drawing::OverlapRank::visible};
  PlaneSegment second{.ax = 9.98,
                      .ay = 0,
                      .bx = 19.98,
                      .by = 3,
                      .depth = -1,
                      .reach = 0.005,
                      .rank = drawing::OverlapRank::visible};
  const OverlapRule rule{.least = 0.01};
  EXPECT_TRUE(found({first, second}, rule).empty());
  second.by = 0.015;  // both ends of a line of its length would be within the distance
  EXPECT_EQ(found({first, second}, rule).size(), 2U);
}

TEST(LineOverlaps, OfLinesWithTheSameEndsOneStays) {
  // Twins lie on each other whatever rounding makes of them, whichever way they run; the one with
  // the greater reach covers a neighbour that the others do not.
  const PlaneSegment twin{
      .ax = 0.1, .ay = 0.2, .bx = 7.3, .by = 3.7, .rank = drawing::OverlapRank::hidden};
  const PlaneSegment back{
      .ax = 7.3, .ay = 3.7, .bx = 0.1, .by = 0.2, .depth = 1, .rank = drawing::OverlapRank::hidden};
  PlaneSegment wide = twin;
  wide.depth = -1;
  wide.reach = 0.5;
  const PlaneSegment beside{.ax = 1.1,
                            .ay = 0.9,
                            .bx = 6.3,
                            .by = 3.4,
                            .depth = -2,
                            .rank = drawing::OverlapRank::hidden};
  const std::vector<PlaneSegment> lines{twin, back, wide, beside, twin};
  const std::vector<Row> all = found(lines, {});
  EXPECT_EQ(all, rows(test::cut_by_all_pairs(lines, {})));
  EXPECT_EQ(all,
            (std::vector<Row>{{0, true, 0, 1}, {2, true, 0, 1}, {3, true, 0, 1}, {4, true, 0, 1}}));
}

TEST(LineOverlaps, OfNothingAreNone) {
  EXPECT_TRUE(found({}, {}).empty());
  EXPECT_TRUE(found({PlaneSegment{}, PlaneSegment{}}, {}).empty());
}

}  // namespace
}  // namespace strake
