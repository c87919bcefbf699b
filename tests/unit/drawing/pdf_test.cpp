// SPDX-License-Identifier: Apache-2.0
// PDF from its numbers and letters to whole drawings.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stop_token>
#include <string>
#include <vector>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/lettering/font_data.hpp"
#include "drawing/lettering/lettering.hpp"
#include "drawing/pdf/pdf_document.hpp"
#include "drawing/pdf/pdf_path.hpp"
#include "drawing/pdf/pdf_syntax.hpp"
#include "geometry/numeric/trig.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/team.hpp"
#include "support/pdf_reader.hpp"

namespace strake::drawing {
namespace {

std::string number(double value, int decimals = 6) {
  std::string out;
  append_pdf_number(out, value, decimals);
  return out;
}

TEST(PdfSyntax, NumbersHaveNoExponentAndNoNeedlessDigits) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(12.5), "12.5");
  EXPECT_EQ(number(-0.003), "-.003");
  EXPECT_EQ(number(1e-7), "0");
  EXPECT_EQ(number(-1e-7), "0");
  EXPECT_EQ(number(1e9), "1000000000");
  EXPECT_EQ(number(72 / 25.4, 12), "2.834645669291");
  EXPECT_EQ(number(1e30, 12).find('e'), std::string::npos);
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "0");
}

TEST(PdfSyntax, TextsAreAsciiOrUtf16AndCommandNothing) {
  EXPECT_EQ(pdf_text("deck (1\\2)"), "(deck \\(1\\\\2\\))");
  EXPECT_EQ(pdf_text(""), "()");
  EXPECT_EQ(pdf_text("\xC3\xA4"), std::string("(\xFE\xFF\x00\xE4)", 6));
  // U+0D29 has the byte of a carriage return, which a reader would turn into another.
  EXPECT_EQ(pdf_text("\xE0\xB4\xA9"), std::string("(\xFE\xFF\\r\x29)", 7).insert(5, "\\"));
  // A control, a byte that is no UTF-8 and an override become U+FFFD; a ship is a pair of units.
  EXPECT_EQ(pdf_text("\x1B\xFF\xE2\x80\xAE"),
            std::string("(\xFE\xFF\xFF\xFD\xFF\xFD\xFF\xFD)", 10));
  EXPECT_EQ(pdf_text("\xF0\x9F\x9A\xA2"), std::string("(\xFE\xFF\xD8\x3D\xDE\xA2)", 8));
}

TEST(PdfSyntax, BytesComeBackFromDeflated) {
  std::string bytes;
  for (std::uint32_t i = 0; i < 200000; ++i) bytes += static_cast<char>(i * i % 251);
  EXPECT_EQ(test::inflated(deflated(bytes)), bytes);
  EXPECT_EQ(test::inflated(deflated("")), "");
}

/// The farthest that the curves of a path are from an ellipse, measured along its half axes.
double farthest(const std::string& path, const PaperCurve& curve) {
  std::istringstream in(path);
  std::vector<double> n;
  std::string word;
  PaperPoint pen;
  double worst = 0;
  while (in >> word) {
    if (word != "m" && word != "c" && word != "h") {
      n.push_back(std::stod(word));
      continue;
    }
    if (word == "c") {
      for (int i = 0; i <= 64; ++i) {
        const double t = i / 64.0, s = 1 - t;
        const auto at = [&](double p, double a, double b, double c) {
          return s * s * s * p + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * c;
        };
        const PaperPoint p{at(pen.x, n[0], n[2], n[4]), at(pen.y, n[1], n[3], n[5])};
        const double t0 = curve_parameter(curve, p);
        const double x = curve.centre.x + curve.u.x * std::cos(t0) + curve.v.x * std::sin(t0);
        const double y = curve.centre.y + curve.u.y * std::cos(t0) + curve.v.y * std::sin(t0);
        worst = std::max(worst, std::hypot(p.x - x, p.y - y));
      }
    }
    if (n.size() >= 2) pen = {n[n.size() - 2], n[n.size() - 1]};
    n.clear();
  }
  return worst;
}

