// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "strake/parallel/team.hpp"
#include "support/clash_crowd.hpp"
#include "support/clash_model.hpp"
#include "support/voxels.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;
using test::box_mesh;
using test::ClashModel;
using test::crowd;
using test::same;

struct Task {
  Sets sets;  ///< empty: everything against itself
  Options options;
  Policy policy;
  parallel::Context context = {};
};

model::Scene scene_of(const ClashModel& m) {
  model::SceneOptions options = scene_options(Options{});
  options.obstruction = options.insulation = true;
  return make_scene(m.model, options, {}).value();
}

Report report_of(const ClashModel& m, const Task& run) {
  const model::Scene scene = scene_of(m);
  const Sets sets = run.sets.in_a.empty() ? one_set(scene) : run.sets;
  return detect(scene, sets, run.options, run.policy, run.context).value();
}

/// "a-b HIT" for each pair.
std::vector<std::string> reported(const ClashModel& m, const Report& report) {
  std::vector<std::string> all;
  for (const Pair& p : report.pairs)
    all.push_back(
        m.model.object(p.a).id + "-" + m.model.object(p.b).id + " " + std::string(name(p.cls)) +
        (p.allowed < 0 ? "" : " by " + report.allowed[static_cast<std::size_t>(p.allowed)].rule));
  return all;
}

using Reported = std::vector<std::string>;

std::vector<std::pair<std::string, std::uint64_t>> exempted(const Report& report) {
  std::vector<std::pair<std::string, std::uint64_t>> all;
  for (const Exempted& e : report.exempted) all.emplace_back(e.rule, e.pairs);
  return all;
}

using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

/// Four cubes of side 100 in a row, each 10 into the next.
ClashModel chain() {
  ClashModel m;
  for (const char* id : {"a", "b", "c", "d"}) {
    const double x = 90.0 * (id[0] - 'a');
    m.box(id, {x, 0, 0}, {x + 100, 100, 100});
  }
  return m;
}

Levels levels(std::vector<Level> of_objects) {
  Levels all;
  all.object = std::move(of_objects);
  return all;
}

Linked::Lists lists(const std::vector<std::vector<std::uint32_t>>& of_each) {
  Linked::Lists all{{0}, {}};
  for (const auto& numbers : of_each) {
    all.numbers.insert(all.numbers.end(), numbers.begin(), numbers.end());
    all.first.push_back(static_cast<std::uint32_t>(all.numbers.size()));
  }
  return all;
}

TEST(ClashPolicy, ObjectsOfOneLabelAreNoPairAndAreCounted) {
  const ClashModel m = chain();
  Policy policy;
  policy.exemptions = {{"units", SameLabel{{7, 7, kNoLabel, kNoLabel}}}};
  policy.list_exempted = true;
  const Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"b-c HIT", "c-d HIT"}));
  EXPECT_EQ(exempted(report), (Counts{{"units", 1}}));
  ASSERT_EQ(report.exempted_pairs.size(), 1U);
  EXPECT_EQ(index(report.exempted_pairs[0].a), 0U);
  EXPECT_EQ(index(report.exempted_pairs[0].b), 1U);
  EXPECT_EQ(report.exempted_pairs[0].rule, 0U);
  EXPECT_EQ(report.counters.candidate_pairs, 2U);
}

TEST(ClashPolicy, PairsOutOfReachCountForNoRule) {
  const ClashModel m = chain();
  Policy policy;
  policy.exemptions = {{"units", SameLabel{{7, kNoLabel, 7, kNoLabel}}}};
  const Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(report.count_hit, 3U);
  EXPECT_EQ(exempted(report), (Counts{{"units", 0}}));
}

TEST(ClashPolicy, LinkedObjectsAreNoPairInEitherDirection) {
  const ClashModel m = chain();
  Policy policy;
  // a refers to b; d refers to c; b and c both refer to 9, which makes them no partners.
  policy.exemptions = {
      {"joints", Linked{lists({{1}, {2}, {3}, {4}}), lists({{2}, {9}, {9}, {3, 8}})}}};
  const Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"b-c HIT"}));
  EXPECT_EQ(exempted(report), (Counts{{"joints", 2}}));
}

