// SPDX-License-Identifier: Apache-2.0
// Polylines and the faces of their own object: seen through them, or hidden by them if requested.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/ray_check.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"
#include "support/tube_mesh.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using hlr::OwnPolylines;
using hlr::State;
using Chain = std::vector<Vec3i>;
using States = std::vector<State>;

constexpr std::int32_t kSide = 100'000;  // of the boxes, grid units
constexpr std::int32_t kMiddle = kSide / 2;
constexpr std::int32_t kContact = 3;  // of what says nothing of its precision
const hlr::Options kHidden{.own_polylines = OwnPolylines::hidden};

hlr::View iso() { return {.direction = {1, -1, 1}, .limits = {}}; }

hlr::View from_an_eye() {
  hlr::View view = iso();
  const Vec3l target{kMiddle, kMiddle, kMiddle};
  view.perspective = hlr::Perspective{target + Vec3l{1, -1, 1} * (8 * kSide), target};
  return view;
}

test::HandPart box_of(const Vec3i& at) {
  return test::hand_box(at, at + Vec3i{kSide, kSide, kSide});
}

test::HandPart wires(const std::vector<Chain>& chains) {
  test::HandPart part;
  part.chains = chains;
  return part;
}

/// A line along x through the middle half of the box at the origin.
Chain at_height(std::int32_t z) { return {{kSide / 4, kMiddle, z}, {3 * kSide / 4, kMiddle, z}}; }

std::vector<hlr::EdgePiece> polyline_pieces(const test::SceneBuilder& scene, const hlr::View& view,
                                            const hlr::Options& options) {
  const auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  EXPECT_TRUE(drawing.has_value());
  std::vector<hlr::EdgePiece> pieces;
  if (drawing)
    for (const hlr::EdgePiece& p : drawing->pieces)
      if (p.kind == hlr::EdgeKind::polyline) pieces.push_back(p);
  return pieces;
}

/// The states along one polyline that belongs to the same object as a part.
States states(const test::HandPart& part, const Chain& chain, const hlr::Options& options,
              const hlr::View& view = iso()) {
  test::SceneBuilder scene;
  scene.object({{.parts = {part, wires({chain})}, .origin = {}}});
  States found;
  for (const hlr::EdgePiece& p : polyline_pieces(scene, view, options)) found.push_back(p.state);
  return found;
}

TEST(OwnPolylines, ByDefaultAreSeenThroughTheirObject) {
  for (const std::int32_t z : {-kSide, 0, kMiddle, kSide})
    EXPECT_EQ(states(box_of({}), at_height(z), {}), States{State::visible}) << z;
}

TEST(OwnPolylines, ByDefaultAreSeenWhereHiddenLinesAreLeftOut) {
  // The occlusion buffer holds the faces of their object as well. The body has no other edges.
  const hlr::View from_above{.direction = {0, 0, 1}, .limits = {}};
  for (const hlr::View& view : {from_above, iso()})
    for (const std::int32_t z : {kSide / 4, kMiddle, kSide - 100}) {
      test::SceneBuilder scene;
      scene.object({{.parts = {box_of({})}, .origin = {}},
                    {.parts = {wires({at_height(z)})}, .origin = {}}});
      const auto pieces = polyline_pieces(scene, view, {.hidden = false});
      ASSERT_EQ(pieces.size(), 1U) << z;
      EXPECT_EQ(pieces[0].state, State::visible) << z;
      EXPECT_TRUE(
          polyline_pieces(scene, view, {.own_polylines = OwnPolylines::hidden, .hidden = false})
              .empty())
          << z;
    }
}

TEST(OwnPolylines, AreHiddenInsideBehindAndOnTheBackIfRequested) {
  for (const hlr::View& view : {iso(), from_an_eye()})
    for (const std::int32_t z : {-kSide / 4, 0, kMiddle})
      EXPECT_EQ(states(box_of({}), at_height(z), kHidden, view), States{State::hidden_by_self})
          << z;
}

TEST(OwnPolylines, OnAFaceTowardsTheViewerAreVisible) {
  for (const hlr::View& view : {iso(), from_an_eye()})
    for (const std::int32_t z : {kSide - kContact, kSide, kSide + 1, kSide + kMiddle})
      EXPECT_EQ(states(box_of({}), at_height(z), kHidden, view), States{State::visible}) << z;
  EXPECT_EQ(states(box_of({}), at_height(kSide - kContact - 1), kHidden),
            States{State::hidden_by_self});
}

