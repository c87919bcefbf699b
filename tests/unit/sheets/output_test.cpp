// SPDX-License-Identifier: Apache-2.0
// What PDF and DXF make of the marks and the ink of a sheet.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sheets/spec/text_metrics.hpp"
#include "strake/sheets/write.hpp"
#include "support/pdf_reader.hpp"

namespace strake::sheets {
namespace {

/// The red of a class, so that each has a colour of its own.
std::uint8_t red_of(std::size_t line) { return static_cast<std::uint8_t>(7 * line + 1); }

/// A sheet with a line of each class in its notes, and a view that keeps hidden lines apart.
Sheet sheet_of_all_classes() {
  Sheet sheet;
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    sheet.styles.at(c).color = {red_of(c), 0, 0, 255};
    const auto y = static_cast<double>(10 + c);
    Path path;
    path.line = static_cast<LineClass>(c);
    path.points = {{10, y}, {20, y}};
    sheet.notes.paths.push_back(path);
  }
  PlacedView view;
  view.name = "plan";
  view.ink.split_hidden = true;
  Text level;
  level.line = LineClass::note;
  level.text = "level of the view";
  view.notes.texts.push_back(level);
  sheet.views.push_back(view);
  return sheet;
}

std::string dxf_of(const Sheet& sheet) {
  std::string text;
  EXPECT_TRUE(
      write_dxf(std::span(&sheet, 1), {}, [&](std::string_view part) { text += part; }, {}));
  return text;
}

std::string pdf_of(const Sheet& sheet) {
  std::string text;
  EXPECT_TRUE(
      write_pdf(std::span(&sheet, 1), {}, [&](std::string_view part) { text += part; }, {}));
  return text;
}

/// Returns the values of a record behind its type, by group code; of codes that come again the
/// first.
std::vector<std::map<int, std::string>> records_of_dxf(const std::string& text,
                                                       const std::string& type) {
  std::vector<std::map<int, std::string>> found;
  bool within = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t middle = text.find('\n', at), end = text.find('\n', middle + 1);
    const int code = std::stoi(text.substr(at, middle - at));
    const std::string value = text.substr(middle + 1, end - middle - 1);
    if (code == 0) {
      within = value == type;
      if (within) found.emplace_back();
    } else if (within) {
      found.back().emplace(code, value);
    }
    at = end + 1;
  }
  return found;
}

TEST(SheetOutput, EveryClassLiesOnALayerOfItsStyleInDxf) {
  const std::string text = dxf_of(sheet_of_all_classes());
  std::map<std::string, std::string> color_of;
  for (const auto& layer : records_of_dxf(text, "LAYER"))
    if (layer.contains(420)) color_of[layer.at(2)] = layer.at(420);
  const auto lines = records_of_dxf(text, "LINE");
  ASSERT_EQ(lines.size(), kLineClasses);
  std::set<std::string> layers;
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    const std::string& layer = lines[c].at(8);
    layers.insert(layer);
    if (static_cast<LineClass>(c) == LineClass::hidden) continue;  // this sheet has it in two
    EXPECT_EQ(color_of[layer], std::to_string(red_of(c) * 0x10000)) << layer;
  }
  EXPECT_EQ(layers.size(), kLineClasses - 1);
  EXPECT_NE(text.find("level of the view"), std::string::npos);
}

TEST(SheetOutput, HiddenLinesHaveOneStyleInDxfWhereTheSheetHasOne) {
  Sheet sheet = sheet_of_all_classes();
  sheet.views[0].ink.split_hidden = false;
  std::set<std::string> colors;
  for (const auto& layer : records_of_dxf(dxf_of(sheet), "LAYER"))
    if (layer.at(2).starts_with("AM_3")) colors.insert(layer.at(420));
  const auto hidden = static_cast<std::size_t>(LineClass::hidden);
  EXPECT_EQ(colors, std::set<std::string>{std::to_string(red_of(hidden) * 0x10000)});
}

/// Where a TEXT of DXF has the unit of a font along its base line and above it, y upwards.
struct TextAxes {
  double ax = 0, ay = 0, bx = 0, by = 0;
};
TextAxes axes_of(const std::map<int, std::string>& text) {
  const auto number = [&](int code, double usual) {
    const auto at = text.find(code);
    return at == text.end() ? usual : std::stod(at->second);
  };
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const double size = number(40, 0) * kFontSize, side = number(71, 0) == 2 ? -1 : 1;
  const double c = std::cos(number(50, 0) * kDegree), s = std::sin(number(50, 0) * kDegree);
  const double along = side * number(41, 1) * size;
  const double lean = side * std::tan(number(51, 0) * kDegree) * size;
  return {along * c, along * s, lean * c - size * s, lean * s + size * c};
}

TEST(SheetOutput, TextsOfATemplateAreTransformedInDxfAsTheyAreInSvg) {
  struct Case {
    const char* transform;
    TextAxes axes;  // of the unit, y upwards
    bool mirrored;
  };
  const double t30 = std::tan(std::acos(-1.0) / 6), h = std::sqrt(0.5);
  for (const Case& one : std::initializer_list<Case>{
           {"translate(3,4)", {1, 0, 0, 1}, false},
           {"rotate(90)", {0, -1, 1, 0}, false},
           {"scale(2,1)", {2, 0, 0, 1}, false},
           {"skewX(-30)", {1, 0, t30, 1}, false},
           {"skewY(30)", {1, -t30, 0, 1}, false},
           {"scale(-1,1)", {-1, 0, 0, 1}, true},
           {"scale(1,-1)", {1, 0, 0, -1}, true},
           {"rotate(45) scale(-1,1) skewX(-30)", {-h, h, h - t30 * h, h + t30 * h}, true},
           {"matrix(1 2 3 -1 0 0)", {1, -2, -3, -1}, true}}) {
    Sheet sheet;
    sheet.artwork.emplace();
    sheet.artwork->view_box = "0 0 420 297";
    sheet.artwork->elements =
        std::string("<text font-size='10' transform='") + one.transform + "'>AB</text>";
    const auto texts = records_of_dxf(dxf_of(sheet), "TEXT");
    ASSERT_EQ(texts.size(), 1U) << one.transform;
    const TextAxes axes = axes_of(texts[0]);
    EXPECT_NEAR(axes.ax, 10 * one.axes.ax, 0.02) << one.transform;
    EXPECT_NEAR(axes.ay, 10 * one.axes.ay, 0.02) << one.transform;
    EXPECT_NEAR(axes.bx, 10 * one.axes.bx, 0.02) << one.transform;
    EXPECT_NEAR(axes.by, 10 * one.axes.by, 0.02) << one.transform;
    EXPECT_EQ(texts[0].contains(71), one.mirrored) << one.transform;
  }
}

TEST(SheetOutput, EveryClassHasItsColourInPdf) {
  const test::PdfObjects pdf = test::read_pdf(pdf_of(sheet_of_all_classes()));
  ASSERT_EQ(pdf.fault, "");
  const std::string contents = pdf.contents();
  std::set<std::string> pens;
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    const std::size_t line = contents.find("\n10 " + std::to_string(10 + c) + " m\n");
    ASSERT_NE(line, std::string::npos) << c;
    const std::size_t pen = contents.rfind("q\n", line);
    pens.insert(contents.substr(pen, line - pen));
  }
  EXPECT_EQ(pens.size(), kLineClasses);
  EXPECT_TRUE(pdf.has("/OCG/Name(Notes)"));
}

}  // namespace
}  // namespace strake::sheets
