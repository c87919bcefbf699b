// SPDX-License-Identifier: Apache-2.0
// What covers whole tiles, and what bodies of one shape share, changes the work and not the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using test::hand_box;
using test::HandBody;
using test::HandPart;
using test::Random;
using test::SceneBuilder;

constexpr std::int32_t kExtent = 1 << 20;

Vec3i some_point(Random& random, std::int32_t step) {
  const auto at = [&] {
    return static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(kExtent / step))) *
           step;
  };
  return {at(), at(), at()};
}

/// A plate across one axis, now and then askew by a shear so that its faces are in no plane of
/// coordinates, and now and then so small that it holds a few tiles at most.
HandPart plate(Random& random, std::int32_t step) {
  const int across = static_cast<int>(random.below(3));
  const Vec3i lo = some_point(random, step);
  Vec3i size = some_point(random, step) + Vec3i{step, step, step};
  if (random.one_in(3)) size = {size.x / 8 + 1, size.y / 8 + 1, size.z / 8 + 1};
  size[across] = random.one_in(4) ? 3 : 2000;
  HandPart part = hand_box(lo, lo + size);
  if (random.one_in(3)) {
    const int other = (across + 1) % 3;
    for (Vec3i& v : part.vertices) v[across] += (v[other] - lo[other]) / 4;
    part.faces.clear();
  }
  return part;
}

SceneBuilder crowd(std::uint64_t seed) {
  Random random(seed);
  // Steps of a power of two put edges on the sides of tiles.
  const std::int32_t step = random.one_in(2) ? 1 : kExtent / 64;
  SceneBuilder scene;
  const std::uint32_t plates = 4 + random.below(12), boxes = 1 + random.below(4);
  for (std::uint32_t i = 0; i < plates; ++i) {
    std::vector<HandBody> bodies;
    const std::uint32_t count = random.one_in(4) ? 2 : 1;
    for (std::uint32_t k = 0; k < count; ++k) {
      HandBody body{.parts = {plate(random, step)},
                    .origin = {},
                    .alpha = static_cast<std::uint8_t>(random.one_in(8) ? 128 : 255)};
      if (random.one_in(4)) body.parts.push_back(plate(random, step));
      bodies.push_back(body);
    }
    if (random.one_in(6))
      bodies.push_back({.parts = {{.vertices = {},
                                   .triangles = {},
                                   .faces = {},
                                   .chains = {{some_point(random, step), some_point(random, step),
                                               some_point(random, step)}}}},
                        .origin = {}});
    scene.object(bodies);
  }
  std::uint32_t next = plates;
  for (std::uint32_t i = 0; i < boxes; ++i) {
    const Vec3i lo = some_point(random, step);
    const std::int32_t size = 1000 + static_cast<std::int32_t>(random.below(30000));
    const HandPart one = hand_box(lo, lo + Vec3i{size, size, 2 * size});
    const HandPart two =
        hand_box(lo + Vec3i{size / 2, 0, size}, lo + Vec3i{3 * size, size, 3 * size});
    scene.object({{.parts = {one, two}, .origin = {}}});
    const std::uint32_t first = next++;
    for (std::uint32_t k = random.below(20); k > 0; --k, ++next)
      scene.instance(first, (some_point(random, step) - lo).as<std::int64_t>());
  }
  return scene;
}

Vec3l some_direction(Random& random) {
  if (random.one_in(2)) return test::direction_of(random.below(test::kDirections));
  const auto component = [&] {
    return static_cast<std::int64_t>(random.below(1U << 21)) - (1 << 20);
  };
  return {component(), component(), 1 + static_cast<std::int64_t>(random.below(1U << 20))};
}

std::optional<geometry::Box3l> some_limits(Random& random) {
  if (!random.one_in(4)) return std::nullopt;
  const auto third = static_cast<std::int64_t>(random.below(kExtent / 3));
  return geometry::Box3l{{third, third / 2, -kExtent}, {kExtent, 2 * kExtent, kExtent + third}};
}

constexpr auto kSeeds = test::rounds<std::uint64_t>(300);

std::uint64_t face_tests(const SceneBuilder& scene, hlr::Stage stage) {
  const auto drawing = hlr::draw(scene.scene(), {}, {.limits = {}},
                                 {.stage = stage, .intersections = hlr::Intersections::off}, {});
  return drawing ? drawing->counters.face_tests : 0;
}