TEST(OwnPolylines, TiesDoNotHideWithoutAContactDistance) {
  const hlr::Options exact{.contact_distance_mm = 0, .own_polylines = OwnPolylines::hidden};
  EXPECT_EQ(states(box_of({}), at_height(kSide), exact), States{State::visible});
  EXPECT_EQ(states(box_of({}), at_height(kSide - 1), exact), States{State::hidden_by_self});
}

TEST(OwnPolylines, OnASheetAreVisibleFromBothSides) {
  test::HandPart sheet;
  sheet.vertices = {{0, 0, 0}, {kSide, 0, 0}, {kSide, kSide, 0}, {0, kSide, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Vec3l& direction : {Vec3l{1, -1, 1}, {1, -1, -1}})
    EXPECT_EQ(states(sheet, at_height(0), kHidden, {.direction = direction, .limits = {}}),
              States{State::visible});
  EXPECT_EQ(states(sheet, at_height(-kContact - 1), kHidden), States{State::hidden_by_self});
}

TEST(OwnPolylines, ThatLeaveTheirSolidAreHiddenAsFarAsTheFace) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box_of({}),
                           wires({{{kMiddle, kMiddle, kMiddle}, {kMiddle, kMiddle, 2 * kSide}}})},
                 .origin = {}}});
  const auto pieces = polyline_pieces(scene, iso(), kHidden);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].state, State::hidden_by_self);
  EXPECT_EQ(pieces[0].b, (Vec3l{kMiddle, kMiddle, kSide - kContact}));
  EXPECT_EQ(pieces[1].state, State::visible);
}

TEST(OwnPolylines, OfAnotherBodyOfTheObjectAreItsOwn) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box_of({})}, .origin = {}},
                {.parts = {wires({at_height(kMiddle)})}, .origin = {}}});
  scene.instance(0, {4 * kSide, 0, 0});
  for (const hlr::Stage stage : {hlr::Stage::none, hlr::Stage::local, hlr::Stage::global}) {
    hlr::Options options = kHidden;
    options.stage = stage;
    const State expected = stage == hlr::Stage::none ? State::visible : State::hidden_by_self;
    for (const hlr::EdgePiece& p : polyline_pieces(scene, iso(), options))
      EXPECT_EQ(p.state, expected) << static_cast<int>(stage);
  }
}

TEST(OwnPolylines, AreHiddenByOthersInAnyCase) {
  test::SceneBuilder scene;
  scene.object({{.parts = {wires({at_height(kMiddle)})}, .origin = {}}});
  scene.object({{.parts = {box_of({})}, .origin = {}}});
  for (const hlr::Options& options : {hlr::Options{}, kHidden}) {
    const auto pieces = polyline_pieces(scene, iso(), options);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].state, State::hidden_by_other);
  }
}

TEST(OwnPolylines, OnTheFaceOfACutAreVisible) {
  const auto cut_at = [](std::int64_t z) {
    hlr::View view = iso();
    view.sections = {{.normal = {0, 0, 1}, .point = {0, 0, z}}};
    return view;
  };
  const Chain chain = at_height(kMiddle);
  EXPECT_EQ(states(box_of({}), chain, kHidden, cut_at(kMiddle + kContact)), States{State::visible});
  EXPECT_EQ(states(box_of({}), chain, kHidden, cut_at(kMiddle + kSide / 4)),
            States{State::hidden_by_self});
  EXPECT_EQ(states(box_of({}), chain, kHidden, cut_at(kMiddle / 2)), States{State::clipped});
}

TEST(OwnPolylines, InATransparentSolidAreVisible) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box_of({})}, .origin = {}, .alpha = 100},
                {.parts = {wires({at_height(kMiddle)})}, .origin = {}}});
  const auto pieces = polyline_pieces(scene, iso(), kHidden);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].state, State::visible);
}

