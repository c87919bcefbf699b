// SPDX-License-Identifier: Apache-2.0
// What must hold of any drawing in perspective, and what must not change it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "strake/geometry/wide_int.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/drawn_pieces.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/mapped_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using hlr::EdgePiece;
using hlr::State;
using test::pieces;

constexpr auto kSeeds = test::rounds<std::uint64_t>(100);
constexpr std::int32_t kUnit = 1000;

test::LatticeOptions lattice(std::uint64_t seed) {
  return {.objects = 2 + static_cast<std::uint32_t>(seed % 5), .unit = kUnit, .steps = 3};
}

hlr::View view_of(std::uint64_t seed) {
  test::Random random(seed * 77);
  return test::random_perspective(random, lattice(seed));
}

hlr::View from(const Vec3l& eye, const Vec3l& target) {
  return {.direction = eye - target,
          .limits = {},
          .perspective = hlr::Perspective{.eye = eye, .target = target, .near_mm = 0.001}};
}

double length(const EdgePiece& p) {
  const auto v = (p.b - p.a).as<double>();
  return std::sqrt(dot(v, v));
}

TEST(PerspectiveLaws, SameForAnyNumberOfThreads) {
  const test::SceneBuilder scene =
      test::lattice_scene(5, {.objects = 60, .unit = kUnit, .steps = 6});
  for (const Vec3l& eye : {Vec3l{-7000, -9000, 8500}, Vec3l{2500, 3000, 2750}}) {
    const hlr::View view = from(eye, {4000, 4500, 3000});
    const std::vector<EdgePiece> one = pieces(scene.scene(), view);
    EXPECT_GT(one.size(), 1000U);
    for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
      parallel::Team team(threads);
      EXPECT_EQ(test::difference(one, pieces(scene.scene(), view, {}, {.team = &team})), "")
          << threads << " threads";
    }
  }
}

TEST(PerspectiveLaws, PiecesOfAnEdgeFollowEachOtherFromEndToEnd) {
  std::array<std::size_t, 5> count{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    const EdgePiece* last = nullptr;
    const std::vector<EdgePiece> drawn = pieces(scene.scene(), view_of(seed));
    for (const EdgePiece& p : drawn) {
      ++count[static_cast<std::size_t>(p.state)];
      const bool same = last != nullptr && last->object == p.object && last->edge == p.edge;
      if (same) {
        ASSERT_EQ(last->b, p.a) << "seed " << seed;
        ASSERT_NE(last->state, p.state) << "seed " << seed;
      }
      last = &p;
    }
  }
  for (std::size_t state = 0; state < count.size(); ++state)
    EXPECT_GT(count[state], state == 3 ? 0U : 100U) << "state " << state;
}

// An end that is rounded to the grid is off by less than a unit along each axis.
TEST(PerspectiveLaws, WhatIsDrawnLiesInTheWindow) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    const hlr::View view = view_of(seed);
    const auto window = hlr::window(view);
    ASSERT_EQ(window.size(), 5U);
    for (const EdgePiece& p : pieces(scene.scene(), view)) {
      if (p.state == State::projecting) continue;
      bool within = true;
      for (const hlr::HalfSpace& h : window) {
        const std::int64_t room =
            std::abs(h.normal.x) + std::abs(h.normal.y) + std::abs(h.normal.z);
        const Vec3l& eye = view.perspective->eye;
        const std::int64_t a = dot(h.normal, p.a - eye) - h.least;
        const std::int64_t b = dot(h.normal, p.b - eye) - h.least;
        within = within && std::min(a, b) > room;
        if (p.state != State::clipped) {
          ASSERT_GE(std::min(a, b), -room) << "seed " << seed;
        }
      }
      ASSERT_FALSE(within && p.state == State::clipped && length(p) > 3) << "seed " << seed;
    }
  }
}

/// Lengths by object, kind and state.
std::map<std::array<std::uint32_t, 3>, double> lengths(const std::vector<EdgePiece>& list) {
  std::map<std::array<std::uint32_t, 3>, double> result;
  for (const EdgePiece& p : list)
    result[{model::index(p.object), static_cast<std::uint32_t>(p.kind),
            static_cast<std::uint32_t>(p.state)}] += length(p);
  return result;
}

TEST(PerspectiveLaws, QuarterTurnsOfModelAndViewKeepEveryLength) {
  const auto turned = [](const Vec3l& p) { return Vec3l{-p.y, p.x, p.z}; };
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder plain = test::lattice_scene(seed, lattice(seed));
    const test::SceneBuilder other = test::mapped(plain.scene(), turned);
    hlr::View view = view_of(seed);
    const hlr::Options options{.intersections = hlr::Intersections::off};
    const std::vector<EdgePiece> before = pieces(plain.scene(), view, options);
    view.direction = turned(view.direction);
    view.up = turned(view.up);
    view.perspective->eye = turned(view.perspective->eye);
    view.perspective->target = turned(view.perspective->target);
    const std::vector<EdgePiece> after = pieces(other.scene(), view, options);
    const double slack = 2 * static_cast<double>(before.size());
    auto expected = lengths(before), got = lengths(after);
    for (const auto& [key, value] : expected)
      ASSERT_NEAR(value, got[key], slack) << "seed " << seed;
    for (const auto& [key, value] : got)
      ASSERT_NEAR(value, expected[key], slack) << "seed " << seed;
  }
}