TEST(ClashPolicy, APairCountsForTheFirstRuleThatExemptsIt) {
  const ClashModel m = chain();
  const Between ab{{true, false, false, false}, {false, true, true, true}};
  const Between ba{ab.b, ab.a};
  const SameLabel all{{1, 1, 1, 1}};
  const auto run = [&](std::vector<Exemption> exemptions) {
    Policy policy;
    policy.exemptions = std::move(exemptions);
    return exempted(report_of(m, {{}, {}, policy}));
  };
  EXPECT_EQ(run({{"x", ab}, {"y", all}}), (Counts{{"x", 1}, {"y", 2}}));
  EXPECT_EQ(run({{"y", all}, {"x", ab}}), (Counts{{"y", 3}, {"x", 0}}));
  EXPECT_EQ(run({{"x", ba}, {"z", ab}}), (Counts{{"x", 1}, {"z", 0}}));
}

TEST(ClashPolicy, MoreRulesThanAWordHasBits) {
  const ClashModel m = chain();
  Policy policy;
  for (int r = 0; r < 130; ++r) {
    const Between none{std::vector<bool>(4), std::vector<bool>(4)};
    policy.exemptions.push_back({"r" + std::to_string(r), none});
  }
  std::get<Between>(policy.exemptions[129].test) = {{false, false, false, true},
                                                    {false, false, true, false}};
  const Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(report.count_hit, 2U);
  EXPECT_EQ(report.exempted[129].pairs, 1U);
}

/// A matrix with tolerances of all kinds for a crowd, every 4th object in no discipline.
Policy matrix_policy(std::size_t objects) {
  Policy policy;
  policy.tolerances = {{12, 1, 1}, {0, 3, 2, ThicknessCap::off}, {40, 0, 0}};
  Matrix m;
  m.disciplines = {"hull", "pipes", "power"};
  m.cells = {Matrix::kNotChecked, 0, 1, 0, Matrix::kDefault, 2, 1, 2, Matrix::kNotChecked};
  for (std::uint32_t o = 0; o < objects; ++o) m.discipline.push_back(o % 4 == 3 ? kNoLabel : o % 4);
  policy.matrix = m;
  return policy;
}