/// Objects that stand in each other's way, each a tube of many faces or a box with lines in it,
/// through it and round it; the last of them stands twice.
test::SceneBuilder crowd(std::uint64_t seed, std::uint32_t objects) {
  test::Random random(seed);
  const auto anywhere = [&](std::int32_t from, std::int32_t to) {
    const auto along = [&] {
      return from + static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(to - from)));
    };
    return Vec3i{along(), along(), along()};
  };
  const auto tube_at = [](const Vec3i& at) {
    const auto corner = [&](double x, double y, double z) {
      const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
      return at + Vec3i{whole(x) + kMiddle, whole(y) + kMiddle, whole(z)};
    };
    return test::tube<test::HandPart>(12, 0.5 * kSide, 0.3 * kSide, 0, kSide, corner);
  };
  test::SceneBuilder scene;
  for (std::uint32_t i = 0; i < objects; ++i) {
    const Vec3i at = anywhere(0, 2 * kSide);
    std::vector<Chain> chains{
        {at + Vec3i{kMiddle, kMiddle, -kMiddle}, at + Vec3i{kMiddle, kMiddle, kSide + kMiddle}}};
    const auto near = [&] { return at + anywhere(-kMiddle, kSide + kMiddle); };
    for (int k = 0; k < 4; ++k) chains.push_back({near(), near(), near()});
    const test::HandPart solid = random.one_in(2) ? tube_at(at) : box_of(at);
    scene.object({{.parts = {solid, wires(chains)}, .origin = {}}});
  }
  scene.instance(objects - 1, {kSide, 2 * kSide, kMiddle});
  return scene;
}

std::vector<hlr::View> all_views() {
  hlr::View cut = iso();
  cut.sections = {{.normal = {1, 2, 3}, .point = {2 * kSide, kSide, 2 * kSide}}};
  return {iso(), {.direction = {0, 0, 1}, .limits = {}}, from_an_eye(), cut};
}

/// Compares each way to draw with the definition, on one to three threads by turns.
void expect_same_lines(const test::SceneBuilder& scene, const hlr::View& view,
                       hlr::Options options) {
  options.solver = hlr::Solver::brute_force;
  const auto expected = hlr::draw(scene.scene(), {}, view, options, {});
  ASSERT_TRUE(expected.has_value());
  unsigned threads = 1;
  for (const hlr::Solver solver : {hlr::Solver::gather, hlr::Solver::push})
    for (const std::int32_t buckets :
         {hlr::Options::kBucketsByData, hlr::Options::kNoBuckets, 1, 7})
      for (const bool culling : {true, false}) {
        options.solver = solver;
        options.culling = culling;
        options.bucketing = buckets;
        parallel::Team team(threads);
        const auto got = hlr::draw(scene.scene(), {}, view, options, {.team = &team});
        ASSERT_TRUE(got.has_value());
        ASSERT_EQ(test::difference(expected->pieces, got->pieces), "")
            << "solver " << static_cast<int>(solver) << ", culling " << culling << ", buckets "
            << buckets << ", threads " << threads;
        threads = threads % 3 + 1;
      }
}

TEST(OwnPolylines, AreTheSameByAllSolversStagesBucketsAndThreads) {
  constexpr std::uint64_t kSeed = 17;
  const test::SceneBuilder scene = crowd(kSeed, 4);
  for (const hlr::View& view : all_views())
    for (const OwnPolylines own : {OwnPolylines::visible, OwnPolylines::hidden}) {
      for (const hlr::Stage stage : {hlr::Stage::none, hlr::Stage::local, hlr::Stage::global})
        expect_same_lines(scene, view, {.stage = stage, .own_polylines = own});
      expect_same_lines(scene, view, {.own_polylines = own, .hidden = false});
    }
}

TEST(OwnPolylines, RaysAgree) {
  for (const std::uint64_t seed : {3U, 4U}) {
    const test::SceneBuilder scene = crowd(seed, 12);
    hlr::Options options = kHidden;
    options.keep_specks = true;
    auto drawing = hlr::draw(scene.scene(), {}, iso(), options, {});
    ASSERT_TRUE(drawing.has_value());
    const auto rays = test::rounds<std::uint64_t>(2000);
    const test::RayCheck check = test::check_by_rays(scene.scene(), *drawing, rays, seed);
    EXPECT_EQ(check.wrong, 0U) << check.first_wrong;
    EXPECT_EQ(check.rays, rays);
    // The rays do tell one rule from the other.
    drawing->options.own_polylines = OwnPolylines::visible;
    EXPECT_GT(test::check_by_rays(scene.scene(), *drawing, rays, seed).wrong, 0U);
  }
}

}  // namespace
}  // namespace strake
