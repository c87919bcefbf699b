// SPDX-License-Identifier: Apache-2.0
// Small drawings whose every line is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stop_token>

#include "strake/geometry/primitive.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using hlr::EdgeKind;
using hlr::State;

const hlr::View kIso{.direction = {1, -1, 1}, .limits = {}};

std::map<State, int> states(const hlr::Drawing& drawing) {
  std::map<State, int> count;
  for (const hlr::EdgePiece& p : drawing.pieces) ++count[p.state];
  return count;
}

hlr::Drawing drawn(const test::SceneBuilder& scene, const hlr::View& view,
                   const hlr::Options& options = {}) {
  auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  EXPECT_TRUE(drawing.has_value());
  return drawing ? *drawing : hlr::Drawing{};
}

test::HandPart box(std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t size = 1000) {
  return test::hand_box({x, y, z}, {x + size, y + size, z + size});
}

// A prism round the z axis whose mantle quads are faces, as a tessellated cylinder has them.
test::HandPart cylinder(std::uint32_t sides, double radius, std::int32_t height) {
  test::HandPart part;
  for (const std::int32_t z : {0, height})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double turn = 2 * std::acos(-1.0) * (i + 0.3) / sides;
      part.vertices.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(turn))),
                               static_cast<std::int32_t>(std::lround(radius * std::sin(turn))), z});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    part.triangles.push_back({i, j, j + sides});
    part.triangles.push_back({i, j + sides, i + sides});
    part.faces.insert(part.faces.end(), {i + 2, i + 2});
    if (i == 0 || j == 0) continue;
    part.triangles.push_back({0, j, i});
    part.triangles.push_back({sides, i + sides, j + sides});
    part.faces.insert(part.faces.end(), {0, 1});
  }
  return part;
}

TEST(Draw, CubeShowsNineEdgesAndHidesThree) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  const hlr::Drawing drawing = drawn(scene, kIso);
  EXPECT_EQ(drawing.counters.feature_edges, 12U);
  const std::map<State, int> expected{{State::visible, 9}, {State::hidden_by_self, 3}};
  EXPECT_EQ(states(drawing), expected);
}

TEST(Draw, CubeFromAboveShowsItsOutlineOnce) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  const hlr::Drawing drawing = drawn(scene, {.direction = {0, 0, 1}, .limits = {}});
  // The lower four edges lie under the rim of the upper face: behind on one side only.
  const std::map<State, int> expected{{State::visible, 8}, {State::projecting, 4}};
  EXPECT_EQ(states(drawing), expected);
}

TEST(Draw, TouchingCubesHideWhatLiesBetweenThem) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(0, 0, 1000)}, .origin = {}}});
  const hlr::Drawing drawing = drawn(scene, kIso, {.contact_distance_mm = 0});
  for (const hlr::EdgePiece& p : drawing.pieces) {
    if (p.a.z != 1000 || p.b.z != 1000) continue;
    // The shared rectangle's two edges at the back are hidden, the two in front are seen.
    const bool back = (p.a.x == 0 && p.b.x == 0) || (p.a.y == 1000 && p.b.y == 1000);
    EXPECT_EQ(p.state == State::visible, !back);
  }
}

TEST(Draw, CylinderHasTwoContoursHoweverSnappingBentItsQuads) {
  for (const double radius : {40.0, 57.3, 1000.0, 25000.0}) {
    test::SceneBuilder scene;
    scene.object({{.parts = {cylinder(24, radius, 5000)}, .origin = {}}});
    for (const geometry::Vec3l direction :
         {geometry::Vec3l{1, -1, 1}, {1, 0, 0}, {7, 3, -2}, {1000, 131, 17}}) {
      int contours = 0;
      for (const hlr::EdgePiece& p : drawn(scene, {.direction = direction, .limits = {}}).pieces)
        if (p.kind == EdgeKind::contour) ++contours;
      EXPECT_EQ(contours, 2) << radius << " " << direction.y;
    }
  }
}

TEST(Draw, ThinPipeShowsNoFacets) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cylinder(8, 5000, 60000)}, .origin = {}}});
  EXPECT_EQ(drawn(scene, kIso).counters.feature_edges, 24U);  // an octagonal bar, all edges
  scene.primitive(0, geometry::CylinderPrimitive{5, 60});
  EXPECT_EQ(drawn(scene, kIso).counters.feature_edges, 18U);  // two rims and two contours
}

TEST(Draw, SmoothEdgesAreDrawnOnDemand) {
  test::SceneBuilder scene;
  const std::uint32_t sides = 24;
  scene.object({{.parts = {cylinder(sides, 5000, 60000)}, .origin = {}}});
  const auto smooth = [&](double sharp_deg) {
    int count = 0;
    for (const hlr::EdgePiece& p :
         drawn(scene, kIso, {.sharp_angle_deg = sharp_deg, .smooth = hlr::Smooth::all}).pieces)
      if (p.kind == EdgeKind::smooth) ++count;
    return count;
  };
  // Of a mesh every edge of the mantle but for the contours, and none within the flat ends.
  EXPECT_EQ(drawn(scene, kIso).counters.feature_edges, 2 * sides + 2U);
  EXPECT_EQ(drawn(scene, kIso, {.smooth = hlr::Smooth::all}).counters.feature_edges, 3 * sides);
  EXPECT_GE(smooth(20), 22);
  EXPECT_EQ(smooth(0), 0);
  // Of a cylinder none.
  scene.primitive(0, geometry::CylinderPrimitive{5, 60});
  EXPECT_EQ(smooth(20), 0);
}