TEST(ClashPolicy, AMatrixInOnePassIsTheSameAsATestPerCell) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const ClashModel m = crowd(seed, 90);
    const Policy policy = matrix_policy(90);
    const Matrix& matrix = *policy.matrix;
    const Options options{.tolerances = {.clearance_mm = 5}};
    const Report whole = report_of(m, {{}, options, policy});
    std::vector<Pair> expected;
    std::uint64_t unchecked = 0;
    for (std::uint32_t row = 0; row <= 3; ++row)
      for (std::uint32_t column = row; column <= 3; ++column) {
        const auto cell =
            row == 3 || column == 3 ? Matrix::kDefault : matrix.cells[row * 3 + column];
        Options own = options;
        if (cell < Matrix::kDefault) own.tolerances = policy.tolerances[cell];
        Task run{{}, own, {}};
        for (const std::uint32_t d : matrix.discipline) {
          run.sets.in_a.push_back(std::min(d, 3U) == row);
          run.sets.in_b.push_back(std::min(d, 3U) == column);
        }
        const Report one = report_of(m, run);
        if (cell == Matrix::kNotChecked)
          unchecked += one.counters.candidate_pairs;
        else
          expected.insert(expected.end(), one.pairs.begin(), one.pairs.end());
        if (row == 3 || column == 3) continue;
        const auto reported =
            std::find_if(whole.cells.begin(), whole.cells.end(),
                         [&](const CellReport& c) { return c.a == row && c.b == column; });
        ASSERT_NE(reported, whole.cells.end());
        EXPECT_EQ(reported->checked, cell != Matrix::kNotChecked);
        EXPECT_EQ(reported->hit, reported->checked ? one.count_hit : 0);
        EXPECT_EQ(reported->contact, reported->checked ? one.count_contact : 0);
        EXPECT_EQ(reported->clearance_violation, reported->checked ? one.count_clearance : 0);
      }
    std::sort(expected.begin(), expected.end(),
              [](const Pair& x, const Pair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    ASSERT_EQ(whole.pairs.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_TRUE(same(whole.pairs[i], expected[i]));
    EXPECT_EQ(whole.exempted[0].pairs, unchecked);
    EXPECT_GT(unchecked, 0U);
    EXPECT_GT(whole.count_clearance, 0U);
    EXPECT_EQ(whole.disciplines[0].objects, 23U);
  }
}

TEST(ClashPolicy, AnyTeamAndSwappedSetsGiveTheSame) {
  const ClashModel m = crowd(11, 120);
  Policy policy = matrix_policy(120);
  policy.list_exempted = true;
  std::vector<std::uint32_t> units;
  std::vector<bool> some, others;
  for (std::uint32_t o = 0; o < 120; ++o) {
    units.push_back(o % 5 == 0 ? o % 3 : kNoLabel);
    some.push_back(o % 2 == 0);
    others.push_back(o % 3 != 0);
  }
  policy.exemptions = {{"units", SameLabel{units}}, {"pairs", Between{some, others}}};
  policy.allowed = {{"meant", others, others, geometry::Box3d{{0, 0, 0}, {200, 200, 200}}, {}, 12}};
  Task run{{}, {.tolerances = {.clearance_mm = 5}}, policy};
  run.sets.in_a.assign(120, true);
  run.sets.in_b = others;
  const Report first = report_of(m, run);
  EXPECT_GT(first.count_allowed, 0U);
  EXPECT_GT(first.exempted[1].pairs, 0U);
  EXPECT_GT(first.exempted[2].pairs, 0U);
  std::swap(run.sets.in_a, run.sets.in_b);
  std::get<Between>(run.policy.exemptions[1].test) = {others, some};
  for (const unsigned workers : {1U, 2U, 7U, 64U}) {
    parallel::Team team(workers);
    run.context.team = &team;
    for (const BroadPhase phase : {BroadPhase::tree, BroadPhase::all_pairs}) {
      run.options.engine.broad_phase = phase;
      const Report again = report_of(m, run);
      EXPECT_EQ(again.hash, first.hash);
      EXPECT_EQ(exempted(again), exempted(first));
      ASSERT_EQ(again.exempted_pairs.size(), first.exempted_pairs.size());
      for (std::size_t i = 0; i < first.exempted_pairs.size(); ++i) {
        EXPECT_EQ(again.exempted_pairs[i].a, first.exempted_pairs[i].a);
        EXPECT_EQ(again.exempted_pairs[i].b, first.exempted_pairs[i].b);
        EXPECT_EQ(again.exempted_pairs[i].rule, first.exempted_pairs[i].rule);
      }
    }
  }
}

TEST(ClashPolicy, RulesThatConcernNothingChangeNothing) {
  const ClashModel m = crowd(3, 80);
  const Report plain = report_of(m, {{}, {.tolerances = {.clearance_mm = 25}}, {}});
  Policy policy;
  const std::vector<bool> nobody(80), everybody(80, true);
  policy.exemptions = {{"units", SameLabel{std::vector<std::uint32_t>(80, kNoLabel)}},
                       {"pairs", Between{nobody, everybody}}};
  policy.levels = levels(std::vector<Level>(80, Level::hard));
  policy.allowed = {
      {"meant", everybody, everybody, geometry::Box3d{{-9, -9, -9}, {-8, -8, -8}}, {}, 1e9}};
  const Report ruled = report_of(m, {{}, {.tolerances = {.clearance_mm = 25}}, policy});
  EXPECT_EQ(ruled.hash, plain.hash);
  EXPECT_EQ(ruled.pairs.size(), plain.pairs.size());
  EXPECT_EQ(ruled.counters.allowed_pairs, ruled.counters.candidate_pairs);
}

/// Adds a body of a category to the last object.
void add_body(ClashModel& m, model::Category category, const Vec3d& lo, const Vec3d& hi) {
  m.body(box_mesh(lo, hi));
  m.model.bodies.back().category = category;
}

TEST(ClashPolicy, LevelsStateWhatIsSetAgainstWhat) {
  const ClashModel m = chain();
  Policy policy;
  policy.levels = levels(std::vector{Level::hard, Level::soft, Level::soft, Level::none});
  Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"a-b HIT", "b-c HIT"}));
  EXPECT_EQ(exempted(report), (Counts{{"no obstruction", 1}}));
  EXPECT_EQ(report.pairs[0].level_a, Level::hard);
  EXPECT_EQ(report.pairs[0].level_b, Level::soft);
  policy.levels->left_out[1][1] = "soft against soft";
  report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"a-b HIT"}));
  EXPECT_EQ(exempted(report), (Counts{{"no obstruction", 1}, {"soft against soft", 1}}));
}