TEST(PdfPath, CurvesAreWithinTwoMicrometresOfTheirEllipse) {
  for (const double radius : {0.1, 1.0, 7.5, 40.0, 300.0, 5000.0}) {
    const PaperCurve curve{{100, 50}, {radius, radius / 3}, {-radius / 4, radius / 2}};
    std::string path;
    const auto at = [&](double t) {
      const geometry::SinCos s = geometry::sin_cos(t);
      return PaperPoint{curve.centre.x + curve.u.x * s.cos + curve.v.x * s.sin,
                        curve.centre.y + curve.u.y * s.cos + curve.v.y * s.sin};
    };
    append_pdf_point(path, at(0.3));
    path += "m\n";
    append_pdf_arc(path, curve, 0.3, 5, at(5.3));
    EXPECT_LE(farthest(path, curve), 2 * kPdfCurveErrorMm) << radius;
    EXPECT_GT(farthest(path, {curve.centre, curve.u, {curve.v.x, curve.v.y + 0.01 * radius}}),
              0.001 * radius)
        << "the measure sees nothing";
  }
  std::string circle;
  append_pdf_circle(circle, {10, 20}, 4);
  EXPECT_LE(farthest(circle, {{10, 20}, {4, 0}, {0, 4}}), 2 * kPdfCurveErrorMm);
  EXPECT_TRUE(circle.starts_with("14 20 m\n"));
  EXPECT_TRUE(circle.ends_with("14 20 c\nh\n"));
}

TEST(Lettering, FontHasTheWidthsThatTitleBlocksAssume) {
  const TrueTypeFont font(font_data());
  EXPECT_NEAR(font.advance(font.glyph_of('0')), 636, 0.5);
  EXPECT_NEAR(font.advance(font.glyph_of('W')), 989, 0.5);
  EXPECT_NEAR(font.advance(font.glyph_of(' ')), 318, 0.5);
  // Latin, Greek, Cyrillic, and what no font of ours has.
  for (const std::uint32_t code : {0xE9U, 0x39BU, 0x416U, 0x2300U, 0xFFFDU})
    EXPECT_NE(font.glyph_of(code), kMissingGlyph) << code;
  EXPECT_EQ(font.glyph_of(0x4E2D), kMissingGlyph);
  EXPECT_EQ(font.glyph_of(0x10FFFF), kMissingGlyph);
  EXPECT_NEAR(font.metrics().cap_height, 729, 1);
  EXPECT_EQ(TrueTypeFont("no font").glyph_of('A'), kMissingGlyph);
}

TEST(Lettering, SubsetKeepsWhatItsGlyphsAreMadeOf) {
  const TrueTypeFont font(font_data());
  const GlyphId umlaut = font.glyph_of(0xC4), a = font.glyph_of('A');  // A with two dots, of an A
  const std::string small = font.subset({umlaut}),
                    large = font.subset({umlaut, font.glyph_of('Q')});
  EXPECT_LT(small.size(), font_data().size() / 8);
  EXPECT_LT(small.size(), large.size());
  EXPECT_TRUE(small == font.subset({umlaut})) << "the same glyphs, other bytes";
  const TrueTypeFont kept(small);
  EXPECT_EQ(kept.advance(umlaut), font.advance(umlaut));
  EXPECT_EQ(kept.advance(a), font.advance(a)) << "a component is lost";
  EXPECT_TRUE(font.subset({umlaut, a}) == small);
  EXPECT_NE(kept.advance(font.glyph_of('Q')), font.advance(font.glyph_of('Q')));
  // The sum of all words of the file is what its head says.
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < small.size(); ++i)
    sum += static_cast<std::uint32_t>(static_cast<unsigned char>(small[i])) << (24 - 8 * (i % 4));
  EXPECT_EQ(sum, 0xB1B0AFBAU);
}

TEST(Lettering, ReportsWhatItCannotShow) {
  Letterer letterer;
  EXPECT_FALSE(letterer.set("\xCE\x9B \xD0\x96 \xC3\xA9 A").lacking);
  EXPECT_TRUE(letterer.diagnostics().counts().empty());
  const LetteredText text = letterer.set("TANK \xE4\xB8\xAD");
  EXPECT_TRUE(text.lacking);
  EXPECT_EQ(text.glyphs.back(), kMissingGlyph);
  EXPECT_EQ(text.text, "TANK \xE4\xB8\xAD");
  EXPECT_TRUE(letterer.set("\xD7\xA9").lacking) << "Hebrew, set from left to right";
  EXPECT_EQ(letterer.diagnostics().count("text-character-missing"), 2U);
  EXPECT_EQ(letterer.set("a\x1B\xFF").text, "a\xEF\xBF\xBD\xEF\xBF\xBD");
}

/// A drawing of two objects whose names are hostile, with arcs, hidden lines and a title.
struct Example {
  model::Model model;
  NeutralDrawing drawing;
  Ink ink;

