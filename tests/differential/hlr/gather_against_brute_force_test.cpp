// SPDX-License-Identifier: Apache-2.0
// The engine gives, piece by piece and bit by bit, what the definition gives.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/team.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

struct Settings {
  std::int32_t unit = 1;
  double contact_mm = 0;
  std::uint32_t max_objects = 6;
  std::uint32_t sections = 0;
  bool perspective = false;
  hlr::OwnPolylines own_polylines = hlr::OwnPolylines::visible;
};

/// `pushers`: the team of the baseline, whose workers write into each other's edges.
std::string run(std::uint64_t seed, const Settings& settings, parallel::Team& pushers) {
  test::Random random(seed ^ 0x9a74e5U);
  const test::LatticeOptions lattice{.objects = 1 + random.below(settings.max_objects),
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
  hlr::Options options{.contact_distance_mm = settings.contact_mm,
                       .own_polylines = settings.own_polylines};
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
  options.solver = hlr::Solver::push;
  const auto pushed = hlr::draw(scene.scene(), {}, view, options, {.team = &pushers});
  if (!expected || !got || !unculled || !pushed)
    return expected ? "no drawing" : expected.error().text();
  const std::string culled = test::difference(expected->pieces, got->pieces);
  if (!culled.empty()) return culled;
  const std::string plain = test::difference(expected->pieces, unculled->pieces);
  if (!plain.empty()) return "without culling: " + plain;
  const std::string baseline = test::difference(expected->pieces, pushed->pieces);
  return baseline.empty() ? baseline : "pushed: " + baseline;
}

/// Scenes of a test: `usual` ones, so many that all tests together have tens of thousands, few
/// where sanitizers look for other faults; a number for each test where a longer run requests it.
std::uint64_t count(std::uint64_t usual) {
  const char* more = std::getenv("STRAKE_ORACLE_SCENES");
  if (more != nullptr) return std::strtoull(more, nullptr, 10);
  return test::kSanitized ? (usual + 19) / 20 : usual;
}

/// Seeds from 1 on, shared out over all CPUs: what the lowest one says of which `settings_of` finds
/// settings that engine and brute force do not agree on.
template <class SettingsOf>
std::string first_wrong_of(std::uint64_t seeds, SettingsOf&& settings_of) {
  parallel::Team team(parallel::default_workers());
  const Status status = parallel::for_each_with(
      {.team = &team}, {.name = "seeds", .n = seeds},
      [] { return std::make_unique<parallel::Team>(3); },
      [&](const std::unique_ptr<parallel::Team>& pushers, std::size_t i) -> Status {
        const std::uint64_t seed = i + 1;
        for (const Settings& settings : settings_of(seed))
          if (std::string wrong = run(seed, settings, *pushers); !wrong.empty())
            return Error{ErrorCode::internal,
                         fmt::format("{}, unit {}, contact distance {} mm", wrong, settings.unit,
                                     settings.contact_mm),
                         fmt::format("seed {}", seed),
                         {}};
        return {};
      });
  return status ? std::string() : status.error().text();
}

using Several = std::vector<Settings>;

std::string first_wrong(std::uint64_t seeds, const Settings& settings) {
  return first_wrong_of(seeds, [&](std::uint64_t) { return Several{settings}; });
}

TEST(GatherAgainstBruteForce, FinestLattice) { EXPECT_EQ(first_wrong(count(3000), {}), ""); }

TEST(GatherAgainstBruteForce, ContactDistanceOnACoarseLattice) {
  EXPECT_EQ(first_wrong(count(1500), {.unit = 1000, .contact_mm = -1}), "");
}

TEST(GatherAgainstBruteForce, ContactDistanceOfTheLatticesOwnSize) {
  EXPECT_EQ(first_wrong(count(1500), {.unit = 6, .contact_mm = 0.003}), "");
}

// Steps of the lattice are sides of the tiles that are asked whether they are covered.
TEST(GatherAgainstBruteForce, TilesOnTheLattice) {
  const Settings settings{.unit = 1 << 20, .contact_mm = -1, .max_objects = 12};
  EXPECT_EQ(first_wrong(count(1000), settings), "");
}

TEST(GatherAgainstBruteForce, HugeLattice) {
  EXPECT_EQ(first_wrong(count(1000), {.unit = 357913941, .contact_mm = -1}), "");
}

TEST(GatherAgainstBruteForce, Crowd) {
  const std::uint64_t seeds = std::max<std::uint64_t>(12, count(24) / 50);
  EXPECT_EQ(first_wrong(seeds, {.max_objects = 40}), "");
}

Several with_sections(std::uint64_t seed) {
  Several all;
  for (const std::int32_t unit : {1, 7, 1000})
    for (const double contact : {0.0, -1.0})
      all.push_back({.unit = unit,
                     .contact_mm = contact,
                     .sections = 1 + static_cast<std::uint32_t>(seed % 3)});
  return all;
}

TEST(GatherAgainstBruteForce, Sections) {
  EXPECT_EQ(first_wrong_of(count(1000), with_sections), "");
}

constexpr Settings kHugeSections{.unit = 357913941, .contact_mm = -1, .sections = 2};

TEST(GatherAgainstBruteForce, SectionsOfAHugeLattice) {
  EXPECT_EQ(first_wrong(count(400), kHugeSections), "");
}

// Hatch lines a unit outside what limits were taken to spare.
TEST(GatherAgainstBruteForce, HatchBesideTheLimits) {
  parallel::Team pushers(3);
  for (const Settings& settings : with_sections(2080)) EXPECT_EQ(run(2080, settings, pushers), "");
  EXPECT_EQ(run(9559, kHugeSections, pushers), "");
}

TEST(GatherAgainstBruteForce, PerspectiveOnTheFinestLattice) {
  EXPECT_EQ(first_wrong(count(3000), {.perspective = true}), "");
}

TEST(GatherAgainstBruteForce, PerspectiveAndContactDistance) {
  const auto settings_of = [](std::uint64_t) {
    return Several{{.unit = 1000, .contact_mm = -1, .perspective = true},
                   {.unit = 6, .contact_mm = 0.003, .perspective = true}};
  };
  EXPECT_EQ(first_wrong_of(count(1000), settings_of), "");
}

TEST(GatherAgainstBruteForce, PerspectiveOfALargeCrowd) {
  const Settings settings{
      .unit = 1 << 20, .contact_mm = -1, .max_objects = 16, .perspective = true};
  EXPECT_EQ(first_wrong(count(400), settings), "");
}

TEST(GatherAgainstBruteForce, PolylinesHiddenByTheirOwnObject) {
  const auto settings_of = [](std::uint64_t seed) {
    Several all = with_sections(seed);
    all.push_back({.max_objects = 12});
    all.push_back({.unit = 1 << 20, .contact_mm = -1, .max_objects = 12});
    all.push_back({.perspective = true});
    all.push_back({.unit = 1000, .contact_mm = -1, .sections = 1, .perspective = true});
    for (Settings& settings : all) settings.own_polylines = hlr::OwnPolylines::hidden;
    return all;
  };
  EXPECT_EQ(first_wrong_of(count(400), settings_of), "");
}

// Seed 245 has a plane that is square to the horizontal of the paper.
TEST(GatherAgainstBruteForce, PerspectiveAndSections) {
  const auto settings_of = [](std::uint64_t seed) {
    return Several{{.unit = seed % 2 == 0 ? 1 : 1000,
                    .contact_mm = -1,
                    .sections = 1 + static_cast<std::uint32_t>(seed % 3),
                    .perspective = true}};
  };
  EXPECT_EQ(first_wrong_of(count(1000), settings_of), "");
}

}  // namespace
}  // namespace strake
