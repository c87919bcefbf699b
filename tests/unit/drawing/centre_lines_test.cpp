// SPDX-License-Identifier: Apache-2.0
// Centre lines of models made of primitives, drawn from the front at 1:10: x to the right, z up.
#include "strake/drawing/centre_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drawing/centre/axes.hpp"
#include "geometry/numeric/trig.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

using geometry::Mat3d;
using geometry::Vec3d;

const Mat3d kUpright{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
const Mat3d kAlongX{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}};         // local z lies along x
const Mat3d kTowardsViewer{{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}};  // local z lies along -y

class Parts {
 public:
  Parts() { model_.files.push_back({"t.rvm", "RVM", "mm", "z", 1, 0}); }

  Parts& add(const geometry::Primitive& primitive, const Mat3d& turn, const Vec3d& at,
             bool own_object = true) {
    if (own_object) {
      model::Object o;
      o.id = o.name = "o" + std::to_string(model_.objects.size());
      o.first_body = static_cast<std::uint32_t>(model_.bodies.size());
      model_.objects.push_back(o);
    }
    model::Body b;
    b.shape = model::ShapeId{static_cast<std::uint32_t>(model_.shapes.size())};
    b.placement = {turn, at};
    model_.shapes.emplace_back(primitive);
    model_.bodies.push_back(b);
    ++model_.objects.back().body_count;
    return *this;
  }

  [[nodiscard]] std::vector<CentreLine> lines(bool hidden = false,
                                              const hlr::View& view = {{0, -1, 0}},
                                              const CentreLineOptions& options = {},
                                              const parallel::Context& context = {}) const {
    const auto scene = model::make_scene(model_, {}, {}).value();
    const auto drawn = hlr::draw(scene, {}, view, {}, {});
    EXPECT_TRUE(drawn);
    auto laid_out = lay_out(*drawn, model_, {.scale = 10}, {});
    EXPECT_TRUE(laid_out);
    const auto ink = choose_ink(*laid_out, {.hidden = hidden}, {});
    EXPECT_TRUE(ink);
    auto found = find_centre_lines(*laid_out, *ink, model_, options, context);
    EXPECT_TRUE(found);
    return std::move(found).value();
  }

 private:
  model::Model model_;
};

double length_of(const CentreLine& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    length += std::hypot(line.points[i].x - line.points[i - 1].x,
                         line.points[i].y - line.points[i - 1].y);
  return length;
}

/// A pipe of 200 mm, 20 mm on paper, so that its centre line goes on for 3 mm.
constexpr geometry::CylinderPrimitive kPipe{100, 1000};

TEST(CentreLines, APipeFromTheSideHasItsAxisAndABitMore) {
  const auto lines = Parts().add(kPipe, kAlongX, {0, 0, 0}).lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length_of(lines[0]), 100 + 2 * 3, 0.01);
  EXPECT_NEAR(lines[0].points[0].y, lines[0].points[1].y, 1e-9);
  EXPECT_FALSE(lines[0].cross);
}

TEST(CentreLines, OverhangsAreAQuarterOfTheDiameterWithinLimits) {
  EXPECT_EQ(overhang_mm(2), 1);
  EXPECT_EQ(overhang_mm(6), 1.5);
  EXPECT_EQ(overhang_mm(100), 3);
}

TEST(CentreLines, APipeFromItsEndHasACross) {
  const auto lines = Parts().add(kPipe, kTowardsViewer, {0, 0, 0}).lines();
  ASSERT_EQ(lines.size(), 2U);
  for (const CentreLine& line : lines) {
    EXPECT_TRUE(line.cross);
    EXPECT_NEAR(length_of(line), 20 + 2 * 3, 0.01);
  }
  // The arms cross in their middles.
  const auto middle = [](const CentreLine& l) {
    return PaperPoint{(l.points[0].x + l.points[1].x) / 2, (l.points[0].y + l.points[1].y) / 2};
  };
  EXPECT_NEAR(middle(lines[0]).x, middle(lines[1]).x, 1e-3);
  EXPECT_NEAR(middle(lines[0]).y, middle(lines[1]).y, 1e-3);
}

TEST(CentreLines, RoundPartsAboutOneAxisHaveOneLine) {
  Parts parts;
  parts.add(kPipe, kAlongX, {0, 0, 0})
      .add(geometry::CylinderPrimitive{170, 40}, kAlongX, {520, 0, 0})
      .add(geometry::SnoutPrimitive{.bottom_radius = 100, .top_radius = 60, .height = 200}, kAlongX,
           {640, 0, 0})
      .add(geometry::EllipticalDishPrimitive{60, 30}, kAlongX, {740, 0, 0}, false);
  const auto lines = parts.lines();
  ASSERT_EQ(lines.size(), 1U);
  // From the free end of the pipe to that of the dish, 12 mm wide there.
  EXPECT_NEAR(length_of(lines[0]), 3 + 100 + 4 + 20 + 3 + 3, 0.02);
  EXPECT_EQ(lines[0].object, model::ObjectId{0});
}

