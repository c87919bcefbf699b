// SPDX-License-Identifier: Apache-2.0
// Dense lines thinned. Drawings here are lines on paper at 1:1, seen from above, in pens of 0.25
// mm.
#include "strake/drawing/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "strake/drawing/write.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

constexpr LineState kDrawn = LineState::visible;

Line thin_test_line(PaperPoint a, PaperPoint b, std::uint32_t object = 0,
                    hlr::EdgeKind kind = hlr::EdgeKind::sharp) {
  Line l;
  l.object = l.other = model::ObjectId{object};
  l.kind = kind;
  l.state = kDrawn;
  l.a_paper = a;
  l.b_paper = b;
  l.a_mm = {a.x, -a.y, 0};
  l.b_mm = {b.x, -b.y, 0};
  return l;
}

/// Upright lines of 50 mm from x = 0 on.
std::vector<Line> wall(int count, double step, std::uint32_t object = 0) {
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i)
    lines.push_back(thin_test_line({i * step, 0}, {i * step, 50}, object));
  return lines;
}

Ink thinned(std::vector<Line> lines, const ThinOptions& options = {.spacing_mm = 0.5},
            const parallel::Context& context = {},
            std::shared_ptr<const ObjectStyles> styles = nullptr) {
  NeutralDrawing drawing;
  drawing.view.direction = {0, 0, 1};
  drawing.view.up = {0, 1, 0};
  drawing.lines = std::move(lines);
  const Pens pens{.outline = 0.25, .edge = 0.25, .thin = 0.13, .section = 0.35};
  auto ink = choose_ink(drawing, {.pens = pens, .styles = std::move(styles)}, {});
  EXPECT_TRUE(ink);
  EXPECT_TRUE(thin_lines(*ink, drawing, options, context));
  return std::move(ink).value();
}

std::vector<double> places(const Ink& ink) {
  std::vector<double> xs;
  for (const Line& l : ink.lines) xs.push_back(l.a_paper.x);
  std::ranges::sort(xs);
  return xs;
}

TEST(Thinning, AWallKeepsItsEndsAndLinesASpacingApart) {
  const Ink ink = thinned(wall(101, 0.1));
  const std::vector<double> xs = places(ink);
  EXPECT_EQ(xs.front(), 0);
  EXPECT_EQ(xs.back(), 10);
  EXPECT_EQ(xs.size(), 21U);
  for (std::size_t i = 1; i < xs.size(); ++i) EXPECT_NEAR(xs[i] - xs[i - 1], 0.5, 1e-9);
  ASSERT_TRUE(ink.thinned);
  EXPECT_EQ(ink.thinned->lines, 80U);
  EXPECT_EQ(ink.thinned->objects, 1U);
  EXPECT_EQ(ink.thinned->spacing_mm, 0.5);
}

TEST(Thinning, OnIsTwoWidePens) {
  const Ink ink = thinned(wall(101, 0.1), {});
  EXPECT_EQ(ink.thinned->spacing_mm, 0.5);
  EXPECT_EQ(places(ink).size(), 21U);
}

// Two pens of an object are those of its style; a spacing that is given holds for all.
TEST(Thinning, OnIsTwoPensOfTheStyle) {
  ObjectStyles styles(2);
  styles.add({.name = {}, .color = {}, .pen_mm = 0.5, .line = {}}, {false, true});
  const auto shared = std::make_shared<const ObjectStyles>(std::move(styles));
  std::vector<Line> lines = wall(101, 0.1);
  std::ranges::copy(wall(101, 0.1, 1), std::back_inserter(lines));
  const auto left = [&](const ThinOptions& options, std::uint32_t object) {
    const Ink ink = thinned(lines, options, {}, shared);
    return std::ranges::count(ink.lines, model::ObjectId{object}, &Line::object);
  };
  EXPECT_EQ(left({}, 0), 21);
  EXPECT_EQ(left({}, 1), 11);
  EXPECT_EQ(left({.spacing_mm = 0.5}, 1), 21);
}

TEST(Thinning, LinesFarEnoughApartStay) {
  const Ink ink = thinned(wall(21, 0.5));
  EXPECT_EQ(ink.lines.size(), 21U);
  EXPECT_EQ(ink.thinned->lines, 0U);
  EXPECT_TRUE(ink.true_size_lines.empty());
}