TEST(PerspectiveLaws, TranslationMovesThePiecesAndNothingElse) {
  const Vec3l offset{12345678, -7777777, 31};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder plain = test::lattice_scene(seed, lattice(seed));
    const test::SceneBuilder other =
        test::mapped(plain.scene(), [&](const Vec3l& p) { return p + offset; });
    hlr::View view = view_of(seed);
    // Ends of intersections are rounded in the coordinates of their shapes.
    const hlr::Options options{.intersections = hlr::Intersections::off};
    std::vector<EdgePiece> expected = pieces(plain.scene(), view, options);
    for (EdgePiece& p : expected) {
      p.a = p.a + offset;
      p.b = p.b + offset;
    }
    view.perspective->eye = view.perspective->eye + offset;
    view.perspective->target = view.perspective->target + offset;
    ASSERT_EQ(test::difference(expected, pieces(other.scene(), view, options)), "")
        << "seed " << seed;
  }
}

TEST(PerspectiveLaws, ScalingByAPowerOfTwoKeepsEveryState) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder plain = test::lattice_scene(seed, lattice(seed));
    const test::SceneBuilder scaled =
        test::mapped(plain.scene(), [](const Vec3l& p) { return p * 16; });
    hlr::View view = view_of(seed);
    // What is a speck hangs on how the ends are rounded.
    hlr::Options options{.contact_distance_mm = 0.003,
                         .intersections = hlr::Intersections::off,
                         .keep_specks = true};
    const std::vector<EdgePiece> small = pieces(plain.scene(), view, options);
    view.perspective->eye = view.perspective->eye * 16;
    view.perspective->target = view.perspective->target * 16;
    // The near plane is rounded to whole products with the direction: that of a unit is one.
    view.perspective->near_mm *= 16;
    options.contact_distance_mm *= 16;
    const std::vector<EdgePiece> large = pieces(scaled.scene(), view, options);
    ASSERT_EQ(small.size(), large.size()) << "seed " << seed;
    for (std::size_t i = 0; i < small.size(); ++i) {
      ASSERT_EQ(small[i].state, large[i].state) << "seed " << seed;
      for (int k = 0; k < 3; ++k) {
        ASSERT_LE(std::abs(small[i].a[k] * 16 - large[i].a[k]), 24) << "seed " << seed;
        ASSERT_LE(std::abs(small[i].b[k] * 16 - large[i].b[k]), 24) << "seed " << seed;
      }
    }
  }
}

double visible_length(const std::vector<EdgePiece>& list, std::uint32_t objects) {
  double sum = 0;
  for (const EdgePiece& p : list)
    if (p.state == State::visible && model::index(p.object) < objects) sum += length(p);
  return sum;
}

TEST(PerspectiveLaws, ObjectsBehindChangeNothingAndObjectsInFrontRevealNothing) {
  const hlr::Options options{.intersections = hlr::Intersections::off};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::uint32_t objects = lattice(seed).objects;
    test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    const hlr::View view = view_of(seed);
    const std::vector<EdgePiece> before = pieces(scene.scene(), view, options);
    // Beyond all segments between the eye and what is drawn.
    scene.object({{.parts = {test::hand_box({0, 0, 0}, {90000, 90000, 90000})},
                   .origin = {300000, 300000, 300000}}});
    std::vector<EdgePiece> behind = pieces(scene.scene(), view, options);
    behind.resize(std::min(behind.size(), before.size()));
    ASSERT_EQ(test::difference(before, behind), "") << "seed " << seed;

    const double open = visible_length(before, objects);
    scene.object({{.parts = {test::hand_box({500, 500, 500}, {2500, 2000, 1500})},
                   .origin = {0, 0, static_cast<std::int64_t>(seed % 4) * 500}}});
    ASSERT_LE(visible_length(pieces(scene.scene(), view, options), objects),
              open + 2 * static_cast<double>(before.size()))
        << "seed " << seed;
  }
}

