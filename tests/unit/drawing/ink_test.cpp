// SPDX-License-Identifier: Apache-2.0
// What of a drawing gets ink, and how wide. Drawings here are lines on paper seen from above.
#include "strake/drawing/ink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <vector>

#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

Line line(PaperPoint a, PaperPoint b, LineState state, double depth_mm = 0,
          std::uint32_t object = 0) {
  Line l;
  l.object = model::ObjectId{object};
  l.state = state;
  l.a_paper = a;
  l.b_paper = b;
  l.a_mm = {a.x, -a.y, depth_mm};
  l.b_mm = {b.x, -b.y, depth_mm};
  return l;
}

NeutralDrawing paper_from_top(std::vector<Line> lines) {
  NeutralDrawing drawing;
  drawing.view.direction = {0, 0, 1};
  drawing.view.up = {0, 1, 0};
  drawing.lines = std::move(lines);
  return drawing;
}

Ink ink_of(const NeutralDrawing& drawing, const InkOptions& options = {.hidden = true},
           const parallel::Context& context = {}) {
  auto ink = choose_ink(drawing, options, context);
  EXPECT_TRUE(ink);
  return ink ? std::move(*ink) : Ink{};
}

double length_of(const Ink& ink, LineState state) {
  double sum = 0;
  for (const Line& l : ink.lines)
    if (l.state == state) sum += std::hypot(l.b_paper.x - l.a_paper.x, l.b_paper.y - l.a_paper.y);
  return sum;
}

constexpr LineState kVisible = LineState::visible, kHidden = LineState::hidden_by_other;

TEST(Ink, TakesTheStatesThatAreRequested) {
  const NeutralDrawing drawing = paper_from_top(
      {line({0, 0}, {50, 0}, kVisible), line({0, 20}, {50, 20}, kHidden),
       line({0, 40}, {50, 40}, LineState::duplicate), line({0, 60}, {50, 60}, LineState::clipped)});
  EXPECT_EQ(ink_of(drawing, {.hidden = false}).lines.size(), 1U);
  EXPECT_EQ(ink_of(drawing).lines.size(), 2U);
  EXPECT_EQ(ink_of(drawing).left_out, 0U);
}

// The far edge of a thin plate: 0.3 mm below a line half a millimetre wide.
TEST(Ink, HiddenLinesWhoseInkTouchesAVisibleLineAreLeftOut) {
  const NeutralDrawing drawing =
      paper_from_top({line({0, 0}, {50, 0}, kVisible), line({0, 0.3}, {80, 0.3}, kHidden),
                      line({0, 1}, {50, 1}, kHidden)});
  const Ink ink = ink_of(drawing);
  EXPECT_DOUBLE_EQ(ink.pens.edge, 0.5);
  ASSERT_EQ(ink.lines.size(), 3U);
  EXPECT_EQ(ink.lines[1].a_paper, (PaperPoint{50, 0.3}));
  EXPECT_EQ(ink.lines[1].b_paper, (PaperPoint{80, 0.3}));
  EXPECT_EQ(ink.lines[1].a_mm, geometry::Vec3d(50, -0.3, 0));
  EXPECT_EQ(ink.lines[2].a_paper, (PaperPoint{0, 1}));
  EXPECT_EQ(ink.left_out, 1U);
  const Ink all = ink_of(drawing, {.hidden = true, .clean_up = false});
  EXPECT_EQ(all.lines.size(), 3U);
  EXPECT_DOUBLE_EQ(length_of(all, kHidden), 130);
  EXPECT_EQ(all.left_out, 0U);
}

TEST(Ink, LinesThatCrossOrMeetStay) {
  const NeutralDrawing drawing =
      paper_from_top({line({0, 10}, {50, 10}, kVisible), line({25, 0}, {25, 20}, kHidden),
                      line({50, 10}, {60, 30}, kHidden), line({50, 10}, {80, 10}, kHidden),
                      line({0, 10.1}, {0, 30}, kHidden)});
  const Ink ink = ink_of(drawing);
  EXPECT_EQ(ink.lines.size(), 5U);
  EXPECT_EQ(ink.left_out, 0U);
}