TEST(Culling, ChangesNothingButTheWork) {
  std::uint64_t covered = 0, culled_tests = 0, all_tests = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SceneBuilder scene = crowd(seed);
    Random random(seed * 31);
    const hlr::View view{.direction = some_direction(random), .limits = some_limits(random)};
    hlr::Options options{
        .contact_distance_mm = random.one_in(4) ? 0.5 : -1.0,
        .intersections = random.one_in(2) ? hlr::Intersections::off : hlr::Intersections::objects};
    const auto culled = hlr::draw(scene.scene(), {}, view, options, {});
    options.culling = false;
    const auto plain = hlr::draw(scene.scene(), {}, view, options, {});
    ASSERT_TRUE(culled.has_value() && plain.has_value()) << "seed " << seed;
    ASSERT_EQ(test::difference(plain->pieces, culled->pieces), "") << "seed " << seed;
    ASSERT_EQ(plain->counters.covered_edges, 0U);
    covered += culled->counters.covered_edges;
    if (options.intersections != hlr::Intersections::off) continue;
    culled_tests += culled->counters.face_tests;
    all_tests += plain->counters.face_tests;
  }
  EXPECT_GT(covered, 16 * kSeeds);
  EXPECT_LT(3 * culled_tests, all_tests);
}

TEST(Culling, LeavingHiddenPiecesOutChangesNoOther) {
  std::uint64_t left_out = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds * 2 / 5; ++seed) {
    const SceneBuilder scene = crowd(seed);
    Random random(seed * 17);
    const hlr::View view{.direction = some_direction(random), .limits = some_limits(random)};
    hlr::Options options;
    auto full = hlr::draw(scene.scene(), {}, view, options, {});
    options.hidden = false;
    const auto culled = hlr::draw(scene.scene(), {}, view, options, {});
    options.culling = random.one_in(2);
    options.solver = seed % 8 == 0 ? hlr::Solver::brute_force : hlr::Solver::gather;
    const auto other = hlr::draw(scene.scene(), {}, view, options, {});
    ASSERT_TRUE(full.has_value() && culled.has_value() && other.has_value()) << "seed " << seed;
    // Of an object of which nothing is visible its points and clipped pieces go, too.
    std::erase_if(full->pieces, [&](const hlr::EdgePiece& piece) {
      return piece.state == hlr::State::hidden_by_self ||
             piece.state == hlr::State::hidden_by_other ||
             full->account.fates[model::index(piece.object)] == hlr::Fate::hidden;
    });
    ASSERT_EQ(test::difference(full->pieces, culled->pieces), "") << "seed " << seed;
    ASSERT_EQ(test::difference(full->pieces, other->pieces), "") << "seed " << seed;
    ASSERT_EQ(full->account.fates, culled->account.fates) << "seed " << seed;
    ASSERT_EQ(full->account.fates, other->account.fates) << "seed " << seed;
    ASSERT_EQ(full->counters.left_out, 0U);
    ASSERT_EQ(culled->counters.left_out, other->counters.left_out) << "seed " << seed;
    left_out += culled->counters.left_out;
  }
  EXPECT_GT(left_out, 16 * kSeeds);
}

/// Sections and perspective clip, too.
hlr::View some_clipped_view(Random& random) {
  hlr::View view{.direction = some_direction(random), .limits = some_limits(random)};
  const auto third = static_cast<std::int64_t>(random.below(kExtent / 3));
  if (random.one_in(3)) view.limits = geometry::Box3l{{0, third, 0}, {third, 2 * third, kExtent}};
  if (random.one_in(4)) {
    const Vec3l target{third, third, third}, eye = target + Vec3l{kExtent / 2, -third - 1, third};
    view.direction = eye - target;
    view.perspective = {.eye = eye, .target = target, .near_mm = 1, .field_of_view_deg = 40};
  }
  if (random.one_in(3)) view.sections.push_back({{0, 1, 0}, {0, 2 * third, 0}});
  return view;
}

/// Removes the pieces of each edge that has nothing but clipped ones. Returns how many each object
/// had.
std::vector<std::uint32_t> leave_out_clipped(hlr::Drawing& drawing) {
  std::vector<std::uint32_t> counts(drawing.account.fates.size());
  std::vector<hlr::EdgePiece> kept;
  for (std::size_t first = 0, last = 0; first < drawing.pieces.size(); first = last) {
    const hlr::EdgePiece& edge = drawing.pieces[first];
    bool clipped = true;
    for (; last < drawing.pieces.size() && drawing.pieces[last].object == edge.object &&
           drawing.pieces[last].edge == edge.edge;
         ++last)
      clipped = clipped && drawing.pieces[last].state == hlr::State::clipped;
    const auto at = drawing.pieces.begin() + static_cast<std::ptrdiff_t>(first);
    if (clipped)
      counts[model::index(edge.object)] += static_cast<std::uint32_t>(last - first);
    else
      kept.insert(kept.end(), at, drawing.pieces.begin() + static_cast<std::ptrdiff_t>(last));
  }
  drawing.pieces = std::move(kept);
  return counts;
}

