// SPDX-License-Identifier: Apache-2.0
// Pipes as single lines: which primitives they are, and how they are drawn from the front at 1:10.
#include "strake/model/single_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "strake/drawing/centre_lines.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

using geometry::Mat3d;
using geometry::Vec3d;
using hlr::EdgeKind;

const Mat3d kStraight{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
const Mat3d kPipeAlongX{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}};  // local z lies along x

class PipeModel {
 public:
  PipeModel() { model_.files.push_back({"t.rvm", "RVM", "mm", "z", 1, 0}); }

  /// Adds a body of the last object, or of a new one.
  PipeModel& add(const geometry::Primitive& primitive, const Mat3d& turn, const Vec3d& at,
                 bool own_object = true) {
    if (own_object) {
      model::Object object;
      object.id = object.name = "o" + std::to_string(model_.objects.size());
      object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
      model_.objects.push_back(object);
    }
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model_.shapes.size())};
    body.placement = {turn, at};
    model_.shapes.emplace_back(primitive);
    model_.bodies.push_back(body);
    ++model_.objects.back().body_count;
    return *this;
  }

  [[nodiscard]] model::SingleLines single(double diameter_mm,
                                          const parallel::Context& context = {}) const {
    const auto scene = model::make_scene(model_, {}, {}).value();
    auto lines = model::pipes_as_lines(scene, {diameter_mm}, context);
    EXPECT_TRUE(lines);
    return std::move(lines).value();
  }

  [[nodiscard]] NeutralDrawing drawn(double diameter_mm) const {
    const model::SingleLines lines = single(diameter_mm);
    const auto drawing = hlr::draw(lines.scene, {}, {{0, -1, 0}}, {}, {});
    EXPECT_TRUE(drawing);
    auto laid_out = lay_out(*drawing, model_, {.scale = 10}, {});
    EXPECT_TRUE(laid_out);
    return std::move(laid_out).value();
  }

  [[nodiscard]] const model::Model& model() const { return model_; }

 private:
  model::Model model_;
};

/// Lengths on paper by kind, of lines in a state.
std::map<EdgeKind, double> lengths(const NeutralDrawing& drawing,
                                   LineState state = LineState::visible) {
  std::map<EdgeKind, double> sums;
  for (const Line& l : drawing.lines)
    if (l.state == state)
      sums[l.kind] += std::hypot(l.b_paper.x - l.a_paper.x, l.b_paper.y - l.a_paper.y);
  return sums;
}

constexpr geometry::CylinderPrimitive kThinPipe{30, 1000}, kThickPipe{150, 1000};

/// A pipe along x from 0 to 1 m, a bend up, and a pipe up from there.
PipeModel run_with_bend() {
  PipeModel pipes;
  pipes.add(kThinPipe, kPipeAlongX, {500, 0, 0})
      .add(geometry::CircularTorusPrimitive{100, 30, std::numbers::pi / 2},
           Mat3d{{{{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}}}}, {1000, 0, 100})
      .add(kThinPipe, kStraight, {1100, 0, 600});
  return pipes;
}

TEST(SingleLines, ARunIsItsAxis) {
  const NeutralDrawing drawing = run_with_bend().drawn(60);
  const auto sums = lengths(drawing);
  ASSERT_EQ(sums.size(), 1U);
  EXPECT_NEAR(sums.at(EdgeKind::single_line), 100 + 100 + 10 * std::numbers::pi / 2, 0.02);
  EXPECT_EQ(drawing.account.of(hlr::Fate::drawn), 3U);
}

TEST(SingleLines, ThickerPipesKeepTheirOutlines) {
  EXPECT_EQ(run_with_bend().single(59).bodies, 0U);
  EXPECT_EQ(lengths(run_with_bend().drawn(59)).count(EdgeKind::single_line), 0U);
  EXPECT_EQ(run_with_bend().single(60).bodies, 3U);
}

TEST(SingleLines, FlangesStayAndShortPiecesBetweenPipesDoNot) {
  PipeModel pipes;
  pipes.add(kThinPipe, kPipeAlongX, {500, 0, 0})
      .add(geometry::CylinderPrimitive{30, 20}, kPipeAlongX, {1010, 0, 0})  // between two pipes
      .add(kThinPipe, kPipeAlongX, {1520, 0, 0})
      .add(geometry::CylinderPrimitive{60, 20}, kPipeAlongX, {2030, 0, 0})   // a flange
      .add(geometry::CylinderPrimitive{30, 20}, kPipeAlongX, {2050, 0, 0});  // beyond it
  EXPECT_EQ(pipes.single(200).bodies, 3U);
}

