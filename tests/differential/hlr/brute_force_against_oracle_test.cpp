// SPDX-License-Identifier: Apache-2.0
// The brute-force solver, which judges the engine, is judged here by the midpoint oracle.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "strake/hlr/hlr.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

struct Case {
  std::uint64_t seed = 0;
  std::int32_t unit = 1;
  double contact_mm = 0;
  bool perspective = false;
  hlr::OwnPolylines own_polylines = hlr::OwnPolylines::visible;
};

/// The intersections from end to end, where the window cuts them too.
std::vector<hlr::EdgePiece> whole_lines(const std::vector<hlr::EdgePiece>& pieces) {
  std::vector<hlr::EdgePiece> lines;
  for (const hlr::EdgePiece& p : pieces) {
    if (p.kind != hlr::EdgeKind::intersection) continue;
    if (!lines.empty() && lines.back().object == p.object && lines.back().edge == p.edge)
      lines.back().b = p.b;
    else
      lines.push_back(p);
  }
  return lines;
}

/// `crossings`: how many lines were intersections, added up.
std::string run(const Case& c, std::size_t& crossings) {
  const test::LatticeOptions lattice{.objects = 2 + static_cast<std::uint32_t>(c.seed % 3),
                                     .unit = c.unit,
                                     .steps = 2 + static_cast<std::uint32_t>(c.seed % 2)};
  const test::SceneBuilder scene = test::lattice_scene(c.seed, lattice);
  test::Random random(c.seed ^ 0x5eedU);
  hlr::View view;
  if (c.perspective)
    view = test::random_perspective(random, lattice);
  else
    view.direction = test::direction_of(random.below(test::kDirections));
  const hlr::View plain_view = view;
  view.limits = test::random_limits(random, lattice);
  hlr::Options options{.solver = hlr::Solver::brute_force, .contact_distance_mm = c.contact_mm};
  options.keep_specks = true;
  options.own_polylines = c.own_polylines;
  options.intersections = static_cast<hlr::Intersections>(c.seed % 4);
  if (random.one_in(6)) options.stage = random.one_in(2) ? hlr::Stage::local : hlr::Stage::none;
  const auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  if (!drawing) return drawing.error().text();
  options.stage = hlr::Stage::none;
  const auto plain = hlr::draw(scene.scene(), {}, plain_view, options, {});
  options.stage = drawing->options.stage;
  const std::vector<hlr::EdgePiece> lines = whole_lines(plain->pieces);
  crossings += lines.size();
  return test::difference(test::oracle_pieces(scene.scene(), view, options, lines),
                          drawing->pieces);
}

std::uint64_t count(std::uint64_t usual) {
  const char* more = std::getenv("STRAKE_ORACLE_SCENES");
  return more != nullptr ? std::strtoull(more, nullptr, 10) : test::rounds(usual);
}

TEST(BruteForceAgainstOracle, TiesDoNotHideOnTheFinestLattice) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(24); ++seed)
    ASSERT_EQ(run({.seed = seed}, crossings), "") << "seed " << seed;
  EXPECT_GT(crossings, 0U);
}

/// One of its edges turns by a little more than the sharp angle: less than rounding may add.
TEST(BruteForceAgainstOracle, WhatRoundingMayHaveMadeSharpIsNot) {
  std::size_t crossings = 0;
  constexpr std::uint64_t kSeed = 1371;
  EXPECT_EQ(run({.seed = kSeed}, crossings), "");
  EXPECT_EQ(run({.seed = kSeed, .unit = 6, .contact_mm = 0.003}, crossings), "");
  EXPECT_EQ(run({.seed = kSeed, .perspective = true}, crossings), "");
}

TEST(BruteForceAgainstOracle, ContactDistanceOnACoarseLattice) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(12); ++seed)
    ASSERT_EQ(run({.seed = seed, .unit = 1000, .contact_mm = -1}, crossings), "")
        << "seed " << seed;
  EXPECT_GT(crossings, 0U);
}

TEST(BruteForceAgainstOracle, ContactDistanceOfTheLatticesOwnSize) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(12); ++seed)
    ASSERT_EQ(run({.seed = seed, .unit = 6, .contact_mm = 0.003}, crossings), "")
        << "seed " << seed;
  EXPECT_GT(crossings, 0U);
}

TEST(BruteForceAgainstOracle, Perspective) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(12); ++seed)
    ASSERT_EQ(run({.seed = seed, .perspective = true}, crossings), "") << "seed " << seed;
  EXPECT_GT(crossings, 0U);
}

TEST(BruteForceAgainstOracle, PerspectiveAndContactDistance) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(4); ++seed) {
    ASSERT_EQ(run({.seed = seed, .unit = 6, .contact_mm = 0.003, .perspective = true}, crossings),
              "")
        << "seed " << seed;
    ASSERT_EQ(run({.seed = seed, .unit = 1000, .contact_mm = -1, .perspective = true}, crossings),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(crossings, 0U);
}

TEST(BruteForceAgainstOracle, PolylinesHiddenByTheirOwnObject) {
  constexpr auto kHidden = hlr::OwnPolylines::hidden;
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= count(8); ++seed)
    for (const Case& c :
         {Case{.seed = seed, .own_polylines = kHidden},
          Case{.seed = seed, .unit = 6, .contact_mm = 0.003, .own_polylines = kHidden},
          Case{.seed = seed, .perspective = true, .own_polylines = kHidden}})
      ASSERT_EQ(run(c, crossings), "") << "seed " << seed << ", unit " << c.unit;
  EXPECT_GT(crossings, 0U);
}

}  // namespace
}  // namespace strake
