// SPDX-License-Identifier: Apache-2.0
// Templates of sheets in PDF: paths, transforms and styles, and what is reported the rest.
#include "sheets/output/artwork/artwork.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "drawing/pdf/pdf_document.hpp"
#include "sheets/output/artwork/svg_geometry.hpp"
#include "strake/parallel/team.hpp"
#include "support/pdf_reader.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

std::string path_of(std::string_view d, bool whole = true, const Affine& to_paper = {}) {
  PathBuilder path(to_paper);
  EXPECT_EQ(path.add(d), whole) << d;
  return path.operators();
}

TEST(Artwork, PathsAreThoseOfSvg) {
  EXPECT_EQ(path_of("M0 0L10,5 20-5.5z"), "0 0 m\n10 5 l\n20 -5.5 l\nh\n");
  EXPECT_EQ(path_of("m1 2 3 4h5v-6H0V1"), "1 2 m\n4 6 l\n9 6 l\n9 0 l\n0 0 l\n0 1 l\n");
  EXPECT_EQ(path_of("M0 0c0 1 1 2 2 2s2 1 2 2"), "0 0 m\n0 1 1 2 2 2 c\n3 2 4 3 4 4 c\n");
  EXPECT_EQ(path_of("M0 0Q3 3 6 0T12 0"), "0 0 m\n2 2 4 2 6 0 c\n8 -2 10 -2 12 0 c\n");
  EXPECT_EQ(path_of("M0 0 10 0zl5 5"), "0 0 m\n10 0 l\nh\n5 5 l\n") << "on from the beginning";
  EXPECT_EQ(path_of("M1e1.5 2", false), "10 .5 m\n") << "an odd number at the end";
  // What is damaged is drawn as far as it goes.
  EXPECT_EQ(path_of("M0 0L5 5L7", false), "0 0 m\n5 5 l\n");
  EXPECT_EQ(path_of("L5 5", false), "");
  EXPECT_EQ(path_of("M0 0Zz9", false), "0 0 m\nh\nh\n");
  EXPECT_EQ(path_of("M1e400 0", false), "");
  EXPECT_EQ(path_of("M1e300 0"), "1000000000 0 m\n") << "far off the sheet";
}

TEST(Artwork, ArcsEndWhereTheyStateAndBulgeAsFarAsTheirAxes) {
  // Half a circle over the chord from (0, 0) to (10, 0): clockwise on paper is upwards.
  const std::string over = path_of("M0 0A5 5 0 0 1 10 0"), under = path_of("M0 0a5 5 0 0010 0");
  EXPECT_TRUE(over.ends_with("10 0 c\n"));
  EXPECT_NE(over.find("2.5 -4.33 c\n"), std::string::npos) << over;
  EXPECT_NE(under.find("2.5 4.33 c\n"), std::string::npos) << under;
  // An ellipse of 10 x 5 turned by a right angle, a large arc of a small chord.
  const std::string large = path_of("M0 0A10 5 90 1 1 0 1");
  EXPECT_TRUE(large.ends_with("0 1 c\n")) << large;
  EXPECT_EQ(path_of("M0 0A0 5 0 0 1 10 0"), "0 0 m\n10 0 l\n");
  EXPECT_EQ(path_of("M0 0A5 5 0 0 1 0 0"), "0 0 m\n");
  // Too small for its chord, it grows; flags may stand beside the next number.
  EXPECT_EQ(path_of("M0 0A1 1 0 0 1 10 0"), over);
  EXPECT_EQ(path_of("M0 0A5 5 0 0110 0"), over);
  EXPECT_EQ(path_of("M0 0A5 5 0 2 1 10 0", false), "0 0 m\n");
}

TEST(Artwork, TransformsFollowEachOther) {
  const auto at = [](std::string_view text, double x, double y) {
    const auto transform = svg_transform(text);
    EXPECT_TRUE(transform) << text;
    return transform.value_or(Affine{})(x, y);
  };
  EXPECT_EQ(at("translate(10) scale(2,3)", 1, 1), (drawing::PaperPoint{12, 3}));
  EXPECT_EQ(at("scale(2),translate(10,1)", 1, 1), (drawing::PaperPoint{22, 4}));
  EXPECT_EQ(at("matrix(1 2 3 4 5 6)", 1, 10), (drawing::PaperPoint{36, 48}));
  const drawing::PaperPoint turned = at("rotate(90 10 10)", 11, 10);
  EXPECT_NEAR(turned.x, 10, 1e-12);
  EXPECT_NEAR(turned.y, 11, 1e-12);
  EXPECT_NEAR(at("skewX(45)", 0, 2).x, 2, 1e-12);
  for (const char* bad : {"turn(3)", "scale()", "rotate(1 2)", "translate(1", "scale(a)"})
    EXPECT_FALSE(svg_transform(bad)) << bad;
  EXPECT_DOUBLE_EQ(Affine({2, 0, 0, 8, 0, 0}).scale(), 4);
}