TEST(Ink, OfHiddenLinesThatTouchTheNearerStays) {
  const NeutralDrawing drawing =
      paper_from_top({line({0, 0}, {50, 0}, kHidden, 1), line({0, 0.1}, {50, 0.1}, kHidden, 7),
                      line({0, 0.2}, {50, 0.2}, kHidden, 3), line({0, 2}, {50, 2}, kVisible)});
  const Ink ink = ink_of(drawing);
  ASSERT_EQ(ink.lines.size(), 2U);
  EXPECT_DOUBLE_EQ(ink.lines[0].a_mm.z, 7);
  EXPECT_EQ(ink.left_out, 2U);
}

TEST(Ink, VisibleLinesAreNeverLeftOut) {
  std::vector<Line> lines;
  for (int i = 0; i < 100; ++i) lines.push_back(line({0, i * 0.01}, {50, i * 0.01}, kVisible));
  EXPECT_EQ(ink_of(paper_from_top(lines)).lines.size(), 100U);
}

/// A circle of short lines, clockwise or not.
void add_circle(std::vector<Line>& lines, PaperPoint centre, double radius, int sides, double turn,
                LineState state, double depth) {
  const auto at = [&](int i) {
    const double angle = 2 * std::acos(-1.0) * (i + turn) / sides;
    return PaperPoint{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  };
  for (int i = 0; i < sides; ++i) lines.push_back(line(at(i), at(i + 1), state, depth));
}

// The rims of a flange: two hidden circles a tenth of a millimetre apart, in other steps. What is
// left is one circle, or most of one, and no crumbs.
TEST(Ink, CirclesGoOrStayByWholeLines) {
  std::vector<Line> lines;
  add_circle(lines, {50, 50}, 3, 40, 0, kHidden, 5);
  add_circle(lines, {50, 50.1}, 3, 36, 0.4, kHidden, 1);
  lines.push_back(line({0, 0}, {20, 0}, kVisible));
  const std::vector<Line> given = lines;
  const Ink ink = ink_of(paper_from_top(lines));
  std::size_t near = 0, far = 0;
  for (const Line& l : ink.lines) {
    near += l.a_mm.z == 5 ? 1U : 0U;
    far += l.a_mm.z == 1 ? 1U : 0U;
  }
  EXPECT_EQ(near, 40U);
  EXPECT_EQ(far, 0U);
  EXPECT_EQ(ink.left_out, 36U);
  // One circle alone: neighbours of a chain do not eat each other.
  std::vector<Line> alone;
  add_circle(alone, {50, 50}, 0.4, 40, 0, kHidden, 5);
  EXPECT_GE(ink_of(paper_from_top(alone)).lines.size(), 36U);
}

Pens pens_of(const NeutralDrawing& drawing, const parallel::Context& context = {}) {
  const auto pens = choose_pens(drawing, context);
  EXPECT_TRUE(pens);
  return pens ? *pens : Pens{};
}

TEST(Ink, PensFollowTheDensityWhereTheLinesAre) {
  const auto stripes = [](double step) {
    std::vector<Line> lines{line({0, 290}, {400, 290}, kVisible)};  // and much white
    for (double x = 0; x < 40; x += step) lines.push_back(line({x, 0}, {x, 40}, kVisible));
    return ink_of(paper_from_top(lines)).pens.edge;
  };
  EXPECT_DOUBLE_EQ(stripes(5), 0.5);
  EXPECT_DOUBLE_EQ(stripes(1), 0.35);
  EXPECT_DOUBLE_EQ(stripes(0.8), 0.25);
  EXPECT_DOUBLE_EQ(stripes(0.6), 0.18);
  EXPECT_DOUBLE_EQ(stripes(0.2), 0.18);
  EXPECT_DOUBLE_EQ(ink_of(paper_from_top({})).pens.edge, 0.5);
}

// At 100000:1 a view reaches many kilometres beyond its sheet.
TEST(Ink, WhatLiesOffTheSheetIsNotDense) {
  NeutralDrawing drawing = paper_from_top({line({0, 290}, {400, 290}, kVisible)});
  const double edge = pens_of(drawing).edge;
  const double far = 5e8;
  for (int i = 0; i < 200; ++i) {
    const double y = 10 + i * 0.001;
    drawing.lines.push_back(line({421, y}, {far, y}, kVisible));
    drawing.lines.push_back(line({-far, y - 20}, {far, y - 20}, kVisible));
    drawing.lines.push_back(line({-far, -far}, {-1, far}, kVisible));
  }
  EXPECT_DOUBLE_EQ(pens_of(drawing).edge, edge);
  // What runs across it counts there alone.
  for (int i = 0; i < 60; ++i)
    drawing.lines.push_back(line({10 + i * 0.6, -far}, {10 + i * 0.6, far}, kVisible));
  EXPECT_DOUBLE_EQ(pens_of(drawing).edge, 0.18);
}

TEST(Ink, PensAreALineGroupOfTheStandard) {
  const auto pens_on = [](double width_mm, double height_mm, double step) {
    NeutralDrawing drawing = paper_from_top({line({0, 290}, {400, 290}, kVisible)});
    for (double x = 0; x < 40; x += step) drawing.lines.push_back(line({x, 0}, {x, 40}, kVisible));
    drawing.sheet.width_mm = width_mm;
    drawing.sheet.height_mm = height_mm;
    return pens_of(drawing);
  };
  EXPECT_DOUBLE_EQ(pens_on(841, 594, 10).edge, 0.7);  // A1
  EXPECT_DOUBLE_EQ(pens_on(594, 420, 10).edge, 0.5);  // A2
  EXPECT_DOUBLE_EQ(pens_on(420, 297, 10).edge, 0.5);
  for (const double width : {1189.0, 594.0})
    for (const double step : {10.0, 1.0, 0.8, 0.6, 0.1}) {
      const Pens pens = pens_on(width, width * 0.7, step);
      EXPECT_DOUBLE_EQ(pens.outline, pens.edge) << "a pin's sides and its rim";
      // 0.35 to 0.18 and 0.25 to 0.13 are how the standard rounds.
      EXPECT_NEAR(pens.edge / pens.thin, 2, 0.08);
      EXPECT_GT(pens.section, pens.edge);
    }
}

// Lines in pieces are as dense as whole ones, and no block of them is left out.
TEST(Ink, PensAreThoseOfAllLinesForAnyTeam) {
  std::vector<Line> lines{line({0, 290}, {400, 290}, kVisible)};
  constexpr int kPieces = 1000;
  const auto at = [](double x, int i) { return PaperPoint{x, 40.0 * i / kPieces}; };
  for (int stripe = 0; stripe < 50; ++stripe)
    for (int i = 0; i < kPieces; ++i)
      lines.push_back(line(at(stripe * 0.8, i), at(stripe * 0.8, i + 1), kVisible));
  const NeutralDrawing drawing = paper_from_top(lines);
  EXPECT_DOUBLE_EQ(pens_of(drawing).edge, 0.25);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    EXPECT_DOUBLE_EQ(pens_of(drawing, {.team = &team}).edge, 0.25) << threads;
  }
}

