// SPDX-License-Identifier: Apache-2.0
// Obstruction levels and insulation by selection, as in files that have neither.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::Counts;
using test::exempted;
using test::expect_lines;
using test::ResultLines;
using test::Row;
using test::warned;

/// "hard-soft" for each result: the levels of its two sides.
ResultLines levels(const clash::Report& report) {
  ResultLines all;
  for (const clash::Pair& p : report.pairs)
    all.push_back(std::string(name(p.level_a)) + "-" + std::string(name(p.level_b)));
  return all;
}

Row plain_row() { return Row().cube("a").cube("b").cube("c").cube("d").cube("e"); }

TEST(Levels, InsulationBySelection) {
  const Row row = plain_row();
  auto outcome = row.run("[insulation]\nselect = 'b or c'");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "b-c HIT", "c-d HIT", "d-e HIT"}));
  EXPECT_EQ(levels(outcome.reports[0]), (ResultLines{"hard-insulation", "insulation-insulation",
                                                     "insulation-hard", "hard-hard"}));
  EXPECT_TRUE(outcome.diagnostics.kept().empty());
  outcome = row.run("[insulation]\nselect = 'b or c'\nagainst_insulation = false");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT", "c-d HIT", "d-e HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]),
            (Counts{{"no obstruction", 0}, {"insulation against insulation", 1}}));
}

TEST(Levels, ObstructionBySelectionWithoutAnAttribute) {
  const auto outcome = plain_row().run(
      "[obstruction]\nsoft_against_soft = false\nsoft = 'b or c'\nnone = 'e'\n[insulation]\n"
      "select = 'd'\nagainst_soft = false");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT"}));
  EXPECT_EQ(levels(outcome.reports[0]), (ResultLines{"hard-soft"}));
  EXPECT_EQ(
      exempted(outcome.reports[0]),
      (Counts{{"no obstruction", 1}, {"soft against soft", 1}, {"insulation against soft", 1}}));
  EXPECT_TRUE(outcome.diagnostics.kept().empty());
}

TEST(Levels, ASelectionGoesBeforeTheAttributeAndHardBeforeNoneBeforeSoft) {
  const Row row = Row()
                      .cube("a", {{"OBST", "0"}})
                      .cube("b", {{"OBST", "0"}})
                      .cube("c", {{"OBST", "1"}})
                      .cube("d", {{"OBST", "2"}});
  EXPECT_EQ(row.hits("[obstruction]"), (ResultLines{"c-d HIT"}));
  const auto outcome = row.run("[obstruction]\nhard = 'a or d'\nnone = 'c or d'\nsoft = '*'");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT"}));
  EXPECT_EQ(levels(outcome.reports[0]), (ResultLines{"hard-soft"}));
}

TEST(Levels, WhatIsInsulationIsThatWhateverItsObstruction) {
  const auto outcome = Row()
                           .cube("a", {{"OBST", "0"}})
                           .cube("b")
                           .run("[obstruction]\nnone = 'b'\n[insulation]\nselect = '*'");
  EXPECT_EQ(levels(outcome.reports[0]), (ResultLines{"insulation-insulation"}));
  expect_lines(warned(outcome.diagnostics, "rule-shadowed"),
               {"r.toml, line 2: [obstruction], none: every object that it picks is one of "
                "'[insulation] select'\n"});
}

TEST(Levels, SelectionsThatPickNothingAreNamed) {
  const auto outcome = plain_row().run(
      "[obstruction]\nhard = 'x'\nsoft = 'y'\nnone = 'z'\n[insulation]\nselect = 'w'");
  expect_lines(warned(outcome.diagnostics, "rule-matches-nothing"),
               {"r.toml, line 2: [obstruction], hard: 'x' picks no object\n",
                "r.toml, line 3: [obstruction], soft: 'y' picks no object\n",
                "r.toml, line 4: [obstruction], none: 'z' picks no object\n",
                "r.toml, line 6: [insulation], select: 'w' picks no object\n"});
}

}  // namespace
}  // namespace strake::rules