/// The operators of a template on a sheet of 100 x 50 mm, and what was reported.
struct Artwork {
  std::string operators;
  Diagnostics reported;

  explicit Artwork(const std::string& elements, const std::string& view_box = "0 0 100 50") {
    const auto nowhere = [](std::string_view) {};
    drawing::PdfDocument document(nowhere, "t", "");
    const Status status =
        append_artwork(operators, document, {view_box, elements}, {100, 50}, reported);
    EXPECT_TRUE(status) << elements;
  }
  [[nodiscard]] bool has(std::string_view text) const {
    return operators.find(text) != std::string::npos;
  }
};

TEST(Artwork, ShapesAreFilledBlackUnlessTheyStateOtherwise) {
  EXPECT_EQ(Artwork("<rect x='1' y='2' width='3' height='4'></rect>").operators,
            "q\n0 0 0 rg\n1 2 m\n4 2 l\n4 6 l\n1 6 l\n1 2 l\nh\nf\nQ\n");
  const Artwork line(
      "<line x1='1' y1='2' x2='3' y2='4' fill='none' stroke='#f00' "
      "stroke-width='0.5' stroke-dasharray='2, 1'></line>");
  EXPECT_EQ(line.operators, "q\n1 0 0 RG\n.5 w 0 J 0 j 4 M [2 1 ] 0 d\n1 2 m\n3 4 l\nS\nQ\n");
  EXPECT_TRUE(Artwork("<circle r='2' fill-rule='evenodd' stroke='blue'></circle>").has("B*\n"));
  EXPECT_EQ(Artwork("<path d='M0 0L1 1' fill='none'></path>").operators, "");
  EXPECT_EQ(Artwork("<g display='none'><rect width='1' height='1'></rect></g>").operators, "");
  EXPECT_TRUE(Artwork("<polygon points='0,0 1,0 1,1'></polygon>").has("1 1 l\nh\nf\n"));
  EXPECT_TRUE(Artwork("<rect width='10' height='10' rx='2'></rect>").has(" c\n"));
}

TEST(Artwork, LinesHaveNoInside) {
  // Filled, each would be a hair of black in the middle of its pen.
  for (const char* element :
       {"<line x2='9' stroke='red'></line>", "<path d='M0 0L9 0zM1 1h3' stroke='red'></path>",
        "<polyline points='0,0 9,0' stroke='red'></polyline>"}) {
    const Artwork drawn(element);
    EXPECT_TRUE(drawn.has("\nS\nQ\n")) << element << drawn.operators;
    EXPECT_FALSE(drawn.has("rg")) << element;
  }
  EXPECT_EQ(Artwork("<line x2='9'></line>").operators, "");
  EXPECT_TRUE(Artwork("<path d='M0 0L1 0M0 0A9 9 0 0 1 5 5'></path>").has("f\n"));
}

