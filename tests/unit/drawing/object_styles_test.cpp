// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/object_styles.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "drawing/strokes/layer_pens.hpp"

namespace strake::drawing {
namespace {

Line line_of(std::uint32_t object, std::uint32_t other, hlr::EdgeKind kind) {
  Line line;
  line.object = model::ObjectId{object};
  line.other = model::ObjectId{other};
  line.kind = kind;
  return line;
}

TEST(ObjectStyles, TheFirstThatPicksAnObjectHoldsForIt) {
  ObjectStyles styles(3);
  styles.add({.name = "first", .color = {}, .pen_mm = {}, .line = {}}, {true, false, false});
  styles.add({.name = "second", .color = {}, .pen_mm = {}, .line = {}}, {true, true, false});
  EXPECT_EQ(styles.number_of(line_of(0, 0, hlr::EdgeKind::sharp)), 1U);
  EXPECT_EQ(styles.number_of(line_of(1, 1, hlr::EdgeKind::sharp)), 2U);
  EXPECT_EQ(styles.number_of(line_of(2, 2, hlr::EdgeKind::sharp)), ObjectStyles::kPlain);
  // An intersection of one without a style has that of the other; no other line has.
  EXPECT_EQ(styles.number_of(line_of(2, 1, hlr::EdgeKind::intersection)), 2U);
  EXPECT_EQ(styles.number_of(line_of(0, 1, hlr::EdgeKind::intersection)), 1U);
  EXPECT_EQ(styles.number_of(line_of(2, 1, hlr::EdgeKind::sharp)), ObjectStyles::kPlain);
}

TEST(ObjectStyles, PensKeepTheirRatioAndHiddenLinesStayDashed) {
  ObjectStyles styles(1);
  styles.add({.name = {},
              .color = model::Color{200, 0, 0, 255},
              .pen_mm = 0.7,
              .line = LineType{{24, 3}, true}},
             {});
  const Pens pens{.outline = 0.35, .edge = 0.35, .thin = 0.18, .section = 0.5};
  const auto pen = [&](bool hidden, hlr::EdgeKind kind) {
    const Layer layer{hidden, kind, {}};
    return styled_pen(usual_pen(layer, pens), layer, styles, 1, pens.edge);
  };
  EXPECT_EQ(pen(false, hlr::EdgeKind::sharp).width_mm, 0.7);
  EXPECT_EQ(pen(false, hlr::EdgeKind::section).width_mm, 1.0);
  EXPECT_EQ(pen(false, hlr::EdgeKind::sharp).dash_mm, (std::vector<double>{16.8, 2.1}));
  EXPECT_TRUE(pen(false, hlr::EdgeKind::hatch).dash_mm.empty());
  const LinePen hidden = pen(true, hlr::EdgeKind::sharp);
  EXPECT_EQ(hidden.width_mm, 0.36);
  EXPECT_EQ(hidden.color, (model::Color{200, 0, 0, 255}));
  // 12 and 3 widths of the pen that it has now.
  EXPECT_EQ(hidden.dash_mm, (std::vector<double>{4.32, 1.08}));
}

TEST(ObjectStyles, SingleLinesAndBreakLinesHaveThePenOfTheirObject) {
  ObjectStyles styles(2);
  styles.add({.name = {},
              .color = model::Color{200, 0, 0, 255},
              .pen_mm = 0.7,
              .line = LineType{{24, 3}, true}},
             {false, true});
  const Pens pens{.outline = 0.35, .edge = 0.35, .thin = 0.18, .section = 0.5};
  const Layer single{false, hlr::EdgeKind::single_line, {}};
  const LinePen line = styled_pen(usual_pen(single, pens), single, styles, 1, pens.edge);
  EXPECT_EQ(line.width_mm, 0.7);
  EXPECT_EQ(line.dash_mm, (std::vector<double>{16.8, 2.1}));
  // Zigzags in dashes are none.
  const LinePen broken = styled_break_pen({pens.thin, {}, {0, 0, 0, 255}}, styles, 1, pens.edge);
  EXPECT_EQ(broken.width_mm, 0.36);
  EXPECT_TRUE(broken.dash_mm.empty());
  EXPECT_EQ(broken.color, (model::Color{200, 0, 0, 255}));
  Ink ink;
  ink.break_lines = {{model::ObjectId{1}, {{0, 0}, {1, 0}}},
                     {model::ObjectId{0}, {{0, 1}, {1, 1}}}};
  EXPECT_EQ(break_lines_by_style(ink).size(), 1U);
  ink.styles = std::make_shared<const ObjectStyles>(styles);
  const std::vector<BreakLinesOfStyle> parts = break_lines_by_style(ink);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].style, ObjectStyles::kPlain);
  EXPECT_EQ(parts[0].lines.front(), &ink.break_lines[1]);
  EXPECT_EQ(parts[1].style, 1U);
}

TEST(ObjectStyles, TextsAreReadOrRefused) {
  EXPECT_EQ(parse_color("#c0FF09").value(), (model::Color{0xC0, 0xFF, 0x09, 255}));
  for (const char* const text : {"red", "#12345", "#1234567", "#12345g", ""})
    EXPECT_FALSE(parse_color(text)) << text;
  EXPECT_TRUE(parse_line_type("continuous").value().dashes.empty());
  EXPECT_EQ(parse_line_type("dash-dot").value().dashes.size(), 4U);
  const LineType own = parse_line_type("3mm  1mm").value();
  EXPECT_EQ(own.dashes, (std::vector<double>{3, 1}));
  EXPECT_FALSE(own.in_widths);
  for (const char* const text : {"", "3mm", "3 1", "3mm 0", "wavy", "1mm 1mm 1mm", "9m 1mm"})
    EXPECT_FALSE(parse_line_type(text)) << text;
  EXPECT_EQ(parse_pen_mm("0.35mm").value(), 0.35);
  for (const char* const text : {"", "0.35", "0", "-1mm", "3cm"}) EXPECT_FALSE(parse_pen_mm(text));
}

TEST(ObjectStyles, AStyleIsReadWithWhoseLinesItIsFor) {
  const StyleText all =
      parse_style(" name=PIPES , color=#c00000,pen=0.35mm,line=dashed : @d = 'a:b,c=d' ").value();
  EXPECT_EQ(all.style.name, "PIPES");
  EXPECT_EQ(all.style.color->red, 0xC0);
  EXPECT_EQ(all.style.pen_mm, 0.35);
  EXPECT_TRUE(all.style.line->in_widths);
  EXPECT_EQ(all.selection, "@d = 'a:b,c=d'");
  const StyleText one = parse_style("line=3mm 1mm: *").value();
  EXPECT_TRUE(one.style.name.empty());
  EXPECT_FALSE(one.style.color);
  EXPECT_EQ(one.style.line->dashes.size(), 2U);
  for (const char* const text : {"", "color=#c00000", "color: *", "color=red: *", "width=1mm: *",
                                 "name=a,name=b: *", "pen=1mm,pen=2mm: *", ": *"})
    EXPECT_FALSE(parse_style(text)) << text;
}

}  // namespace
}  // namespace strake::drawing