TEST(ClashPolicy, ObstructionVolumesAreSoftAndInsulationIsItself) {
  ClashModel m;
  m.object("pump");
  add_body(m, model::Category::obstruction, {0, 0, 0}, {100, 100, 100});
  m.object("pipe");
  add_body(m, model::Category::insulation, {90, 0, 0}, {190, 100, 100});
  m.object("pipf");
  add_body(m, model::Category::insulation, {180, 0, 0}, {280, 100, 100});
  Policy policy;
  policy.levels = levels(std::vector<Level>(3, Level::hard));
  policy.levels->left_out[2][2] = "insulation against insulation";
  const Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"pump-pipe HIT"}));
  EXPECT_EQ(report.pairs[0].level_a, Level::soft);
  EXPECT_EQ(report.pairs[0].level_b, Level::insulation);
  EXPECT_EQ(exempted(report),
            (Counts{{"no obstruction", 0}, {"insulation against insulation", 1}}));
}

TEST(ClashPolicy, AHardHitIsNotHiddenByADeeperOneOfInsulation) {
  ClashModel m;
  m.box("beam", {0, 0, 0}, {100, 100, 100});
  m.object("pipe");
  add_body(m, model::Category::physical, {95, 20, 20}, {300, 60, 60});
  add_body(m, model::Category::insulation, {60, 0, 0}, {300, 80, 80});
  m.object("rope");
  add_body(m, model::Category::insulation, {-50, 0, 0}, {20, 80, 80});
  Policy policy;
  const Report plain = report_of(m, {{}, {}, policy});
  EXPECT_EQ(plain.pairs[0].d_mm, -40);
  policy.levels = levels(std::vector<Level>(3, Level::hard));
  const Report report = report_of(m, {{}, {}, policy});
  ASSERT_EQ(reported(m, report), (Reported{"beam-pipe HIT", "beam-rope HIT"}));
  EXPECT_EQ(report.pairs[0].d_mm, -5);
  EXPECT_EQ(report.pairs[0].level_b, Level::hard);
  EXPECT_EQ(report.pairs[1].d_mm, -20);
  EXPECT_EQ(report.pairs[1].level_b, Level::insulation);
}

Allowed meant(std::size_t objects) {
  return {"meant", std::vector<bool>(objects, true), std::vector<bool>(objects, true), {}, {}, {}};
}

TEST(ClashPolicy, AllowanceStopsAtItsDepthAndKeepsTheClass) {
  const ClashModel m = chain();
  Policy policy;
  policy.allowed = {meant(4)};
  policy.allowed[0].a = {true, false, false, true};
  Report report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(report.count_hit, 3U) << "without a depth no HIT is meant";
  policy.allowed[0].max_depth_mm = 9.99;
  EXPECT_EQ(report_of(m, {{}, {}, policy}).count_hit, 3U);
  policy.allowed[0].max_depth_mm = 10.01;
  report = report_of(m, {{}, {}, policy});
  EXPECT_EQ(reported(m, report), (Reported{"a-b HIT by meant", "b-c HIT", "c-d HIT by meant"}));
  EXPECT_EQ(report.count_hit, 1U);
  EXPECT_EQ(report.count_allowed, 2U);
  EXPECT_EQ(report.allowed[0].candidates, 2U);
  EXPECT_EQ(report.allowed[0].pairs, 2U);
  EXPECT_EQ(report.counters.allowed_pairs, 2U);
  EXPECT_NE(report.hash, report_of(m, {{}, {}, {}}).hash);
}

