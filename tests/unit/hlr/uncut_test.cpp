// SPDX-License-Identifier: Apache-2.0
// Objects that sections leave whole: which they are, and that they are drawn as solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::State;

constexpr std::int32_t kMm = 1000;
constexpr std::uint32_t kBlock = 0, kBolt = 1;

test::HandBody box(const Vec3i& lo, const Vec3i& hi) {
  return {.parts = {test::hand_box(lo * kMm, hi * kMm)}, .origin = {}};
}

/// A block of 100 mm and a bolt that stands in it, 20 mm out of it below and above.
test::SceneBuilder block_and_bolt(const Vec3i& lo = {40, 40, -20},
                                  const Vec3i& hi = {60, 60, 120}) {
  test::SceneBuilder scene;
  scene.object({box({0, 0, 0}, {100, 100, 100})});
  scene.object({box(lo, hi)});
  return scene;
}

hlr::View view_along_x(std::int64_t at_mm = 50) {
  return {.direction = {1, 0, 0}, .limits = {}, .sections = {{{1, 0, 0}, {at_mm * kMm, 0, 0}}}};
}

hlr::Drawing draw(const test::SceneBuilder& scene, const hlr::View& view,
                  const std::vector<bool>& uncut, hlr::Options options = {}) {
  options.uncut = uncut;
  auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  EXPECT_TRUE(drawing.has_value());
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

std::uint64_t left_whole(const test::SceneBuilder& scene, const hlr::View& view,
                         const std::vector<bool>& uncut) {
  return draw(scene, view, uncut).counters.uncut_objects;
}

double length_mm(const hlr::Drawing& drawing, const std::function<bool(const EdgePiece&)>& is) {
  double sum = 0;
  for (const EdgePiece& p : drawing.pieces) {
    const auto v = (p.b - p.a).as<double>();
    sum += is(p) ? std::sqrt(dot(v, v)) / kMm : 0;
  }
  return sum;
}

bool is_of(const EdgePiece& p, std::uint32_t object) { return model::index(p.object) == object; }

TEST(Uncut, IsDrawnWholeInFrontOfTheCut) {
  const test::SceneBuilder scene = block_and_bolt();
  const hlr::Drawing drawing = draw(scene, view_along_x(), {false, true});
  EXPECT_EQ(drawing.counters.uncut_objects, 1U);
  for (const EdgePiece& p : drawing.pieces) {
    if (!is_of(p, kBolt)) continue;
    EXPECT_NE(p.kind, EdgeKind::section);
    EXPECT_NE(p.kind, EdgeKind::hatch);
    EXPECT_NE(p.state, State::clipped);
  }
  // Its face towards the viewer stands 10 mm out of the plane: nothing of its outline is hidden.
  const double outline = length_mm(drawing, [](const EdgePiece& p) {
    return is_of(p, kBolt) && p.state == State::visible && p.a.x == 60 * kMm && p.b.x == 60 * kMm;
  });
  EXPECT_NEAR(outline, 2 * (140 + 20), 1e-6);
}

TEST(Uncut, HidesTheCutBehindIt) {
  const test::SceneBuilder scene = block_and_bolt();
  const auto visible_hatch_behind = [](const hlr::Drawing& drawing) {
    return length_mm(drawing, [](const EdgePiece& p) {
      const std::int64_t y = (p.a.y + p.b.y) / 2;
      return p.kind == EdgeKind::hatch && is_of(p, kBlock) && p.state == State::visible &&
             y > 40 * kMm && y < 60 * kMm && std::max(p.a.y, p.b.y) <= 60 * kMm + 2 &&
             std::min(p.a.y, p.b.y) >= 40 * kMm - 2;
    });
  };
  const hlr::Options hatched{.hatches = {{45, 5}, {135, 5}}};
  EXPECT_EQ(visible_hatch_behind(draw(scene, view_along_x(), {false, true}, hatched)), 0);
  // Cut, both have a hatch.
  const hlr::Drawing cut = draw(scene, view_along_x(), {}, hatched);
  EXPECT_EQ(cut.counters.uncut_objects, 0U);
  EXPECT_GT(
      length_mm(cut,
                [](const EdgePiece& p) { return p.kind == EdgeKind::hatch && is_of(p, kBolt); }),
      0);
}

TEST(Uncut, IsOnlyWhatSomePlaneCutsAndNoneCutsAway) {
  const std::vector<bool> bolt{false, true};
  // It reaches from 40 to 60 mm along x; the plane itself is cut away.
  const std::vector<std::tuple<std::int64_t, std::uint64_t>> cases{{39, 0}, {40, 0}, {41, 1},
                                                                   {59, 1}, {60, 1}, {61, 0}};
  for (const auto& [at_mm, expected] : cases)
    EXPECT_EQ(left_whole(block_and_bolt(), view_along_x(at_mm), bolt), expected) << at_mm;
  // Beyond the plane it is cut away like everything else.
  const hlr::Drawing away = draw(block_and_bolt(), view_along_x(40), bolt);
  EXPECT_EQ(away.account.fates[kBolt], hlr::Fate::clipped);
}

TEST(Uncut, OfSeveralPlanesNoneMayCutItAway) {
  const std::vector<bool> bolt{false, true};
  const auto with = [](const hlr::Section& second) {
    hlr::View view = view_along_x();
    view.sections.push_back(second);
    return view;
  };
  const hlr::Section through{{0, 0, 1}, {0, 0, 50 * kMm}};
  const hlr::Section below{{0, 0, 1}, {0, 0, -20 * kMm}};
  const hlr::Section above{{0, 0, 1}, {0, 0, 121 * kMm}};
  EXPECT_EQ(left_whole(block_and_bolt(), with(through), bolt), 1U);
  EXPECT_EQ(left_whole(block_and_bolt(), with(above), bolt), 1U);
  EXPECT_EQ(left_whole(block_and_bolt(), with(below), bolt), 0U);
}

TEST(Uncut, ObliquePlanesGoByCornersNotByBoxes) {
  // The plane x + y = 200 mm meets the box of a prism, but not the prism below it.
  test::HandPart prism;
  prism.vertices = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}, {100, 0, 100}, {0, 100, 100}};
  for (Vec3i& v : prism.vertices) v = v * kMm;
  prism.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                     {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  test::SceneBuilder scene;
  scene.object({{.parts = {prism}, .origin = {}}});
  const auto plane = [](std::int64_t at_mm) {
    return hlr::View{
        .direction = {1, 1, 0}, .limits = {}, .sections = {{{1, 1, 0}, {at_mm * kMm, 0, 0}}}};
  };
  EXPECT_EQ(left_whole(scene, plane(150), {true}), 0U);
  EXPECT_EQ(left_whole(scene, plane(100), {true}), 1U);
  EXPECT_EQ(left_whole(scene, plane(99), {true}), 1U);
  EXPECT_EQ(left_whole(scene, plane(0), {true}), 0U);
}