  explicit Example(std::uint32_t lines = 4) {
    model.files.emplace_back();
    model.files[0].label = "a(b).obj";
    for (const char* name : {"one", "<\"&'>)\\\x01\xE2\x80\xAE\xFF \xE4\xB8\xAD"}) {
      model::Object object;
      object.id = object.name = name;
      model.objects.push_back(object);
    }
    drawing.title = "T \xE4\xB8\xAD )(";
    drawing.view.direction = {0, 0, 1};
    drawing.view.up = {0, 1, 0};
    drawing.sheet.scale_text = "1:50";
    const auto add = [&](std::uint32_t object, hlr::EdgeKind kind, LineState state) {
      Line line;
      line.object = line.other = model::ObjectId{object};
      line.kind = kind;
      line.state = state;
      const auto n = static_cast<double>(ink.lines.size());
      line.a_paper = {10 + std::fmod(n, 100), 20 + n / 100};
      line.b_paper = {11.5 + std::fmod(n, 100), 20.25 + n / 100};
      ink.lines.push_back(line);
    };
    for (const std::uint32_t object : {0U, 1U})
      for (std::uint32_t i = 0; i < lines; ++i) {
        add(object, hlr::EdgeKind::sharp, LineState::visible);
        add(object, hlr::EdgeKind::sharp, LineState::hidden_by_self);
        add(object, hlr::EdgeKind::contour, LineState::hidden_by_other);
      }
  }

  [[nodiscard]] std::string pdf(const parallel::Context& context = {}) const {
    std::string text;
    const auto status =
        write_pdf(drawing, ink, model, [&](std::string_view part) { text += part; }, context);
    EXPECT_TRUE(status);
    return text;
  }
};