// What rounding bends is flat.
TEST(Draw, TrianglesInOnePlaneHaveNoSmoothEdge) {
  const auto quad = [](std::int32_t lift) {
    return test::HandPart{{{0, 0, 0}, {90000, 0, 7}, {90000, 50000, 11 + lift}, {0, 50000, 4}},
                          {{0, 1, 2}, {0, 2, 3}},
                          {},
                          {}};
  };
  const auto edges = [&](std::int32_t lift) {
    test::SceneBuilder one;
    one.object({{.parts = {quad(lift)}, .origin = {}}});
    return drawn(one, kIso, {.smooth = hlr::Smooth::all}).counters.feature_edges;
  };
  EXPECT_EQ(edges(0), 4U);
  EXPECT_EQ(edges(2), 4U);
  EXPECT_EQ(edges(200), 5U);
}

TEST(Draw, GlassIsHiddenButHidesNothing) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(-500, -500, 3000, 2000)}, .origin = {}, .alpha = 90}});
  const hlr::View top{.direction = {0, 0, 1}, .limits = {}};
  EXPECT_EQ(states(drawn(scene, top))[State::hidden_by_other], 0);
  scene.object({{.parts = {box(-1000, -1000, 9000, 4000)}, .origin = {}}});
  EXPECT_EQ(states(drawn(scene, top))[State::hidden_by_other], 16);
}

TEST(Draw, LimitsCutLinesAndWhatHides) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(-500, -500, 3000, 2000)}, .origin = {}}});
  hlr::View top{.direction = {0, 0, 1}, .limits = {}};
  EXPECT_EQ(states(drawn(scene, top))[State::hidden_by_other], 8);
  top.limits = {{-9000, -9000, -9000}, {9000, 9000, 2000}};
  const hlr::Drawing cut = drawn(scene, top);
  EXPECT_EQ(states(cut)[State::hidden_by_other], 0);
  EXPECT_EQ(states(cut)[State::clipped], 12);
  EXPECT_EQ(cut.account.of(hlr::Fate::clipped), 1U);
}

TEST(Draw, EqualCubesOneBehindTheOtherShareAnOutline) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(5000, -5000, 5000)}, .origin = {}}});
  // What lies on the outline of a thing is hidden by it on one side only.
  EXPECT_EQ(states(drawn(scene, kIso))[State::visible], 9 + 6);
}

TEST(Draw, StagesHideNothingOwnOrAll) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(1500, -2500, 1500, 2000)}, .origin = {}}});
  EXPECT_EQ(states(drawn(scene, kIso, {.stage = hlr::Stage::none}))[State::visible], 24);
  auto local = states(drawn(scene, kIso, {.stage = hlr::Stage::local}));
  EXPECT_EQ(local[State::hidden_by_self], 6);
  EXPECT_EQ(local[State::hidden_by_other], 0);
  const hlr::Drawing full = drawn(scene, kIso);
  EXPECT_GT(states(full)[State::hidden_by_other], 0);
  EXPECT_EQ(full.account.of(hlr::Fate::hidden), 1U);
}

TEST(Draw, RefusesWhatMakesNoSense) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  const auto refused = [&](const hlr::View& view, const hlr::Options& options) {
    const auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
    return !drawing && drawing.error().code == ErrorCode::usage && !drawing.error().mend.empty();
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused({.direction = {0, 0, 0}, .limits = {}}, {}));
  EXPECT_TRUE(refused({.direction = {1048577, 0, 0}, .limits = {}}, {}));
  EXPECT_TRUE(refused(kIso, {.sharp_angle_deg = kNan}));
  EXPECT_TRUE(refused(kIso, {.sharp_angle_deg = 181}));
  EXPECT_TRUE(refused(kIso, {.contact_distance_mm = kNan}));
  EXPECT_TRUE(refused({.direction = {0, 0, 1}, .limits = {{{1, 0, 0}, {0, 0, 0}}}}, {}));
}

TEST(Draw, StopsOnRequest) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  const std::stop_source stop;
  stop.request_stop();
  for (const hlr::Solver solver : {hlr::Solver::gather, hlr::Solver::brute_force}) {
    const auto drawing = hlr::draw(scene.scene(), {}, kIso, {.solver = solver},
                                   {.team = nullptr, .stop = stop.get_token()});
    ASSERT_FALSE(drawing.has_value());
    EXPECT_EQ(drawing.error().code, ErrorCode::cancelled);
  }
}

TEST(Draw, TheWorkOfTheBruteForceIsKnownBefore) {
  test::SceneBuilder scene;
  scene.object({{.parts = {box(0, 0, 0)}, .origin = {}}});
  scene.object({{.parts = {box(5000, 0, 0)}, .origin = {}}});
  for (const hlr::Stage stage : {hlr::Stage::none, hlr::Stage::local, hlr::Stage::global}) {
    const hlr::Options options{.stage = stage, .solver = hlr::Solver::brute_force};
    const auto work = hlr::brute_force_work(scene.scene(), {}, kIso, options, {});
    ASSERT_TRUE(work.has_value());
    const hlr::Drawing drawing = drawn(scene, kIso, options);
    EXPECT_EQ(work->edges, drawing.counters.feature_edges);
    EXPECT_EQ(work->triangles, 24U);
    EXPECT_EQ(work->tests, drawing.counters.face_tests);
  }
  const auto one = hlr::brute_force_work(scene.scene(), {true, false}, kIso, {}, {});
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(one->edges, 12U);
  EXPECT_EQ(one->triangles, 12U);
  EXPECT_FALSE(hlr::brute_force_work(scene.scene(), {true}, kIso, {}, {}).has_value());
}

}  // namespace
}  // namespace strake