bool is_edge_of_part(const hlr::EdgePiece& piece) {
  return piece.kind != hlr::EdgeKind::intersection && piece.kind != hlr::EdgeKind::section &&
         piece.kind != hlr::EdgeKind::hatch;
}

/// Numbers the lines of each object that are no edges of parts anew, in their order: which numbers
/// they have depends on the lines of intersection that were found outside of the view.
void number_lines_anew(hlr::Drawing& drawing) {
  std::uint32_t before = 0, number = 0;
  for (std::size_t i = 0; i < drawing.pieces.size(); ++i) {
    hlr::EdgePiece& piece = drawing.pieces[i];
    if (is_edge_of_part(piece)) continue;
    const bool first = i == 0 || drawing.pieces[i - 1].object != piece.object ||
                       is_edge_of_part(drawing.pieces[i - 1]);
    number = first ? 0 : number + (piece.edge != before ? 1 : 0);
    before = std::exchange(piece.edge, number);
  }
}

/// Says how the counts of an object differ from those of a drawing with all clipped pieces by more
/// than lines that were not looked for. `all`: the clipped pieces that drawing had.
std::string difference_of_counts(const hlr::Drawing& full, const hlr::Drawing& other,
                                 const std::vector<std::uint32_t>& all) {
  for (std::size_t o = 0; o < all.size(); ++o) {
    const std::uint32_t lines = full.counted[o].edges - other.counted[o].edges;
    // Of an object of which nothing is visible clipped pieces are not counted.
    const bool unseen = all[o] == 0 && other.clipped_left_out[o] == 0;
    if (full.counted[o].edges < other.counted[o].edges ||
        full.counted[o].specks != other.counted[o].specks ||
        (!unseen && all[o] != other.clipped_left_out[o] + lines))
      return "object " + std::to_string(o);
  }
  return {};
}

TEST(Culling, LeavingClippedEdgesOutChangesNoOther) {
  std::uint64_t left_out = 0, kept = 0, not_found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SceneBuilder scene = crowd(seed);
    Random random(seed * 19);
    const hlr::View view = some_clipped_view(random);
    hlr::Options options;
    options.hidden = random.one_in(2);
    options.keep_specks = random.one_in(4);
    if (random.one_in(4)) options.contact_distance_mm = 0.5;
    options.solver = seed % 8 == 0                        ? hlr::Solver::brute_force
                     : seed % 8 == 4 && !view.perspective ? hlr::Solver::push
                                                          : hlr::Solver::gather;
    if (!view.sections.empty() && random.one_in(2))
      for (std::size_t o = 0; o < scene.scene().model->objects.size(); ++o)
        options.uncut.push_back(random.one_in(4));
    auto full = hlr::draw(scene.scene(), {}, view, options, {});
    options.clipped = false;
    auto other = hlr::draw(scene.scene(), {}, view, options, {});
    ASSERT_TRUE(full.has_value() && other.has_value()) << "seed " << seed;
    ASSERT_TRUE(full->clipped_left_out.empty());
    const std::vector<std::uint32_t> all = leave_out_clipped(*full);
    ASSERT_EQ(difference_of_counts(*full, *other, all), "") << "seed " << seed;
    number_lines_anew(*full);
    number_lines_anew(*other);
    ASSERT_EQ(test::difference(full->pieces, other->pieces), "") << "seed " << seed;
    ASSERT_EQ(full->account.fates, other->account.fates) << "seed " << seed;
    ASSERT_EQ(full->account.defects, other->account.defects) << "seed " << seed;
    not_found += full->counters.feature_edges - other->counters.feature_edges;
    ASSERT_EQ(full->left_out, other->left_out) << "seed " << seed;
    for (const std::uint32_t pieces : other->clipped_left_out) left_out += pieces;
    kept += static_cast<std::uint64_t>(
        std::ranges::count(other->pieces, hlr::State::clipped, &hlr::EdgePiece::state));
  }
  EXPECT_GT(left_out, 16 * kSeeds);
  EXPECT_GT(kept, kSeeds);
  EXPECT_GT(not_found, kSeeds);
}