TEST(PerspectiveLaws, ABoxRoundTheEyeHidesAllAndIsReported) {
  test::SceneBuilder scene = test::lattice_scene(3, lattice(3));
  const hlr::View view = from({-9000, -7000, 5001}, {1500, 1500, 1500});
  EXPECT_GT(visible_length(pieces(scene.scene(), view), 5), 0);
  scene.object(
      {{.parts = {test::hand_box({-9, -9, -9}, {9, 9, 9})}, .origin = {-9000, -7000, 5001}}});
  const auto drawing = hlr::draw(scene.scene(), {}, view, {}, {});
  ASSERT_TRUE(drawing.has_value());
  EXPECT_EQ(visible_length(drawing->pieces, lattice(3).objects), 0);
  EXPECT_EQ(drawing->diagnostics.count("eye-in-solid"), 1U);
}

// Pieces of a scene seen from afar are those of the orthographic view.
TEST(PerspectiveLaws, AnEyeFarAwaySeesWhatADirectionSees) {
  const Vec3l direction{1048573, -524287, 699967};  // nothing of the lattice lies in line with it
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    const Vec3l middle{1500, 1500, 1500};
    hlr::View far = from(middle + direction * 1000000, middle);
    far.direction = direction;
    const std::vector<EdgePiece> expected =
        pieces(scene.scene(), {.direction = direction, .limits = {}});
    const std::vector<EdgePiece> got = pieces(scene.scene(), far);
    ASSERT_EQ(expected.size(), got.size()) << "seed " << seed;
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_EQ(expected[i].state, got[i].state) << "seed " << seed;
      for (int k = 0; k < 3; ++k) {
        ASSERT_LE(std::abs(expected[i].a[k] - got[i].a[k]), 1) << "seed " << seed;
        ASSERT_LE(std::abs(expected[i].b[k] - got[i].b[k]), 1) << "seed " << seed;
      }
    }
    compared += got.size();
  }
  EXPECT_GT(compared, 50 * kSeeds);
}

TEST(PerspectiveInput, WhatMakesNoSenseIsAnError) {
  const test::SceneBuilder scene = test::lattice_scene(3, lattice(3));
  const hlr::View good = from({-9000, -7000, 5000}, {1500, 1500, 1500});
  const auto refused = [&](auto&& spoil) {
    hlr::View view = good;
    spoil(view);
    return !hlr::draw(scene.scene(), {}, view, {}, {}).has_value();
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](hlr::View&) {}));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->target = v.perspective->eye; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.direction = -v.direction; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->near_mm = kNan; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->near_mm = -1; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->near_mm = 100; }));  // behind the target
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->field_of_view_deg = kNan; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->field_of_view_deg = 180; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->eye.x = INT64_MIN; }));
  EXPECT_TRUE(refused([](hlr::View& v) { v.perspective->eye = -v.direction * -200000000; }));
}

TEST(PerspectiveInput, LimitsOfLargeObjectsSeenFromAfarAreRefusedRatherThanOverflow) {
  test::SceneBuilder scene;
  constexpr std::int32_t kLarge = 1000000000;
  scene.object({{.parts = {test::hand_box({0, 0, 0}, {kLarge, kLarge, kLarge})}, .origin = {}}});
  hlr::View view = from({-(std::int64_t{1} << 34), 5, 9}, {0, 0, 0});
  view.direction = {-1, 0, 0};
  EXPECT_TRUE(hlr::draw(scene.scene(), {}, view, {}, {}).has_value());
  view.limits = geometry::Box3l{{0, 0, 0}, {kLarge / 2, kLarge, kLarge}};
  EXPECT_FALSE(hlr::draw(scene.scene(), {}, view, {}, {}).has_value());
}

TEST(PerspectiveInput, AllBehindTheEyeIsClippedAndCounted) {
  const test::SceneBuilder scene = test::lattice_scene(3, lattice(3));
  const auto drawing =
      hlr::draw(scene.scene(), {}, from({90000, 90000, 90000}, {99000, 99000, 99999}), {}, {});
  ASSERT_TRUE(drawing.has_value());
  for (const EdgePiece& p : drawing->pieces) ASSERT_EQ(p.state, State::clipped);
  EXPECT_GT(drawing->pieces.size(), 0U);
}

TEST(PerspectiveInput, AnEyeOnAVertexSeesTheOtherFaces) {
  test::SceneBuilder scene;
  scene.object({{.parts = {test::hand_box({0, 0, 0}, {1000, 1000, 1000})}, .origin = {}}});
  scene.object(
      {{.parts = {test::hand_box({0, 0, 0}, {1000, 1000, 1000})}, .origin = {5000, 5000, 5000}}});
  const auto drawing =
      hlr::draw(scene.scene(), {}, from({1000, 1000, 1000}, {5500, 5500, 5500}), {}, {});
  ASSERT_TRUE(drawing.has_value());
  EXPECT_EQ(drawing->diagnostics.count("eye-on-surface"), 1U);
  double far_box = 0;
  for (const EdgePiece& p : drawing->pieces)
    if (model::index(p.object) == 1 && p.state == State::visible) far_box += length(p);
  // All but the three edges at the far corner.
  EXPECT_NEAR(far_box, 9000, 10);
}

}  // namespace
}  // namespace strake
