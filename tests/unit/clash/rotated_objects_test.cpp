// SPDX-License-Identifier: Apache-2.0
// Many long thin members that stand askew, of which the boxes along the axes all meet.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "strake/clash/clash.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/growing_meshes.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using namespace strake::test;

/// `side` by `side` rods of 10 mm, 40 mm apart from axis to axis, in a turn of their own.
ClashModel rods(std::uint32_t side, const Mat3d& turn = {}) {
  ClashModel m;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    m.object("r" + std::to_string(i));
    m.body(diagonal_rod(i, side * side, 40), {turn, {}});
  }
  return m;
}

TEST(RotatedObjects, MembersSideBySideAreNoCandidates) {
  for (const std::uint32_t side : {16U, 32U}) {
    const Report report = rods(side).detect({.tolerances = {.clearance_mm = 5}});
    EXPECT_TRUE(report.pairs.empty());
    EXPECT_EQ(report.counters.candidate_pairs, 0U);
  }
}

TEST(RotatedObjects, NeighboursWithinTheClearanceAreFoundInAnyTurn) {
  constexpr std::uint32_t kSide = 14;
  // Pairs for each part that boxes along the axes may have: where rods stand nearly along one.
  constexpr std::uint32_t kLeftAlone = 32;
  Draw draw(7);
  for (int round = 0; round < test::rounds(3, 40); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const ClashModel m = rods(kSide, draw.rotation());
    // 30 mm from side to side, 42 from edge to edge.
    for (const double clearance : {25.0, 35.0, 45.0}) {
      const Report report = m.detect({.tolerances = {.clearance_mm = clearance}});
      const std::size_t square = clearance > 30 ? 2 * kSide * (kSide - 1) : 0;
      const std::size_t across = clearance > 42.5 ? 2 * (kSide - 1) * (kSide - 1) : 0;
      EXPECT_EQ(report.pairs.size(), square + across);
      EXPECT_LE(report.counters.candidate_pairs, kLeftAlone * kSide * kSide);
    }
  }
}

TEST(RotatedObjects, EitherBroadPhaseAndAnyTeamFindTheSame) {
  Draw draw(3);
  ClashModel m;
  constexpr int kRods = 240;
  // Four directions through each other, and boxes that stand straight among them.
  std::array<Mat3d, 4> turns;
  for (Mat3d& turn : turns) turn = draw.rotation();
  for (std::uint32_t i = 0; i < kRods; ++i) {
    m.object("r" + std::to_string(i));
    m.body(diagonal_rod(i / 4, kRods / 4, 150), {turns[i % 4], {}});
  }
  for (int i = 0; i < 40; ++i) {
    const geometry::Vec3d at{draw.between(-6000, 6000), draw.between(-6000, 6000),
                             draw.between(-6000, 6000)};
    m.box("b" + std::to_string(i), at, at + geometry::Vec3d{300, 400, 500});
  }
  Options options{.tolerances = {.clearance_mm = 20}};
  options.engine.broad_phase = BroadPhase::all_pairs;
  const Report oracle = m.detect(options);
  EXPECT_GT(oracle.pairs.size(), 50U);
  options.engine.broad_phase = BroadPhase::tree;
  for (const unsigned threads : {1U, 3U}) {
    parallel::Team team(threads);
    const Report report = m.detect(options, {.team = &team, .stop = {}});
    EXPECT_EQ(report.hash, oracle.hash);
    EXPECT_EQ(report.counters.candidate_pairs, oracle.counters.candidate_pairs);
  }
  // Each body on its own against each: nothing is many then.
  std::size_t found = 0;
  std::uint64_t candidates = 0;
  for (std::size_t i = 0; i < m.model.objects.size(); ++i) {
    const model::Scene scene = make_scene(m.model, scene_options(options), {}).value();
    Sets sets = one_set(scene);
    for (std::size_t k = 0; k < m.model.objects.size(); ++k) {
      sets.in_a[k] = k == i;
      sets.in_b[k] = k > i;
    }
    const Report report = detect(scene, sets, options, {}).value();
    found += report.pairs.size();
    candidates += report.counters.candidate_pairs;
  }
  EXPECT_EQ(found, oracle.pairs.size());
  EXPECT_LT(4 * oracle.counters.candidate_pairs, candidates);
}

}  // namespace
}  // namespace strake::clash
