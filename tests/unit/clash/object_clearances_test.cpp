// SPDX-License-Identifier: Apache-2.0
// What objects add to the clearances of their pairs, against runs that give each pair its clearance
// as a constant.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clash/results/required_clearance.hpp"
#include "strake/clash/policy.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_crowd.hpp"
#include "support/clash_model.hpp"

namespace strake::clash {
namespace {

using test::ClashModel;
using test::crowd;
using test::same;

std::shared_ptr<const ObjectClearances> adding(std::vector<double> mm) {
  return std::make_shared<const ObjectClearances>(ObjectClearances{"INSU", std::move(mm)});
}

/// Most objects add nothing, others a little or much, as with insulation of a few pipes.
std::vector<double> insulation(std::size_t objects) {
  constexpr std::array kThickness{0.0, 0.0, 0.0, 7.5, 0.0, 20.0, 0.0, 60.0};
  std::vector<double> mm;
  for (std::size_t o = 0; o < objects; ++o) mm.push_back(kThickness[o * 5 % kThickness.size()]);
  return mm;
}

/// What a run finds of the pairs to whose clearance their objects add so much.
std::vector<Pair> of_sum(const Report& report, const std::vector<double>& mm, double sum) {
  std::vector<Pair> some;
  for (const Pair& p : report.pairs)
    if (mm[index(p.a)] + mm[index(p.b)] == sum) some.push_back(p);
  return some;
}

TEST(ObjectClearances, EachPairGetsWhatARunWithItsClearanceGives) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t n = 90;
    const ClashModel m = crowd(seed, n);
    const std::vector<double> mm = insulation(n);
    const Options options{.tolerances = {.clearance_mm = 4, .object_clearances = adding(mm)}};
    const Report whole = m.detect(options);
    std::set<double> sums;
    for (const double x : mm)
      for (const double y : mm) sums.insert(x + y);
    std::size_t found = 0;
    for (const double sum : sums) {
      SCOPED_TRACE(sum);
      const auto here = of_sum(whole, mm, sum);
      const auto expected = of_sum(m.detect({.tolerances = {.clearance_mm = 4 + sum}}), mm, sum);
      found += expected.size();
      ASSERT_EQ(here.size(), expected.size());
      for (std::size_t i = 0; i < here.size(); ++i) EXPECT_TRUE(same(here[i], expected[i]));
    }
    EXPECT_EQ(found, whole.pairs.size());
    EXPECT_GT(whole.count_clearance, m.detect({.tolerances = {.clearance_mm = 4}}).count_clearance);
    for (const Pair& p : whole.pairs)
      EXPECT_EQ(required_clearance_mm(whole, p), 4 + (mm[index(p.a)] + mm[index(p.b)]));
  }
}

TEST(ObjectClearances, ThoseThatAddNothingChangeNothing) {
  const ClashModel m = crowd(3, 80);
  const Report plain = m.detect({.tolerances = {.clearance_mm = 25}});
  const Report none = m.detect(
      {.tolerances = {.clearance_mm = 25, .object_clearances = adding(std::vector<double>(80))}});
  EXPECT_EQ(none.hash, plain.hash);
  EXPECT_EQ(none.counters.candidate_pairs, plain.counters.candidate_pairs);
  EXPECT_EQ(none.counters.triangle_pairs, plain.counters.triangle_pairs);
  ASSERT_FALSE(plain.pairs.empty());
  EXPECT_FALSE(required_clearance_mm(plain, plain.pairs.front()).has_value());
}

TEST(ObjectClearances, OneThatAddsMuchLooksFarItselfAndOthersDoNot) {
  ClashModel m;
  for (int i = 0; i < 100; ++i) {
    const double x = 200.0 * i;
    m.box("o" + std::to_string(100 + i), {x, 0, 0}, {x + 100, 100, 100});
  }
  std::vector<double> mm(100);
  mm[50] = 1e6;
  const Report report = m.detect({.tolerances = {.object_clearances = adding(mm)}});
  EXPECT_EQ(report.count_clearance, 99U) << "the pairs of the one, and no others";
  EXPECT_EQ(report.counters.candidate_pairs, 99U);
}