TEST(Artwork, WhatIsLargerThanAnyPaperTakesNoTime) {
  std::string transform;
  for (int i = 0; i < 40; ++i) transform += "scale(1e9) ";
  EXPECT_LT(Artwork("<circle r='5' transform='" + transform + "'></circle>").operators.size(),
            500'000U);
}

TEST(Artwork, StylesHoldByTheirWeight) {
  const std::string styles =
      "<style>rect { fill: #010101 } .a, .b { fill: #020202; } #c { fill: #030303 } "
      "g rect { fill: red } /* rect { fill: blue } */</style>";
  const auto fill = [&](const std::string& attributes) {
    const Artwork drawn(styles + "<rect width='1' height='1' " + attributes + "></rect>");
    EXPECT_EQ(drawn.reported.count("template-part-left-out"), 1U) << "the selector of two";
    return drawn.operators.substr(2, 4);
  };
  EXPECT_EQ(fill("fill='#090909'"), ".004");
  EXPECT_EQ(fill("class='x a'"), ".008");
  EXPECT_EQ(fill("class='a' id='c'"), ".012");
  EXPECT_EQ(fill("id='c' style='fill: #040404'"), ".016");
}

TEST(Artwork, GroupsUsesAndTheViewBoxMoveWhatTheyHold) {
  const Artwork drawn(
      "<g transform='translate(10,0)' stroke='black' fill='none' stroke-width='1'>"
      "<path id='p' d='M0 0L1 0'></path></g><use href='#p' x='5' y='5' stroke='red'>"
      "</use>",
      "0 0 200 100");
  EXPECT_TRUE(drawn.has(".5 w 0 J")) << drawn.operators;
  EXPECT_TRUE(drawn.has("5 0 m\n5.5 0 l\n"));
  EXPECT_TRUE(drawn.has("1 0 0 RG"));
  EXPECT_TRUE(drawn.has("2.5 2.5 m\n3 2.5 l\n"));
  EXPECT_TRUE(drawn.reported.counts().empty());
  // A box of another shape lies in the middle of the paper.
  EXPECT_TRUE(Artwork("<path d='M0 0L1 0 1 1'></path>", "0 0 50 50").has("25 0 m\n"));
}

TEST(Artwork, TextsStandAtTheirAnchors) {
  const auto place = [](const std::string& text) {
    const std::string all = Artwork(text).operators;
    const std::size_t end = all.find(" Tm\n");
    return all.substr(all.find("rg\n") + 3, end - all.find("rg\n") - 3);
  };
  EXPECT_EQ(place("<text x='10' y='20' font-size='5'>0</text>"), "5 0 0 -5 10 20");
  // A figure is .636 of its size wide.
  EXPECT_EQ(place("<text x='10' y='20' font-size='5' text-anchor='end'>00</text>"),
            "5 0 0 -5 3.638 20");
  EXPECT_EQ(
      place("<text text-anchor='middle' font-size='10'>\n<tspan x='50' y='9'> 0 </tspan></text>"),
      "10 0 0 -10 46.819 9");
  const Artwork two("<text x='1' y='2' font-size='10'>0<tspan fill='red' dy='1'>0</tspan></text>");
  EXPECT_TRUE(two.has("10 0 0 -10 7.362 3 Tm")) << two.operators;
  EXPECT_EQ(Artwork("<text fill='none'>0</text>").operators, "");
}

TEST(Artwork, ReportsWhatIsLeftOut) {
  const Artwork drawn(
      "<image href='data:image/png;base64,AA=='></image><rect width='1' height='1' "
      "fill='url(#g)' opacity='0.5'></rect><circle r='2'></circle><g clip-path='url(#c)'></g>"
      "<text><textPath href='#p'>along</textPath></text>");
  EXPECT_EQ(drawn.reported.count("template-part-left-out"), 5U);
  EXPECT_TRUE(drawn.has("f\n")) << "the rest is drawn";
  // A light gradient behind texts would be a black box that hides them.
  EXPECT_EQ(Artwork("<rect width='1' height='1' fill='url(#g)'></rect>").operators, "");
  EXPECT_TRUE(Artwork("<rect width='1' height='1' fill='url(#g) #f00'></rect>").has("1 0 0 rg\n"));
  // References that lead in a circle, which no template has that was read.
  EXPECT_EQ(Artwork("<g id='a'><use href='#a'></use></g>").reported.counts().size(), 1U);
}

TEST(SheetPdf, HasAPageForEachSheetWithItsViewsAsLayers) {
  const std::string text =
      "[sheet]\nsize = \"A4\"\ntemplate = \"t.svg\"\n[fields]\nno = \"N-1\"\n"
      "[[view]]\nname = \"plan\"\ndirection = \"top\"\nhidden = \"dashed\"\n"
      "[[tag]]\nselect = \"base\"\ntext = \"T\"\n";
  const auto drawn = test::drawn(text, {{"t.svg",
                                         "<svg width='297mm' height='210mm' viewBox='0 0 297 210'>"
                                         "<text x='5' y='5'>{{no}}</text></svg>"}});
  ASSERT_TRUE(drawn) << drawn.error().text();
  const auto pdf = [&](const parallel::Context& context) {
    const std::vector<Sheet> two{drawn->sheet, drawn->sheet};
    std::string bytes;
    const auto reported =
        write_pdf(two, drawn->model.model, [&](std::string_view part) { bytes += part; }, context);
    EXPECT_TRUE(reported && reported->counts().empty());
    return bytes;
  };
  const std::string bytes = pdf({});
  const test::PdfObjects read = test::read_pdf(bytes);
  ASSERT_EQ(read.fault, "");
  EXPECT_TRUE(read.has("/Type/Pages/Count 2"));
  EXPECT_TRUE(read.has("/MediaBox[0 0 841.889764 595.275591]"));
  for (const char* layer : {"(plan)", "(Visible sharp)", "(Frame)", "(Tags)"})
    EXPECT_TRUE(read.has(std::string("/OCG/Name") + layer)) << layer;
  for (const unsigned threads : {2U, 8U}) {
    parallel::Team team(threads);
    parallel::Context context;
    context.team = &team;
    EXPECT_EQ(pdf(context), bytes) << threads;
  }
  EXPECT_FALSE(write_pdf({}, drawn->model.model, [](auto) {}, {}));
}

}  // namespace
}  // namespace strake::sheets