TEST(Pdf, IsAFileWhoseObjectsAreWhereItsTableStates) {
  const test::PdfObjects pdf = test::read_pdf(Example().pdf());
  ASSERT_EQ(pdf.fault, "");
  EXPECT_TRUE(pdf.has("/MediaBox[0 0 1190.551181 841.889764]"));
  for (const char* layer : {"(Hidden by other objects)", "(Hidden by the object itself)",
                            "(Hidden sharp)", "(Hidden outline)", "(Visible sharp)", "(Title)"})
    EXPECT_TRUE(pdf.has(std::string("/OCG/Name") + layer)) << layer;
  EXPECT_FALSE(pdf.has("(Visible outline)")) << "an empty layer";
  EXPECT_TRUE(pdf.has("/Order["));
  EXPECT_FALSE(pdf.has("Date")) << "a time of the run";
  const std::string contents = pdf.contents();
  EXPECT_NE(contents.find("2.834645669291 0 0 -2.834645669291 0 841.889764 cm"), std::string::npos);
  EXPECT_NE(contents.find("/File(a\\(b\\).obj)"), std::string::npos);
  EXPECT_NE(contents.find("/ActualText"), std::string::npos) << "the box says what it stands for";
  const auto count = [&](std::string_view word) {
    std::size_t n = 0;
    for (std::size_t at = contents.find(word); at != std::string::npos;
         at = contents.find(word, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count("BDC\n"), count("EMC\n"));
  EXPECT_EQ(count("q\n"), count("Q\n"));
}

/// Dashes as the operator that chooses them.
std::string dashes(const std::vector<double>& lengths, double stretch) {
  std::string out = "[";
  for (const double length : lengths) out += number(length * stretch, 4) + ' ';
  return out + "]0 d\n";
}

TEST(Pdf, DashesFitHiddenLinesAndCentreLines) {
  Example example(0);
  const auto add = [&](double y, double length) {
    Line line;
    line.kind = hlr::EdgeKind::sharp;
    line.state = LineState::hidden_by_self;
    line.a_paper = {10, y};
    line.b_paper = {10 + length, y};
    example.ink.lines.push_back(line);
  };
  add(20, 10.7);
  add(30, 1);
  example.ink.centre_lines.push_back({model::ObjectId{0}, {{10, 50}, {39, 50}}, true});
  const test::PdfObjects pdf = test::read_pdf(example.pdf());
  ASSERT_EQ(pdf.fault, "");
  EXPECT_TRUE(pdf.has("/OCG/Name(Centre lines)"));
  const std::string contents = pdf.contents();
  const std::vector<double> hidden = pen_dashes(kHiddenDashes, example.ink.pens.thin),
                            centre = pen_dashes(kCentreDashes, example.ink.pens.thin);
  const double fits = fitted_stretch(10.7, DashEnds::open, hidden),
               crosses = fitted_stretch(29, DashEnds::centred, centre);
  ASSERT_NE(fits, 1);
  ASSERT_NE(crosses, fitted_stretch(29, DashEnds::open, centre));
  for (const std::string& path : {dashes(hidden, fits) + "10 20 m\n20.7 20 l\nS\n",
                                  std::string("[]0 d\n10 30 m\n11 30 l\nS\n"),
                                  dashes(centre, crosses) + "10 50 m\n39 50 l\nS\n"})
    EXPECT_NE(contents.find(path), std::string::npos) << path;
}

/// A line that an object hides in part itself is one line: its dashes go on where the layer
/// changes, unless the two parts have styles of their own.
TEST(Pdf, DashesGoOnWhereAnotherObjectHidesTheRest) {
  Example example(0);
  for (const double x : {10.0, 20.7}) {
    Line line;
    line.kind = hlr::EdgeKind::sharp;
    line.state = x == 10 ? LineState::hidden_by_self : LineState::hidden_by_other;
    line.a_paper = {x, 20};
    line.b_paper = {x == 10 ? 20.7 : 29, 20};
    example.ink.lines.push_back(line);
  }
  const std::vector<double> hidden = pen_dashes(kHiddenDashes, example.ink.pens.thin);
  const std::string whole = dashes(hidden, fitted_stretch(19, DashEnds::open, hidden));
  const std::string contents = test::read_pdf(example.pdf()).contents();
  const std::string amid = whole.substr(0, whole.find(']') + 1) + "10.7 d\n";
  for (const std::string& path :
       {whole + "10 20 m\n20.7 20 l\nS\n", amid + "20.7 20 m\n29 20 l\nS\n"})
    EXPECT_NE(contents.find(path), std::string::npos) << path;
  example.ink.split_hidden = true;
  const std::string apart = test::read_pdf(example.pdf()).contents();
  EXPECT_EQ(apart.find("10.7 d"), std::string::npos);
  for (const double length : {10.7, 8.3})
    EXPECT_NE(apart.find(dashes(hidden, fitted_stretch(length, DashEnds::open, hidden))),
              std::string::npos);
}

TEST(Pdf, HasTheSameBytesForAnyTeamAndOthersForOtherLines) {
  const Example example(5000);
  const std::string expected = example.pdf();
  ASSERT_EQ(test::read_pdf(expected).fault, "");
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    parallel::Team team(threads);
    parallel::Context context;
    context.team = &team;
    EXPECT_TRUE(example.pdf(context) == expected) << threads;
  }
  Example other(5000);
  other.ink.lines[0].a_paper.x += 0.001;
  const auto identity = [](const std::string& pdf) { return pdf.substr(pdf.rfind("/ID[")); };
  EXPECT_NE(identity(other.pdf()), identity(expected));
}

TEST(Pdf, ReportsCharactersThatTheFontLacks) {
  const Example example;
  const auto reported = write_pdf(example.drawing, example.ink, example.model, [](auto) {}, {});
  ASSERT_TRUE(reported);
  ASSERT_EQ(reported->count("text-character-missing"), 1U);
  EXPECT_NE(reported->kept().front().message.find("U+4E2D"), std::string::npos);
}

TEST(Pdf, EndsWhereTheSinkThrowsOrTheRunIsCancelled) {
  struct Full {};
  const Example example(3000);
  for (const int room : {0, 3, 9}) {
    int taken = 0;
    const auto full = [&](std::string_view) {
      if (taken++ == room) throw Full();
    };
    EXPECT_THROW((void)write_pdf(example.drawing, example.ink, example.model, full, {}), Full);
  }
  const std::stop_source stop;
  stop.request_stop();
  parallel::Context context;
  context.stop = stop.get_token();
  const auto status = write_pdf(example.drawing, example.ink, example.model, [](auto) {}, context);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

TEST(Pdf, PaperLargerThanPagesMayBeHasLargerUnits) {
  Example example;
  example.drawing.sheet.width_mm = 12000;
  example.drawing.sheet.height_mm = 3000;
  const test::PdfObjects pdf = test::read_pdf(example.pdf());
  ASSERT_EQ(pdf.fault, "");
  EXPECT_TRUE(pdf.has("/MediaBox[0 0 11338.582677 2834.645669]/UserUnit 3"));
}

TEST(Pdf, PagesHaveBookmarksAndLayersOfTheirOwn) {
  std::string text;
  const auto sink = [&](std::string_view part) { text += part; };
  PdfDocument document(sink, "set", "");
  for (const char* title : {"first", "second"}) {
    document.begin_page({210, 297}, title);
    const PdfLayerId view = document.add_layer("plan");
    const PdfLayerId lines = document.add_layer("Visible sharp", view);
    EXPECT_EQ(document.open(lines),
              "/OC/L" + std::to_string(view) + " BDC\n/OC/L" + std::to_string(lines) + " BDC\n");
    document.add(document.open(lines) + document.close(lines));
    document.add_bookmark("the plan", {10, 20, 100, 200});
  }
  EXPECT_TRUE(document.finish().counts().empty());
  const test::PdfObjects pdf = test::read_pdf(text);
  ASSERT_EQ(pdf.fault, "");
  EXPECT_TRUE(pdf.has("/Count 2/Kids["));
  EXPECT_TRUE(pdf.has("/Type/Outlines"));
  EXPECT_TRUE(pdf.has("/FitR 28.346 274.961 283.465 785.197"));
  EXPECT_TRUE(pdf.has("[(first)"));
  EXPECT_TRUE(pdf.has("[(second)"));
}

}  // namespace
}  // namespace strake::drawing