TEST(ObjectClearances, ACellOfAMatrixMayHaveThemAndAnotherNot) {
  // In a row, 30 apart: a pipe, a beam, a pipe, a beam.
  ClashModel m;
  for (int i = 0; i < 4; ++i) {
    const double x = 130.0 * i;
    m.box("o" + std::to_string(i), {x, 0, 0}, {x + 100, 100, 100});
  }
  Policy policy;
  policy.tolerances = {{.clearance_mm = 10, .object_clearances = adding({25, 0, 5, 0})}};
  Matrix matrix;
  matrix.disciplines = {"pipes", "steel"};
  matrix.discipline = {0, 1, 0, 1};
  matrix.cells = {Matrix::kDefault, 0, 0, Matrix::kDefault};
  policy.matrix = matrix;
  const model::Scene scene = make_scene(m.model, scene_options(Options{}), {}).value();
  const Report report = detect(scene, one_set(scene), {}, policy, {}).value();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, Class::clearance_violation);
  EXPECT_EQ(index(report.pairs[0].a), 0U);
  EXPECT_EQ(index(report.pairs[0].b), 1U);
  EXPECT_EQ(required_clearance_mm(report, report.pairs[0]), 35);
}

TEST(ObjectClearances, ADistanceOfJustTheClearanceIsBorderline) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {150, 0, 0}, {250, 100, 100});
  const auto found = [&](std::vector<double> mm, double constant) {
    return m.detect(
        {.tolerances = {.clearance_mm = constant, .object_clearances = adding(std::move(mm))}});
  };
  const Report constant = m.detect({.tolerances = {.clearance_mm = 50.001}});
  const Report added = found({20, 20.001}, 10);
  ASSERT_EQ(constant.pairs.size(), 1U);
  ASSERT_EQ(added.pairs.size(), 1U);
  EXPECT_TRUE(same(added.pairs[0], constant.pairs[0]));
  EXPECT_EQ(added.hash, constant.hash);
  const Report just = found({20, 20}, 10);
  ASSERT_EQ(just.pairs.size(), 1U);
  EXPECT_EQ(just.pairs[0].flags & kBorderline, kBorderline);
  EXPECT_EQ(just.hash, m.detect({.tolerances = {.clearance_mm = 50}}).hash);
  EXPECT_TRUE(found({20, 20}, 9).pairs.empty());
}

TEST(ObjectClearances, AnyTeamAndBroadPhaseGiveTheSame) {
  const ClashModel m = crowd(7, 120);
  Options options{.tolerances = {.clearance_mm = 2, .object_clearances = adding(insulation(120))}};
  const Report first = m.detect(options);
  EXPECT_GT(first.count_clearance, 0U);
  for (const unsigned workers : {1U, 3U, 16U}) {
    parallel::Team team(workers);
    for (const BroadPhase phase : {BroadPhase::tree, BroadPhase::all_pairs}) {
      options.engine.broad_phase = phase;
      const Report again = m.detect(options, {.team = &team});
      EXPECT_EQ(again.hash, first.hash);
      EXPECT_EQ(again.counters.candidate_pairs, first.counters.candidate_pairs);
    }
  }
}

TEST(ObjectClearances, EqualPairsOfUnequalClearancesAreDistinguished) {
  // Two pairs of one shape, equally far apart; the objects of the second add to their clearance.
  ClashModel m;
  m.object("a").body(test::box_mesh({0, 0, 0}, {100, 100, 100}));
  for (const auto& [id, x] :
       {std::pair{"b", 150.0}, std::pair{"c", 1000.0}, std::pair{"d", 1150.0}}) {
    geometry::Placement placement;
    placement.translation = {x, 0, 0};
    m.object(id).body_of(0, placement);
  }
  const Report report = m.detect({.tolerances = {.object_clearances = adding({0, 0, 30, 30})}});
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(index(report.pairs[0].a), 2U);
}

TEST(ObjectClearances, WhatIsNoLengthOrOfOtherObjectsIsAnError) {
  const ClashModel m = crowd(1, 3);
  const model::Scene scene = make_scene(m.model, scene_options(Options{}), {}).value();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& mm :
       {std::vector<double>{1, 2}, {1, 2, -1}, {1, nan, 2}, {1, 2, 1e6 + 1}}) {
    const Options options{.tolerances = {.object_clearances = adding(mm)}};
    const auto report = detect(scene, one_set(scene), options, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::usage);
    EXPECT_FALSE(report.error().mend.empty());
  }
}

}  // namespace
}  // namespace strake::clash