TEST(Ink, ChoosingPensCanBeCancelled) {
  const std::stop_source stop;
  stop.request_stop();
  const auto pens =
      choose_pens(paper_from_top({line({0, 0}, {1, 0}, kVisible)}), {.stop = stop.get_token()});
  ASSERT_FALSE(pens);
  EXPECT_EQ(pens.error().code, ErrorCode::cancelled);
}

TEST(Ink, IsTheSameForAnyTeam) {
  std::vector<Line> lines;
  for (int i = 0; i < 400; ++i)
    add_circle(lines, {20 + i * 0.5, 50 + (i % 7) * 0.03}, 3 + (i % 5) * 0.05, 24, i * 0.1,
               i % 3 == 0 ? kVisible : kHidden, i % 11);
  const NeutralDrawing drawing = paper_from_top(lines);
  const Ink expected = ink_of(drawing);
  EXPECT_GT(expected.left_out, 100U);
  for (const unsigned threads : {2U, 3U, 8U}) {
    parallel::Team team(threads);
    const Ink got = ink_of(drawing, {.hidden = true}, {.team = &team});
    ASSERT_EQ(got.lines.size(), expected.lines.size());
    for (std::size_t i = 0; i < got.lines.size(); ++i) {
      ASSERT_EQ(got.lines[i].a_paper, expected.lines[i].a_paper);
      ASSERT_EQ(got.lines[i].b_paper, expected.lines[i].b_paper);
    }
    EXPECT_EQ(got.left_out, expected.left_out);
  }
}

}  // namespace
}  // namespace strake::drawing