// Both edges of a thin plate are its outline.
TEST(Thinning, TwoLinesAreAnOutline) { EXPECT_EQ(thinned(wall(2, 0.1)).lines.size(), 2U); }

TEST(Thinning, ObjectsDoNotThinEachOther) {
  std::vector<Line> lines;
  for (std::uint32_t o = 0; o < 40; ++o)
    for (Line& l : wall(2, 0.05, o)) {
      for (PaperPoint* const p : {&l.a_paper, &l.b_paper}) p->x += 0.1 * o;
      for (geometry::Vec3d* const p : {&l.a_mm, &l.b_mm}) p->x += 0.1 * o;
      lines.push_back(l);
    }
  EXPECT_EQ(thinned(lines).lines.size(), 80U);
}

// A short line within a wall: beside it the wall's own lines are inner ones, above it are none.
TEST(Thinning, LinesAreCutWhereTheyAreDense) {
  const std::vector<Line> lines{thin_test_line({0, 0}, {0, 50}),
                                thin_test_line({0.2, 0}, {0.2, 50}),
                                thin_test_line({0.4, 30}, {0.4, 50})};
  const Ink ink = thinned(lines);
  ASSERT_EQ(ink.lines.size(), 3U);
  EXPECT_EQ(ink.lines[1].a_paper, (PaperPoint{0.2, 0}));
  EXPECT_EQ(ink.lines[1].b_paper, (PaperPoint{0.2, 30}));
  EXPECT_EQ(ink.lines[1].b_mm, geometry::Vec3d(0.2, -30, 0));
  EXPECT_EQ(ink.thinned->lines, 1U);
}

TEST(Thinning, CutsAndHatchesStay) {
  std::vector<Line> lines;
  for (int i = 0; i < 20; ++i)
    lines.push_back(thin_test_line({i * 0.1, 0}, {i * 0.1, 50}, 0,
                                   i % 2 == 0 ? hlr::EdgeKind::section : hlr::EdgeKind::hatch));
  EXPECT_EQ(thinned(lines).lines.size(), 20U);
}

TEST(Thinning, LinesThatCrossStay) {
  std::vector<Line> lines = wall(21, 1);
  for (int i = 0; i < 21; ++i) lines.push_back(thin_test_line({0, i * 1.0}, {20, i * 1.0}));
  EXPECT_EQ(thinned(lines).lines.size(), 42U);
}

// True size thins none, unless asked.
TEST(Thinning, ModelSpaceOfDxfKeepsItsLines) {
  Ink ink = thinned(wall(101, 0.1));
  EXPECT_EQ(ink.in_model_space().size(), 101U);
  ink = thinned(wall(101, 0.1), {.spacing_mm = 0.5, .in_model_space = true});
  EXPECT_EQ(ink.in_model_space().size(), 21U);
}

TEST(Thinning, TheTeamDecidesNothing) {
  std::vector<Line> lines;
  for (std::uint32_t o = 0; o < 60; ++o)
    for (const Line& l : wall(40 + static_cast<int>(o), 0.03 + 0.01 * o, o)) lines.push_back(l);
  const Ink alone = thinned(lines);
  for (const unsigned threads : {2U, 5U}) {
    parallel::Team team(threads);
    const Ink some = thinned(lines, {.spacing_mm = 0.5}, {.team = &team});
    ASSERT_EQ(some.lines.size(), alone.lines.size());
    for (std::size_t i = 0; i < alone.lines.size(); ++i) {
      EXPECT_EQ(some.lines[i].a_paper, alone.lines[i].a_paper);
      EXPECT_EQ(some.lines[i].b_paper, alone.lines[i].b_paper);
    }
  }
}

TEST(Thinning, Words) {
  EXPECT_FALSE(parse_thinning("off")->has_value());
  EXPECT_EQ((*parse_thinning("on"))->spacing_mm, 0);
  EXPECT_FALSE((*parse_thinning("on"))->in_model_space);
  EXPECT_EQ((*parse_thinning("0.4mm"))->spacing_mm, 0.4);
  EXPECT_TRUE((*parse_thinning("0.4mm+dxf"))->in_model_space);
  EXPECT_TRUE((*parse_thinning("on+dxf"))->in_model_space);
  for (const char* const wrong : {"", "yes", "0mm", "4", "-1mm", "2m", "off+dxf", "+dxf", "on+svg"})
    EXPECT_FALSE(parse_thinning(wrong)) << wrong;
}

}  // namespace
}  // namespace strake::drawing