TEST(Culling, WhatCrossesOutsideOfTheLimitsIsNotLookedFor) {
  SceneBuilder scene;
  const HandPart post = hand_box({0, 0, -5000}, {900, 900, 5000});
  const HandPart plate = hand_box({-3000, -3000, 0}, {3000, 3000, 500});
  scene.object({{.parts = {post}, .origin = {}}});
  scene.object({{.parts = {plate}, .origin = {}}});
  for (int i = 1; i < 20; ++i) {
    scene.instance(0, {20000 * i, 0, 0});
    scene.instance(1, {20000 * i, 0, 200 * i});
  }
  hlr::View view{.direction = {1, -2, 3}};
  const auto pairs = [&](bool clipped) {
    const auto drawing = hlr::draw(scene.scene(), {}, view, {.clipped = clipped}, {});
    return drawing ? drawing->counters.crossing_pairs : 0;
  };
  EXPECT_EQ(pairs(false), 20U);
  // One pair meets them; a second post does, but not its plate.
  view.limits = geometry::Box3l{{-4000, -4000, -6000}, {20500, 4000, -1000}};
  EXPECT_EQ(pairs(true), 20U);
  EXPECT_EQ(pairs(false), 0U);
  view.limits->hi.z = 0;
  EXPECT_EQ(pairs(false), 1U);
  view.limits->hi.z = 300;
  EXPECT_EQ(pairs(false), 2U);
  view.limits = {};
  view.sections = {{{1, 0, 0}, {99999, 0, 0}}};
  EXPECT_EQ(pairs(false), 5U);
}

// Seen from within, smooth faces have no line but where they cross others; here that is behind the
// eye.
TEST(Culling, SmoothFacesAllRoundTheEyeAreClipped) {
  SceneBuilder scene;
  scene.object({{.parts = {hand_box({-9000, -9000, -9000}, {9000, 9000, 9000})}, .origin = {}}});
  hlr::View view{.direction = {0, 1, 0}};
  view.perspective = {.eye = {0, 0, 0}, .target = {0, -5000, 0}, .near_mm = 1};
  const auto fates = [&](bool clipped) {
    const auto drawing =
        hlr::draw(scene.scene(), {}, view,
                  {.sharp_angle_deg = 120, .smooth = hlr::Smooth::off, .clipped = clipped}, {});
    EXPECT_TRUE(drawing.has_value());
    if (!drawing) return std::vector<hlr::Fate>{};
    EXPECT_TRUE(drawing->account.defects.empty());
    return drawing->account.fates;
  };
  const std::vector<hlr::Fate> alone(1, hlr::Fate::clipped), both(2, hlr::Fate::clipped);
  EXPECT_EQ(fates(true), alone);
  EXPECT_EQ(fates(false), alone);
  scene.object({{.parts = {hand_box({-500, 8000, -500}, {500, 9900, 500})}, .origin = {}}});
  EXPECT_EQ(fates(true), both);
  EXPECT_EQ(fates(false), both);
}

TEST(Culling, LinesWithWhatIsLeftWholeAreNotLookedForOutside) {
  SceneBuilder scene;
  scene.object({{.parts = {hand_box({0, 0, -9000}, {900, 900, 9000})}, .origin = {}}});
  for (int i = 0; i < 9; ++i)
    scene.object(
        {{.parts = {hand_box({-3000, -3000, 0}, {3000, 3000, 300})}, .origin = {0, 0, 1000 * i}}});
  hlr::View view{.direction = {1, -2, 3}};
  view.sections = {{{0, 1, 0}, {0, 450, 0}}};
  view.limits = geometry::Box3l{{-4000, -4000, -9000}, {4000, 4000, 500}};
  hlr::Options options;
  options.uncut = std::vector<bool>(10);
  options.uncut[0] = true;
  const auto lines = [&](bool clipped) {
    options.clipped = clipped;
    const auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
    return drawing ? drawing->counters.feature_edges : 0;
  };
  // Of eight plates outside each has four lines with the post that is whole.
  EXPECT_EQ(lines(true), lines(false) + 8 * 8);
}

TEST(Culling, OneShapeIsTestedAgainstItselfOnce) {
  const HandPart one = hand_box({0, 0, 0}, {9000, 9000, 900});
  const HandPart two = hand_box({1000, 1000, 2000}, {8000, 8000, 2500});
  SceneBuilder scene;
  scene.object({{.parts = {one, two}, .origin = {}}}).instance(0, {1000, 0, 0});
  const std::uint64_t tests = face_tests(scene, hlr::Stage::local);
  EXPECT_GT(tests, 0U);
  for (int i = 2; i < 50; ++i) scene.instance(0, {1000 * i, 0, 0});
  EXPECT_EQ(face_tests(scene, hlr::Stage::local), tests);
}

}  // namespace
}  // namespace strake