// To the grid step: a depth of just max_depth is allowed and told to be at the limit.
TEST(ClashPolicy, TheGreatestAllowedDepthIsAllowedItself) {
  const auto run = [](double depth_mm, double max_mm) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {100 - depth_mm, 0, 0}, {200, 100, 100});
    Policy policy;
    policy.allowed = {meant(2)};
    policy.allowed[0].max_depth_mm = max_mm;
    const Report report = report_of(m, {{}, {}, policy});
    const Pair& pair = report.pairs.at(0);
    return std::pair(pair.allowed >= 0, (pair.flags & kBorderline) != 0);
  };
  for (const double max_mm : {10.0, 0.001, 2.5, 48.999}) {
    EXPECT_EQ(run(max_mm, max_mm), std::pair(true, true)) << max_mm;
    EXPECT_EQ(run(max_mm + 0.001, max_mm), std::pair(false, false)) << max_mm;
    if (max_mm == 0.001) continue;  // a micrometre less is a touch
    EXPECT_EQ(run(max_mm - 0.001, max_mm), std::pair(true, false)) << max_mm;
  }
}

TEST(ClashPolicy, ContactsAndClearancesAreMeantWithoutADepth) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {100, 0, 0}, {200, 100, 100});
  m.box("c", {210, 0, 0}, {300, 100, 100});
  Policy policy;
  policy.allowed = {meant(3)};
  EXPECT_EQ(reported(m, report_of(m, {{}, {.tolerances = {.clearance_mm = 25}}, policy})),
            (Reported{"a-b CONTACT by meant", "b-c CLEARANCE_VIOLATION by meant"}));
}

TEST(ClashPolicy, RegionAndCavityPlanesLimitThePlace) {
  const ClashModel m = chain();  // meets at x = 95, 185, 275
  const auto run = [&](auto&& limit) {
    Policy policy;
    policy.allowed = {meant(4)};
    policy.allowed[0].max_depth_mm = 50;
    limit(policy.allowed[0]);
    return reported(m, report_of(m, {{}, {}, policy}));
  };
  EXPECT_EQ(run([](Allowed& a) { a.region_mm = {{80, 0, 0}, {110, 100, 100}}; }),
            (Reported{"a-b HIT by meant", "b-c HIT", "c-d HIT"}));
  EXPECT_EQ(run([](Allowed& a) { a.cavity = {{{180, 0, 0}, {1, 0, 0}}}; }),
            (Reported{"a-b HIT", "b-c HIT by meant", "c-d HIT by meant"}));
  EXPECT_EQ(
      run([](Allowed& a) { a.cavity = {{{180, 0, 0}, {1, 0, 0}}, {{200, 0, 0}, {-3, 0, 0}}}; }),
      (Reported{"a-b HIT", "b-c HIT by meant", "c-d HIT"}));
}

TEST(ClashPolicy, TheFirstRuleThatAllowsIsNamed) {
  const ClashModel m = chain();
  Policy policy;
  policy.allowed = {meant(4), meant(4), meant(4)};
  policy.allowed[0].rule = "shallow";
  policy.allowed[1].rule = "deep";
  policy.allowed[1].max_depth_mm = 100;
  policy.allowed[2].rule = "deeper";
  policy.allowed[2].max_depth_mm = 1000;
  EXPECT_EQ(reported(m, report_of(m, {{}, {}, policy})),
            (Reported{"a-b HIT by deep", "b-c HIT by deep", "c-d HIT by deep"}));
}

