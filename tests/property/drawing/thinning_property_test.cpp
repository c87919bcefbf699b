// SPDX-License-Identifier: Apache-2.0
// Random sheaves of lines thinned: what stays is part of what was, nothing vanishes, what is left
// of inner lines stands a spacing apart, and what was left out had a line on either side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "strake/drawing/ink.hpp"
#include "strake/drawing/thinning.hpp"
#include "strake/parallel/team.hpp"
#include "support/draw.hpp"
#include "support/rounds.hpp"

namespace strake::drawing {
namespace {

constexpr double kSpacing = 0.5;

/// Sheaves of parallel lines, each turned its own way, some lines cut short; objects 0 to 3.
std::vector<Line> random_sheaves(test::Draw& draw) {
  std::vector<Line> lines;
  for (std::uint32_t o = 0; o < 4; ++o) {
    const double turn = draw.between(0, 6.28), c = std::cos(turn), s = std::sin(turn);
    const double x = draw.between(20, 250), y = draw.between(20, 250), length = draw.between(3, 60);
    double across = 0;
    for (int i = draw.whole(1, 80); i > 0; --i) {
      across += draw.between(0.01, draw.one_in(5) ? 2.0 : 0.3);
      const double from = draw.one_in(3) ? draw.between(0, length / 2) : 0;
      const double to = draw.one_in(3) ? draw.between(length / 2, length) : length;
      const auto at = [&](double along) {
        return PaperPoint{std::round((x + c * along - s * across) * 1000) / 1000,
                          std::round((y + s * along + c * across) * 1000) / 1000};
      };
      Line l;
      l.object = l.other = model::ObjectId{o};
      l.edge = static_cast<std::uint32_t>(i);
      l.a_paper = at(from);
      l.b_paper = at(to);
      if (l.a_paper == l.b_paper) continue;
      l.a_mm = {l.a_paper.x, -l.a_paper.y, 0};
      l.b_mm = {l.b_paper.x, -l.b_paper.y, 0};
      lines.push_back(l);
    }
  }
  return lines;
}

Ink ink_of(const NeutralDrawing& drawing, const parallel::Context& context) {
  auto ink = choose_ink(drawing, {}, {});
  EXPECT_TRUE(ink);
  EXPECT_TRUE(thin_lines(*ink, drawing, {.spacing_mm = kSpacing}, context));
  return std::move(ink).value();
}

struct Reach {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  void include(const PaperPoint& p) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
};

std::map<model::ObjectId, Reach> reaches(const std::vector<Line>& lines) {
  std::map<model::ObjectId, Reach> all;
  for (const Line& l : lines) {
    all[l.object].include(l.a_paper);
    all[l.object].include(l.b_paper);
  }
  return all;
}

/// The distance of a point from a line, which has a length.
double distance_from(const PaperPoint& p, const Line& l) {
  const double dx = l.b_paper.x - l.a_paper.x, dy = l.b_paper.y - l.a_paper.y;
  const double t = std::clamp(
      ((p.x - l.a_paper.x) * dx + (p.y - l.a_paper.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - l.a_paper.x - dx * t, p.y - l.a_paper.y - dy * t);
}

/// Points along a line, its ends left out.
std::vector<PaperPoint> points_along(const Line& l) {
  std::vector<PaperPoint> points;
  for (int k = 1; k < 20; ++k)
    points.push_back({l.a_paper.x + (l.b_paper.x - l.a_paper.x) * k / 20,
                      l.a_paper.y + (l.b_paper.y - l.a_paper.y) * k / 20});
  return points;
}

TEST(Thinning, RandomSheaves) {
  test::Draw draw(4711);
  parallel::Team team(3);
  std::uint64_t left_out = 0;
  for (int round = 0; round < test::rounds(60); ++round) {
    NeutralDrawing drawing;
    drawing.view.direction = {0, 0, 1};
    drawing.view.up = {0, 1, 0};
    drawing.lines = random_sheaves(draw);
    const Ink ink = ink_of(drawing, {});
    left_out += ink.thinned->lines;
    // What stays lies on what was, of the same object.
    for (const Line& l : ink.lines)
      for (const PaperPoint& p : {l.a_paper, l.b_paper})
        EXPECT_TRUE(std::ranges::any_of(drawing.lines, [&](const Line& was) {
          return was.object == l.object && was.edge == l.edge && distance_from(p, was) < 0.002;
        }));
    // No object vanishes or becomes smaller than by a spacing.
    const auto before = reaches(drawing.lines), after = reaches(ink.lines);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [object, was] : before) {
      const Reach& is = after.at(object);
      EXPECT_LE(is.left - was.left, 2 * kSpacing);
      EXPECT_LE(was.right - is.right, 2 * kSpacing);
      EXPECT_LE(is.top - was.top, 2 * kSpacing);
      EXPECT_LE(was.bottom - is.bottom, 2 * kSpacing);
    }
    // No paper that had ink is far from what has.
    for (const Line& was : drawing.lines)
      for (const PaperPoint& p : points_along(was))
        EXPECT_TRUE(std::ranges::any_of(ink.lines, [&](const Line& l) {
          return l.object == was.object && distance_from(p, l) <= 2.5 * kSpacing;
        }));
    const Ink together = ink_of(drawing, {.team = &team});
    ASSERT_EQ(together.lines.size(), ink.lines.size());
    for (std::size_t i = 0; i < ink.lines.size(); ++i) {
      EXPECT_EQ(together.lines[i].a_paper, ink.lines[i].a_paper);
      EXPECT_EQ(together.lines[i].b_paper, ink.lines[i].b_paper);
    }
  }
  EXPECT_GT(left_out, 1000U);
}

/// A dense wall costs about its number of lines, not its square.
TEST(Thinning, ADenseWallKeepsOneLineForEachSpacing) {
  NeutralDrawing drawing;
  drawing.view.direction = {0, 0, 1};
  drawing.view.up = {0, 1, 0};
  constexpr int kLines = 20000;
  for (int i = 0; i < kLines; ++i) {
    Line l;
    l.edge = static_cast<std::uint32_t>(i);
    l.a_paper = {i * 0.005, 0};
    l.b_paper = {i * 0.005, 50};
    l.a_mm = {l.a_paper.x, 0, 0};
    l.b_mm = {l.b_paper.x, -50, 0};
    drawing.lines.push_back(l);
  }
  const Ink ink = ink_of(drawing, {});
  const double kept = kLines * 0.005 / kSpacing;
  EXPECT_NEAR(static_cast<double>(ink.lines.size()), kept, 0.03 * kept);
}

}  // namespace
}  // namespace strake::drawing