TEST(CentreLines, WhatIsHiddenHasOneWhereItsLinesHaveInk) {
  Parts parts;
  parts.add(kPipe, kAlongX, {0, 0, 0})
      .add(geometry::BoxPrimitive{600, 100, 600}, kUpright, {0, -400, 0});
  const auto visible = parts.lines();
  ASSERT_EQ(visible.size(), 2U);  // on both sides of the box, 20 mm each, and no way on at it
  for (const CentreLine& line : visible) EXPECT_NEAR(length_of(line), 20 + 3, 0.01);
  const auto all = parts.lines(true);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(length_of(all[0]), 100 + 6, 0.01);
}

TEST(CentreLines, LimitsCutThemWithTheirParts) {
  hlr::View view{{0, -1, 0}};
  view.limits = geometry::Box3l{{-1000000, -1000000, -1000000}, {200000, 1000000, 1000000}};
  const auto lines = Parts().add(kPipe, kAlongX, {0, 0, 0}).lines(false, view);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length_of(lines[0]), 3 + 70, 0.01);
}

TEST(CentreLines, BendsHaveTheirMiddleAndPipesEndAtThem) {
  Parts parts;
  // In the plane of the paper: from below into the bend, and out to the right.
  parts
      .add(geometry::CircularTorusPrimitive{300, 100, geometry::kPi / 2}, kTowardsViewer, {0, 0, 0})
      .add(kPipe, kUpright, {300, 0, -500});
  const auto lines = parts.lines();
  ASSERT_EQ(lines.size(), 2U);
  const auto bend = std::ranges::find_if(lines, [](const auto& l) { return l.points.size() > 2; });
  ASSERT_NE(bend, lines.end());
  EXPECT_NEAR(length_of(*bend), 30 * geometry::kPi / 2, 0.05);
  const auto pipe = std::ranges::find_if(lines, [](const auto& l) { return l.points.size() == 2; });
  ASSERT_NE(pipe, lines.end());
  EXPECT_NEAR(length_of(*pipe), 100 + 3, 0.01);
}

TEST(CentreLines, SmallPartsAndPerspectiveHaveNone) {
  Parts parts;
  parts.add(geometry::CylinderPrimitive{9.9, 500}, kAlongX, {0, 0, 0})
      .add(geometry::CylinderPrimitive{9.9, 500}, kTowardsViewer, {0, 0, 300});
  EXPECT_TRUE(parts.lines().empty());
  EXPECT_EQ(parts.lines(false, {{0, -1, 0}}, {.min_diameter_mm = 1.9}).size(), 3U);
  hlr::View view{{0, -1, 0}};
  view.perspective = hlr::Perspective{{0, -5000000, 0}, {0, 0, 0}};
  EXPECT_TRUE(Parts().add(kPipe, kAlongX, {0, 0, 0}).lines(false, view).empty());
}

TEST(CentreLines, AnObliqueAxisGoesBeyondTheRims) {
  const auto lines = Parts().add(kPipe, kAlongX, {0, 0, 0}).lines(false, {{1, -1, 0}});
  ASSERT_EQ(lines.size(), 1U);
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(length_of(lines[0]), 100 * half + 2 * (10 * half + 3), 0.02);
}

TEST(CentreLines, TheTeamDecidesNothing) {
  Parts parts;
  for (int i = 0; i < 60; ++i)
    parts.add(kPipe, i % 3 == 0 ? kTowardsViewer : kAlongX,
              {i % 7 * 1100.0, i % 4 * 400.0, i * 130.0});
  const auto alone = parts.lines();
  ASSERT_GT(alone.size(), 30U);
  for (const unsigned threads : {2U, 7U}) {
    parallel::Team team(threads);
    const auto together = parts.lines(false, {{0, -1, 0}}, {}, {.team = &team});
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_EQ(together[i].points, alone[i].points) << i;
  }
}

TEST(CentreLines, WordsAndDiameters) {
  EXPECT_FALSE(parse_centre_lines("off")->has_value());
  EXPECT_EQ((*parse_centre_lines("on"))->min_diameter_mm, 2);
  EXPECT_EQ((*parse_centre_lines("4mm"))->min_diameter_mm, 4);
  for (const char* const wrong : {"", "yes", "4", "-4mm", "0mm", "5m"})
    EXPECT_FALSE(parse_centre_lines(wrong)) << wrong;
}

}  // namespace
}  // namespace strake::drawing