TEST(Uncut, ObjectsAreLeftWithAllTheirBodies) {
  test::SceneBuilder scene;
  scene.object({box({0, 0, 0}, {100, 100, 100})});
  scene.object({box({10, 110, 0}, {40, 140, 100}), box({60, 110, 0}, {90, 140, 100})});
  const hlr::Drawing drawing = draw(scene, view_along_x(), {false, true});
  EXPECT_EQ(drawing.counters.uncut_objects, 1U);
  for (const EdgePiece& p : drawing.pieces)
    if (is_of(p, 1)) {
      EXPECT_NE(p.state, State::clipped);
    }
}

TEST(Uncut, LimitsCutItAsEver) {
  hlr::View view = view_along_x();
  view.limits = geometry::Box3l{{0, 0, 0}, Vec3l{100, 100, 50} * kMm};
  const hlr::Drawing drawing = draw(block_and_bolt(), view, {false, true});
  EXPECT_EQ(drawing.counters.uncut_objects, 1U);
  const double upright = length_mm(drawing, [](const EdgePiece& p) {
    return is_of(p, kBolt) && p.state == State::visible && p.a.x == 60 * kMm && p.a.z != p.b.z;
  });
  EXPECT_NEAR(upright, 2 * 50, 1e-6);
}

TEST(Uncut, HasALineWhereItStandsOutOfACutWithoutAHole) {
  hlr::View view = view_along_x();
  view.direction = {4, -2, 1};
  const hlr::Drawing drawing =
      draw(block_and_bolt({45, 40, -20}, {60, 60, 120}), view, {false, true});
  const double on_the_cut = length_mm(drawing, [](const EdgePiece& p) {
    return p.kind == EdgeKind::intersection && p.a.x == 50 * kMm && p.b.x == 50 * kMm;
  });
  EXPECT_NEAR(on_the_cut, 2 * 100, 1e-3);
  // Beyond the plane there is no block to meet.
  for (const EdgePiece& p : drawing.pieces)
    if (p.kind == EdgeKind::intersection) {
      EXPECT_LE(std::max(p.a.x, p.b.x), 50 * kMm + 1);
    }
  EXPECT_EQ(length_mm(draw(block_and_bolt(), view, {false, true},
                           {.intersections = hlr::Intersections::off}),
                      [](const EdgePiece& p) { return p.kind == EdgeKind::intersection; }),
            0);
}

