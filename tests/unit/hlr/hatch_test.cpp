// SPDX-License-Identifier: Apache-2.0
// Hatches of cuts: as long as closed forms say, within their outlines, apart from neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::State;

constexpr std::int32_t kMm = 1000;

test::HandPart cube_mm(std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t size) {
  return test::hand_box({x * kMm, y * kMm, z * kMm},
                        {(x + size) * kMm, (y + size) * kMm, (z + size) * kMm});
}

std::vector<EdgePiece> hatch(const test::SceneBuilder& scene, const hlr::View& view,
                             const hlr::Options& options = {}) {
  const auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  EXPECT_TRUE(drawing.has_value());
  std::vector<EdgePiece> pieces;
  if (drawing)
    std::ranges::copy_if(drawing->pieces, std::back_inserter(pieces),
                         [](const EdgePiece& p) { return p.kind == EdgeKind::hatch; });
  return pieces;
}

double length(const std::vector<EdgePiece>& pieces) {
  double sum = 0;
  for (const EdgePiece& p : pieces) {
    const auto v = (p.b - p.a).as<double>();
    sum += std::sqrt(dot(v, v)) / kMm;
  }
  return sum;
}

/// The angle on paper from above, degrees.
double angle(const EdgePiece& p) {
  const auto v = (p.b - p.a).as<double>();
  const double degrees = std::atan2(v.y, v.x) * 180 / std::acos(-1.0);
  return degrees < 0 ? degrees + 180 : degrees;
}

const hlr::View kPlan{.direction = {0, 0, 1},
                      .up = {0, 1, 0},
                      .limits = {},
                      .sections = {{{0, 0, 1}, {0, 0, 500 * kMm}}}};

TEST(Hatch, LinesTimesSpacingAreTheArea) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {}}});
  for (const double spacing : {10.0, 7.0})
    for (const double degrees : {45.0, 30.0, 120.0}) {
      const auto lines =
          hatch(scene, kPlan, {.hatch_spacing_mm = spacing, .hatches = {{.angle_deg = degrees}}});
      EXPECT_NEAR(length(lines) * spacing, 1e6, 2e4) << degrees;
      for (const EdgePiece& p : lines) {
        EXPECT_EQ(p.a.z, 500 * kMm);
        const auto v = (p.b - p.a).as<double>();
        // What is no longer than twice the contact distance, as a line across a corner, is a speck.
        if (dot(v, v) > 36) {
          EXPECT_EQ(p.state, State::visible);
        }
        if (dot(v, v) > 1e8) {
          EXPECT_NEAR(angle(p), degrees, 0.02);
        }
      }
    }
}

TEST(Hatch, ObliquePlanesAreHatchedInTheirOwnPlane) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {777, -555, 333}}});
  const hlr::View view{
      .direction = {1, -1, 1}, .limits = {}, .sections = {{{1, 0, 1}, {1000 * kMm, 0, 0}}}};
  const auto lines = hatch(scene, view, {.hatch_spacing_mm = 10});
  EXPECT_NEAR(length(lines) * 10, 1e6 * std::sqrt(2.0), 3e4);
  for (const EdgePiece& p : lines)
    for (const Vec3l& end : {p.a, p.b}) EXPECT_LE(std::abs(end.x + end.z - 1000 * kMm), 1);
}

TEST(Hatch, NeighboursDifferAndWhatIsNearerHides) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {}}});
  scene.object({{.parts = {cube_mm(1000, 0, 0, 1000)}, .origin = {}}});
  scene.object({{.parts = {cube_mm(5000, 0, 0, 1000)}, .origin = {}}});
  std::set<long> angles[3];
  for (const EdgePiece& p : hatch(scene, kPlan, {.hatch_spacing_mm = 50})) {
    const auto v = (p.b - p.a).as<double>();
    if (dot(v, v) > 1e9) angles[model::index(p.object)].insert(std::lround(angle(p)));
  }
  EXPECT_EQ(angles[0], std::set<long>{45});
  EXPECT_EQ(angles[1], std::set<long>{135});
  EXPECT_EQ(angles[2], std::set<long>{45});
  // Seen obliquely, what stands before a cut hides its hatch.
  hlr::View oblique = kPlan;
  oblique.direction = {0, -1, 1};
  oblique.up = {0, 0, 1};
  oblique.sections = {{{0, -1, 0}, {0, 600 * kMm, 0}}, {{0, 0, 1}, {0, 0, 500 * kMm}}};
  EXPECT_FALSE(hatch(scene, oblique, {.hatch_spacing_mm = 50}).empty());
  test::SceneBuilder hidden;
  hidden.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {}}});
  hidden.object({{.parts = {test::hand_box({-9000 * kMm, -3000 * kMm, -9000 * kMm},
                                           {9000 * kMm, -2000 * kMm, 499 * kMm})},
                  .origin = {}}});
  hlr::View low = kPlan;
  low.direction = {0, -1, 0};
  low.up = {0, 0, 1};
  low.sections = {{{0, -1, 0}, {0, 600 * kMm, 0}}};
  for (const EdgePiece& p : hatch(hidden, low, {.hatch_spacing_mm = 50}))
    EXPECT_EQ(model::index(p.object), 0U);
}

TEST(Hatch, CutsThatLookAwayAndThoseSeenEdgeOnAreNotHatched) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {}}});
  hlr::View view = kPlan;
  view.sections[0].normal = {0, 0, -1};
  EXPECT_TRUE(hatch(scene, view).empty());
  view.sections[0].normal = {1, 0, 0};
  view.sections[0].point = {500 * kMm, 0, 0};
  EXPECT_TRUE(hatch(scene, view).empty());
}

TEST(Hatch, WhatMakesNoSenseIsAnError) {
  test::SceneBuilder scene;
  scene.object({{.parts = {cube_mm(0, 0, 0, 1000)}, .origin = {}}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<hlr::Options> wrong(7);
  wrong[0].hatch_spacing_mm = nan;
  wrong[1].hatch_spacing_mm = 1e-3;
  wrong[2].hatch_spacing_mm = 1e300;
  wrong[3].hatches = {{.angle_deg = nan}};
  wrong[4].hatches = {{.angle_deg = 181}};
  wrong[5].hatches = {{.spacing_mm = 1e-6}};
  wrong[6].hatches.resize(2);
  for (const hlr::Options& options : wrong)
    EXPECT_FALSE(hlr::draw(scene.scene(), {}, kPlan, options, {}).has_value());
  for (const hlr::Section& section :
       {hlr::Section{{0, 0, 0}, {}}, hlr::Section{{1 << 21, 0, 1}, {}},
        hlr::Section{{0, 0, 1}, {0, 0, std::numeric_limits<std::int64_t>::max()}}}) {
    hlr::View view = kPlan;
    view.sections = {section};
    EXPECT_FALSE(hlr::draw(scene.scene(), {}, view, {}, {}).has_value());
  }
}

TEST(Hatch, SheetsThatAreCutAreReported) {
  test::SceneBuilder scene;
  test::HandPart sheet;
  sheet.vertices = {{0, 0, 0}, {1000 * kMm, 0, 0}, {0, 0, 1000 * kMm}};
  sheet.triangles = {{0, 1, 2}};
  scene.object({{.parts = {sheet}, .origin = {}}});
  const auto drawing = hlr::draw(scene.scene(), {}, kPlan, {}, {});
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->diagnostics.count("section-open"), 1U);
  EXPECT_EQ(drawing->diagnostics.kept().front().where, "hand: 0");
}

}  // namespace
}  // namespace strake