TEST(SingleLines, ReducersBetweenPipesAreLinesAndOtherConesNot) {
  PipeModel pipes;
  const geometry::SnoutPrimitive reducer{.bottom_radius = 30, .top_radius = 20, .height = 50};
  pipes.add(kThinPipe, kPipeAlongX, {500, 0, 0})
      .add(reducer, kPipeAlongX, {1025, 0, 0})
      .add(geometry::CylinderPrimitive{20, 1000}, kPipeAlongX, {1550, 0, 0})
      .add(reducer, kStraight, {0, 0, 3000});
  EXPECT_EQ(pipes.single(60).bodies, 3U);
}

// A pipe behind a thick one is hidden where that stands before it, and its own body hides nothing.
TEST(SingleLines, OthersHideThemAndTheyHideNone) {
  PipeModel pipes;
  pipes.add(kThinPipe, kPipeAlongX, {500, 0, 0}).add(kThickPipe, kStraight, {500, -500, 0});
  const auto visible = lengths(pipes.drawn(60));
  EXPECT_NEAR(visible.at(EdgeKind::single_line), 70, 0.05);
  EXPECT_NEAR(lengths(pipes.drawn(60), LineState::hidden_by_other).at(EdgeKind::single_line), 30,
              0.05);
  PipeModel before;
  before.add(kThinPipe, kPipeAlongX, {500, -900, 0}).add(kThickPipe, kStraight, {500, 0, 0});
  EXPECT_EQ(lengths(before.drawn(60), LineState::hidden_by_other).size(), 0U);
}

// Another body of its own object hides it: a line ends at its valve.
TEST(SingleLines, TheyEndAtBodiesOfTheirObject) {
  PipeModel pipes;
  pipes.add(kThinPipe, kPipeAlongX, {500, 0, 0})
      .add(geometry::BoxPrimitive{200, 200, 200}, kStraight, {500, 0, 0}, false);
  const NeutralDrawing drawing = pipes.drawn(60);
  EXPECT_NEAR(lengths(drawing).at(EdgeKind::single_line), 80, 0.05);
  EXPECT_NEAR(lengths(drawing, LineState::hidden_by_self).at(EdgeKind::single_line), 20, 0.05);
}

TEST(SingleLines, TheyAreWideAndHaveNoCentreLine) {
  const PipeModel pipes = run_with_bend();
  const NeutralDrawing drawing = pipes.drawn(60);
  const auto ink = choose_ink(drawing, {}, {});
  ASSERT_TRUE(ink);
  const auto axes = find_centre_lines(drawing, *ink, pipes.model(), {}, {});
  ASSERT_TRUE(axes);
  EXPECT_TRUE(axes->empty());
}

TEST(SingleLines, TheTeamDecidesNothing) {
  PipeModel pipes;
  for (int i = 0; i < 300; ++i)
    pipes.add(geometry::CylinderPrimitive{10.0 + i % 40, 500}, kPipeAlongX, {0, 0, i * 200.0});
  const model::SingleLines alone = pipes.single(60);
  parallel::Team team(4);
  const model::SingleLines some = pipes.single(60, {.team = &team});
  EXPECT_EQ(some.bodies, alone.bodies);
  ASSERT_EQ(some.scene.bodies.size(), alone.scene.bodies.size());
  for (std::size_t b = 0; b < alone.scene.bodies.size(); ++b) {
    EXPECT_EQ(some.scene.bodies[b].grid_shape, alone.scene.bodies[b].grid_shape);
    EXPECT_EQ(some.scene.bodies[b].origin, alone.scene.bodies[b].origin);
  }
}

TEST(SingleLines, WordsAndSizes) {
  EXPECT_FALSE(model::parse_single_line("off")->has_value());
  EXPECT_EQ((*model::parse_single_line("60mm"))->largest_diameter_mm, 60);
  EXPECT_NEAR((*model::parse_single_line("DN50"))->largest_diameter_mm, 60.3 * 1.01, 1e-9);
  for (const char* const wrong : {"", "on", "DN", "DN51", "DN50mm", "60", "0mm", "-1mm", "dn50"})
    EXPECT_FALSE(model::parse_single_line(wrong)) << wrong;
}

}  // namespace
}  // namespace strake::drawing