/// A plate with a part in its sleeve at x < 200 and others beyond.
ClashModel sleeve(const Vec3d& lo, const Vec3d& hi) {
  ClashModel m;
  m.box("deck", {0, 0, 0}, {1000, 1000, 20});
  m.object("pipe").body(box_mesh({100, 100, -50}, {120, 120, 70})).body(box_mesh(lo, hi));
  return m;
}

TEST(ClashPolicy, WhatIsMeantHidesNothingElseOfThePair) {
  Policy policy;
  policy.allowed = {meant(2)};
  policy.allowed[0].max_depth_mm = 50;
  policy.allowed[0].region_mm = {{0, 0, -100}, {200, 200, 100}};
  const Options options{.tolerances = {.clearance_mm = 25}};
  const auto run = [&](const Vec3d& lo, const Vec3d& hi) {
    const ClashModel m = sleeve(lo, hi);
    const Report report = report_of(m, {{}, options, policy});
    EXPECT_EQ(report.pairs[0].flags, 0) << "nothing is uncertain here";
    return reported(m, report);
  };
  EXPECT_EQ(run({500, 500, 19.5}, {600, 600, 80}), (Reported{"deck-pipe CONTACT"}));
  EXPECT_EQ(run({500, 500, 15}, {600, 600, 80}), (Reported{"deck-pipe HIT"}));
  EXPECT_EQ(run({500, 500, 30}, {600, 600, 80}), (Reported{"deck-pipe CLEARANCE_VIOLATION"}));
  EXPECT_EQ(run({500, 500, 60}, {600, 600, 80}), (Reported{"deck-pipe HIT by meant"}));
  EXPECT_EQ(run({150, 150, 15}, {160, 160, 80}), (Reported{"deck-pipe HIT by meant"}));
}

// The same of one part with two legs: the left one is meant, the right one near the bar or in it.
TEST(ClashPolicy, WhatIsMeantInOnePlaceHidesNoOther) {
  Policy policy;
  policy.allowed = {meant(2)};
  policy.allowed[0].max_depth_mm = 50;
  policy.allowed[0].region_mm = {{0, 0, -100}, {60, 200, 100}};
  const Options options{.tolerances = {.clearance_mm = 5}};
  const auto run = [&](double end) {
    std::vector<geometry::Vec3i> u{{1, 0, 0}, {2, 0, 0}};
    for (int y = 0; y < 4; ++y) u.insert(u.end(), {{0, y, 0}, {3, y, 0}});
    ClashModel m;
    m.object("u").body(test::voxel_mesh(u, 50));
    m.box("bar", {40, 100, 10}, {end, 120, 30});
    model::finish(m.model);
    return reported(m, report_of(m, {{}, options, policy}));
  };
  EXPECT_EQ(run(120), (Reported{"bar-u HIT by meant"}));
  EXPECT_EQ(run(148.5), (Reported{"bar-u CLEARANCE_VIOLATION"}));
  EXPECT_EQ(run(149.5), (Reported{"bar-u CONTACT"}));
  EXPECT_EQ(run(158), (Reported{"bar-u HIT"}));
}

TEST(ClashPolicy, PartsThatMayMeetBeyondWhatIsAllowedAreUncertain) {
  const ClashModel m = chain();  // a and b meet between x = 90 and 100, y and z from 0 to 100
  const auto flags = [&](auto&& limit) {
    Policy policy;
    policy.allowed = {meant(4)};
    policy.allowed[0].max_depth_mm = 50;
    limit(policy.allowed[0]);
    const Report report = report_of(m, {{}, {}, policy});
    EXPECT_EQ(report.pairs[0].allowed, 0);
    const bool beyond = (report.pairs[0].flags & kUncertain) != 0;
    EXPECT_EQ(report.pairs[0].severest, beyond ? Class::hit : Class::no_hit);
    return report.pairs[0].flags;
  };
  EXPECT_EQ(flags([](Allowed&) {}), 0);
  EXPECT_EQ(flags([](Allowed& a) { a.region_mm = {{80, -10, -10}, {110, 110, 110}}; }), 0);
  EXPECT_EQ(flags([](Allowed& a) { a.region_mm = {{80, 0, 0}, {110, 110, 110}}; }), 0);
  EXPECT_EQ(flags([](Allowed& a) { a.region_mm = {{80, 1, 0}, {110, 110, 110}}; }), kUncertain);
  EXPECT_EQ(flags([](Allowed& a) { a.cavity = {{{80, 0, 0}, {1, 0, 0}}}; }), 0);
  EXPECT_EQ(
      flags([](Allowed& a) { a.cavity = {{{80, 0, 0}, {1, 0, 0}}, {{97, 0, 0}, {-1, 0, 0}}}; }),
      kUncertain);
  EXPECT_EQ(flags([](Allowed& a) { a.cavity = {{{0, 0, 97}, {0, 0, -1}}}; }), kUncertain);
}