TEST(Uncut, ASelectionOfTheWrongSizeIsRefused) {
  const auto drawing =
      hlr::draw(block_and_bolt().scene(), {}, view_along_x(), {.uncut = {true}}, {});
  ASSERT_FALSE(drawing.has_value());
  EXPECT_EQ(drawing.error().code, ErrorCode::usage);
}

using Observation = std::tuple<std::uint32_t, std::uint32_t, EdgeKind, State, Vec3l, Vec3l>;

std::vector<Observation> visible_lines(const hlr::Drawing& drawing) {
  std::vector<Observation> lines;
  for (const EdgePiece& p : drawing.pieces)
    if (p.state != State::clipped)
      lines.emplace_back(model::index(p.object), model::index(p.other), p.kind, p.state, p.a, p.b);
  std::ranges::sort(lines);
  return lines;
}

TEST(Uncut, WhereAllIsLeftWholeTheRestIsCutAwayAndNothingElseChanges) {
  const test::LatticeOptions lattice{.objects = 6, .unit = 1000, .steps = 3};
  for (std::uint64_t seed = 1; seed <= test::rounds<std::uint64_t>(40); ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice);
    test::Random random(seed * 31);
    hlr::View view{
        .direction = test::direction_of(static_cast<std::uint32_t>(seed) % test::kDirections),
        .limits = {},
        .sections = {test::random_section(random, lattice)}};
    const std::size_t objects = scene.scene().model->objects.size();
    const hlr::Drawing whole = draw(scene, view, std::vector<bool>(objects, true));
    std::vector<bool> left(objects);
    for (std::size_t o = 0; o < objects; ++o)
      for (const model::GridBody& body :
           scene.scene().bodies_of(model::ObjectId{static_cast<std::uint32_t>(o)}))
        for (const geometry::Part& part : scene.scene().shapes[body.grid_shape].parts)
          for (const Vec3i& v : part.vertices)
            left[o] = left[o] || dot(view.sections[0].normal, v.as<std::int64_t>() + body.origin -
                                                                  view.sections[0].point) < 0;
    if (std::ranges::find(left, true) == left.end()) continue;
    view.sections.clear();
    const auto expected = hlr::draw(scene.scene(), left, view, {}, {});
    ASSERT_TRUE(expected.has_value());
    EXPECT_EQ(visible_lines(whole), visible_lines(*expected)) << "seed " << seed;
  }
}

TEST(Uncut, IsTheSameByAllSolversAndThreads) {
  const test::LatticeOptions lattice{.objects = 8, .unit = 1000, .steps = 4};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice);
    test::Random random(seed * 31);
    const hlr::View view{
        .direction = {1, -2, 3},
        .limits = {},
        .sections = {test::random_section(random, lattice), test::random_section(random, lattice)}};
    std::vector<bool> uncut(scene.scene().model->objects.size());
    for (std::size_t o = 0; o < uncut.size(); o += 2) uncut[o] = true;
    const hlr::Drawing expected = draw(scene, view, uncut, {.solver = hlr::Solver::brute_force});
    for (const hlr::Solver solver : {hlr::Solver::gather, hlr::Solver::push})
      for (const unsigned threads : {1U, 3U}) {
        parallel::Team team(threads);
        const auto got =
            hlr::draw(scene.scene(), {}, view, {.solver = solver, .uncut = uncut}, {.team = &team});
        ASSERT_TRUE(got.has_value());
        EXPECT_EQ(test::difference(expected.pieces, got->pieces), "") << "seed " << seed;
      }
  }
}

}  // namespace
}  // namespace strake
