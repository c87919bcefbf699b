// SPDX-License-Identifier: Apache-2.0
// The engine gives, piece by piece and bit by bit, what the definition gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

struct Settings {
  std::int32_t unit = 1;
  double contact_mm = 0;
  std::uint32_t most_objects = 6;
  std::uint32_t sections = 0;
  bool perspective = false;
};

std::string run(std::uint64_t seed, const Settings& settings) {
  test::Random random(seed ^ 0x9a74e5U);
  const test::LatticeOptions lattice{.objects = 1 + random.below(settings.most_objects),
                                     .unit = settings.unit,
                                     .steps = 1 + random.below(3)};
  const test::SceneBuilder scene = test::lattice_scene(seed, lattice);
  hlr::View view;
  if (settings.perspective)
    view = test::random_perspective(random, lattice);
  else
    view.direction = test::direction_of(random.below(test::kDirections));
  view.limits = test::random_limits(random, lattice);
  for (std::uint32_t i = 0; i < settings.sections; ++i)
    view.sections.push_back(test::random_section(random, lattice));
  hlr::Options options{.contact_distance_mm = settings.contact_mm};
  if (random.one_in(8)) options.stage = random.one_in(2) ? hlr::Stage::local : hlr::Stage::none;
  if (random.one_in(4)) options.sharp_angle_deg = random.one_in(2) ? 0 : 180;
  options.solver = hlr::Solver::brute_force;
  const auto expected = hlr::draw(scene.scene(), {}, view, options, {});
  options.solver = hlr::Solver::gather;
  constexpr std::array<std::int32_t, 6> kBucketing{
      hlr::Options::kBucketsByData, hlr::Options::kNoBuckets, 1, 2, 5, 64};
  options.bucketing = kBucketing[random.below(kBucketing.size())];
  const auto got = hlr::draw(scene.scene(), {}, view, options, {});
  options.culling = false;
  const auto unculled = hlr::draw(scene.scene(), {}, view, options, {});
  // The baseline, whose workers write into each other's edges.
  static parallel::Team team(3);
  options.solver = hlr::Solver::push;
  const auto pushed = hlr::draw(scene.scene(), {}, view, options, {.team = &team});
  if (!expected || !got || !unculled || !pushed)
    return expected ? "no drawing" : expected.error().text();
  const std::string culled = test::difference(expected->pieces, got->pieces);
  if (!culled.empty()) return culled;
  const std::string plain = test::difference(expected->pieces, unculled->pieces);
  if (!plain.empty()) return "without culling: " + plain;
  const std::string baseline = test::difference(expected->pieces, pushed->pieces);
  return baseline.empty() ? baseline : "pushed: " + baseline;
}

std::uint64_t count(std::uint64_t usual) {
  const char* more = std::getenv("STRAKE_ORACLE_SCENES");
  return more != nullptr ? std::strtoull(more, nullptr, 10) : test::rounds(usual);
}

TEST(GatherAgainstBruteForce, FinestLattice) {
  for (std::uint64_t seed = 1; seed <= count(900); ++seed)
    ASSERT_EQ(run(seed, {}), "") << "seed " << seed;
}

TEST(GatherAgainstBruteForce, ContactDistanceOnACoarseLattice) {
  for (std::uint64_t seed = 1; seed <= count(450); ++seed)
    ASSERT_EQ(run(seed, {.unit = 1000, .contact_mm = -1}), "") << "seed " << seed;
}

TEST(GatherAgainstBruteForce, ContactDistanceOfTheLatticesOwnSize) {
  for (std::uint64_t seed = 1; seed <= count(450); ++seed)
    ASSERT_EQ(run(seed, {.unit = 6, .contact_mm = 0.003}), "") << "seed " << seed;
}

// Steps of the lattice are sides of the tiles that are asked whether they are covered.
TEST(GatherAgainstBruteForce, TilesOnTheLattice) {
  for (std::uint64_t seed = 1; seed <= count(300); ++seed)
    ASSERT_EQ(run(seed, {.unit = 1 << 20, .contact_mm = -1, .most_objects = 12}), "")
        << "seed " << seed;
}

TEST(GatherAgainstBruteForce, HugeLattice) {
  for (std::uint64_t seed = 1; seed <= count(300); ++seed)
    ASSERT_EQ(run(seed, {.unit = 357913941, .contact_mm = -1}), "") << "seed " << seed;
}

TEST(GatherAgainstBruteForce, Crowd) {
  for (std::uint64_t seed = 1; seed <= std::max<std::uint64_t>(12, count(12) / 50); ++seed)
    ASSERT_EQ(run(seed, {.most_objects = 40}), "") << "seed " << seed;
}

TEST(GatherAgainstBruteForce, Sections) {
  for (std::uint64_t seed = 1; seed <= count(300); ++seed)
    for (const std::int32_t unit : {1, 7, 1000})
      for (const double contact : {0.0, -1.0})
        ASSERT_EQ(run(seed, {.unit = unit,
                             .contact_mm = contact,
                             .sections = 1 + static_cast<std::uint32_t>(seed % 3)}),
                  "")
            << "seed " << seed << " unit " << unit << " contact " << contact;
}

TEST(GatherAgainstBruteForce, SectionsOfAHugeLattice) {
  for (std::uint64_t seed = 1; seed <= count(100); ++seed)
    ASSERT_EQ(run(seed, {.unit = 357913941, .contact_mm = -1, .sections = 2}), "")
        << "seed " << seed;
}

TEST(GatherAgainstBruteForce, PerspectiveOnTheFinestLattice) {
  for (std::uint64_t seed = 1; seed <= count(900); ++seed)
    ASSERT_EQ(run(seed, {.perspective = true}), "") << "seed " << seed;
}

TEST(GatherAgainstBruteForce, PerspectiveAndContactDistance) {
  for (std::uint64_t seed = 1; seed <= count(300); ++seed) {
    ASSERT_EQ(run(seed, {.unit = 1000, .contact_mm = -1, .perspective = true}), "")
        << "seed " << seed;
    ASSERT_EQ(run(seed, {.unit = 6, .contact_mm = 0.003, .perspective = true}), "")
        << "seed " << seed;
  }
}

TEST(GatherAgainstBruteForce, PerspectiveOfALargeCrowd) {
  for (std::uint64_t seed = 1; seed <= count(200); ++seed)
    ASSERT_EQ(
        run(seed, {.unit = 1 << 20, .contact_mm = -1, .most_objects = 16, .perspective = true}), "")
        << "seed " << seed;
}

TEST(GatherAgainstBruteForce, PerspectiveAndSections) {
  for (std::uint64_t seed = 1; seed <= count(200); ++seed)
    ASSERT_EQ(run(seed, {.unit = seed % 2 == 0 ? 1 : 1000,
                         .contact_mm = -1,
                         .sections = 1 + static_cast<std::uint32_t>(seed % 3),
                         .perspective = true}),
              "")
        << "seed " << seed;
}

}  // namespace
}  // namespace strake