TEST(ClashPolicy, ListsOfTheWrongSizeAreErrors) {
  const ClashModel m = chain();
  const model::Scene scene = scene_of(m);
  const auto refuse = [&](auto&& spoil) {
    Policy policy = matrix_policy(4);
    policy.exemptions = {{"units", SameLabel{{1, 2, 3, 4}}}};
    policy.levels = levels(std::vector<Level>(4));
    policy.allowed = {meant(4)};
    EXPECT_TRUE(detect(scene, one_set(scene), {}, policy, {}).has_value());
    spoil(policy);
    const auto report = detect(scene, one_set(scene), {}, policy, {});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::usage);
  };
  refuse([](Policy& p) { std::get<SameLabel>(p.exemptions[0].test).label.pop_back(); });
  refuse([](Policy& p) { p.exemptions[0].test = Between{std::vector<bool>(4), {}}; });
  refuse(
      [](Policy& p) { p.exemptions[0].test = Linked{lists({{}, {}}), lists({{}, {}, {}, {}})}; });
  refuse([](Policy& p) { p.matrix->cells.pop_back(); });
  refuse([](Policy& p) { p.matrix->cells[0] = 3; });
  refuse([](Policy& p) { p.matrix->discipline[2] = 3; });
  refuse([](Policy& p) { p.levels->object.clear(); });
  refuse([](Policy& p) { p.allowed[0].b.push_back(true); });
  refuse([](Policy& p) { p.tolerances[1].touch_gap_mm = -1; });
}

TEST(ClashPolicy, LimitsThatAreNoNumbersAreErrors) {
  const ClashModel m = chain();
  const model::Scene scene = scene_of(m);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double far = std::numeric_limits<double>::infinity();
  const auto answer = [&](auto&& change) {
    Policy policy;
    policy.allowed = {meant(4)};
    policy.allowed[0].rule = "sleeves";
    change(policy.allowed[0]);
    return detect(scene, one_set(scene), {}, policy, {});
  };
  const auto refuse = [&](auto&& change) {
    const auto report = answer(change);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::usage);
    EXPECT_EQ(report.error().where, "rule 'sleeves'");
  };
  refuse([&](Allowed& a) { a.max_depth_mm = nan; });
  refuse([&](Allowed& a) { a.region_mm = {{nan, 0, 0}, {1, 1, 1}}; });
  refuse([&](Allowed& a) { a.region_mm = {{0, 0, 0}, {1, 1, nan}}; });
  refuse([&](Allowed& a) { a.cavity = {{{0, nan, 0}, {0, 0, 1}}}; });
  refuse([&](Allowed& a) { a.cavity = {{{0, 0, 0}, {0, 0, 0}}}; });
  refuse([&](Allowed& a) { a.cavity = {{{0, 0, 0}, {0, far, 0}}}; });
  EXPECT_TRUE(answer([&](Allowed& a) { a.max_depth_mm = far; }).has_value());
  EXPECT_TRUE(answer([&](Allowed& a) { a.region_mm = {{-far, 0, 0}, {far, 1, 1}}; }).has_value());
  EXPECT_TRUE(answer([](Allowed& a) { a.cavity = {{{0, 0, 0}, {1e-200, 0, 0}}}; }).has_value());
}

}  // namespace
}  // namespace strake::clash
