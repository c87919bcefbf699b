// SPDX-License-Identifier: Apache-2.0
// Match lines: where views of a sheet, and of a set of sheets, go on in each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sheets/spec/text_metrics.hpp"
#include "support/pdf_reader.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

/// A plan of a part of three boxes at 1:50, whose middle lies so far to the right.
std::string part_view(const std::string& name, int at_mm, const std::string& min,
                      const std::string& max, const std::string& more = {}) {
  return "name=\"" + name + "\"\ndirection=\"top\"\nscale=\"1:50\"\nposition=[\"" +
         std::to_string(at_mm) + "mm\",\"100mm\"]\nlimits={min=[" + min + "],max=[" + max + "]}\n" +
         more;
}

constexpr const char *kHere = R"("0m","0m","0m")", *kThere = R"("2m","2m","2m")";

std::string two_parts(const std::string& more = "match_lines=\"on\"\n") {
  return "[[view]]\n" + part_view("AFT", 120, kHere, kThere, more) + "[[view]]\n" +
         part_view("FORE", 300, R"("2m","0m","0m")", R"("6m","2m","2m")", more);
}

Sheet matched(const std::string& text) {
  auto d = test::drawn(text);
  EXPECT_TRUE(d) << d.error().text();
  return d ? std::move(d->sheet) : Sheet{};
}

TEST(MatchLines, StandWhereAViewEndsAndAnotherGoesOn) {
  const Sheet sheet = matched(two_parts());
  for (const PlacedView& view : sheet.views) {
    const bool aft = view.name == "AFT";
    ASSERT_EQ(view.match_lines.paths.size(), 1U);
    ASSERT_EQ(view.match_lines.texts.size(), 1U);
    const auto& points = view.match_lines.paths[0].points;
    const double border = aft ? view.box.right : view.box.left;
    for (const PaperPoint& p : points) EXPECT_NEAR(p.x, border, 0.002);
    const auto [top, bottom] = std::minmax(points[0].y, points[1].y);
    EXPECT_NEAR(top, view.box.top - 4, 0.002);
    EXPECT_NEAR(bottom, view.box.bottom + 4, 0.002);
    const Text& text = view.match_lines.texts[0];
    EXPECT_EQ(text.text, aft ? "MATCH LINE, SEE VIEW FORE" : "MATCH LINE, SEE VIEW AFT");
    EXPECT_EQ(text.turn_deg, 90);
    const PaperBox box = box_of(text);
    EXPECT_GT(aft ? box.left - border : border - box.right, 1) << "it stands outside";
    EXPECT_LT(aft ? box.left - border : border - box.right, 2);
    for (const Text& title : view.caption.texts) EXPECT_FALSE(box_of(title).overlaps(box));
  }
  EXPECT_EQ(sheet.diagnostics.count("match-line-nowhere"), 0U);
}

TEST(MatchLines, AreRequested) {
  for (const PlacedView& view : matched(two_parts("")).views)
    EXPECT_TRUE(view.match_lines.paths.empty());
  const Sheet all = matched(two_parts("") + "[defaults]\nmatch_lines=\"on\"\n");
  for (const PlacedView& view : all.views) EXPECT_EQ(view.match_lines.paths.size(), 1U);
  // One may have them and the other not.
  const Sheet one =
      matched("[[view]]\n" + part_view("A", 120, kHere, kThere, "match_lines=\"on\"\n") +
              "[[view]]\n" + part_view("B", 300, R"("2m",0,0)", R"("6m","2m","2m")"));
  EXPECT_EQ(one.views[0].match_lines.paths.size(), 1U);
  EXPECT_TRUE(one.views[1].match_lines.paths.empty());
}

TEST(MatchLines, AreAsLongAsWhatTheViewsShare) {
  const Sheet sheet =
      matched("[[view]]\n" + part_view("A", 120, kHere, kThere, "match_lines=\"on\"\n") +
              "[[view]]\n" + part_view("B", 300, R"("2m","1m",0)", R"("6m","3m","2m")"));
  ASSERT_EQ(sheet.views[0].match_lines.paths.size(), 1U);
  const auto& points = sheet.views[0].match_lines.paths[0].points;
  const auto [top, bottom] = std::minmax(points[0].y, points[1].y);
  const PaperBox& box = sheet.views[0].box;
  EXPECT_NEAR(top, box.top - 4, 0.002);
  EXPECT_NEAR(bottom, (box.top + box.bottom) / 2, 0.002) << "y = 1 m";
}

TEST(MatchLines, OfSeveralNeighboursOnASideHaveEachItsPart) {
  const Sheet sheet =
      matched("[[view]]\n" + part_view("A", 80, kHere, kThere, "match_lines=\"on\"\n") +
              "[[view]]\n" + part_view("B", 200, R"("2m","1m",0)", R"("6m","2m","2m")") +
              "[[view]]\n" + part_view("C", 340, R"("2m",0,0)", R"("6m","1m","2m")") +
              "[[view]]\n" + part_view("D", 340, R"("2m",0,0)", R"("5m","1m","2m")"));
  ASSERT_EQ(sheet.views[0].match_lines.texts.size(), 2U) << "one for each part of the side";
  EXPECT_EQ(sheet.views[0].match_lines.texts[0].text, "MATCH LINE, SEE VIEW B");
  EXPECT_EQ(sheet.views[0].match_lines.texts[1].text, "MATCH LINE, SEE VIEW C");
  EXPECT_FALSE(box_of(sheet.views[0].match_lines.texts[0])
                   .overlaps(box_of(sheet.views[0].match_lines.texts[1])));
}

TEST(MatchLines, ThatFindNoNeighbourAreReportedWhereTheViewRequestsThem) {
  const auto reported = [](const std::string& text) {
    const Sheet sheet = matched(text);
    for (const PlacedView& view : sheet.views) EXPECT_TRUE(view.match_lines.paths.empty());
    std::string all;
    for (const Diagnostic& d : sheet.diagnostics.kept())
      if (d.code == "match-line-nowhere") all += d.message + "\n";
    return all;
  };
  const std::string on = "match_lines=\"on\"\n";
  const std::string alone = "[[view]]\n" + part_view("A", 120, kHere, kThere, on);
  EXPECT_NE(
      reported(alone).find("the view 'A' has no match line: its limits end where those of no"),
      std::string::npos);
  EXPECT_EQ(reported("[defaults]\n" + on + "[[view]]\n" + part_view("A", 120, kHere, kThere)), "");
  EXPECT_NE(reported("[[view]]\nname=\"v\"\n" + on).find("it has no limits"), std::string::npos);
  // Another direction, a gap, and no part of the side in common.
  std::string front = part_view("B", 300, R"("2m",0,0)", R"("6m","2m","2m")");
  front.replace(front.find("top"), 3, "front");
  EXPECT_NE(reported(alone + "[[view]]\n" + front), "");
  EXPECT_NE(
      reported(alone + "[[view]]\n" + part_view("B", 300, R"("2.1m",0,0)", R"("6m","2m","2m")")),
      "");
  EXPECT_NE(
      reported(alone + "[[view]]\n" + part_view("B", 300, R"("2m","2m",0)", R"("6m","3m","2m")")),
      "");
  // Nothing of the model comes near to the side.
  EXPECT_NE(reported("[[view]]\n" + part_view("A", 120, kHere, R"("9m","2m","2m")", on) +
                     "[[view]]\n" + part_view("B", 300, R"("9m",0,0)", R"("12m","2m","2m")"))
                .find("end long before"),
            std::string::npos);
}

TEST(MatchLines, StandInThePlaceOfBreakLinesAndGridLines) {
  const std::string on = "match_lines=\"on\"\n", breaks = "break_lines=\"on\"\n";
  const std::string grid = "[grid]\nx=[[\"A\",\"1m\"],[\"B\",\"2m\"]]\n";
  const Sheet without = matched(two_parts(breaks) + grid),
              sheet = matched(two_parts(on + breaks) + grid);
  EXPECT_EQ(without.views[0].ink.break_lines.size(), 1U) << "the side has one";
  EXPECT_TRUE(sheet.views[0].ink.break_lines.empty());
  EXPECT_FALSE(sheet.views[0].match_lines.paths.empty());
  // The grid line at 1 m is the same; of that at 2 m the part to its label is left.
  const auto upright_at = [](const PlacedView& view, double x) {
    double length = 0;
    for (const Path& path : view.grid.paths)
      if (std::abs(path.points.front().x - x) < 0.01 && std::abs(path.points.back().x - x) < 0.01)
        length += std::abs(path.points.front().y - path.points.back().y);
    return length;
  };
  const PaperBox& box = sheet.views[0].box;
  EXPECT_GT(upright_at(sheet.views[0], box.left + 20), box.height());
  EXPECT_GT(upright_at(without.views[0], without.views[0].box.right), box.height());
  EXPECT_LT(upright_at(sheet.views[0], box.right), 12);
}

TEST(MatchLines, NameTheSheetOfTheSetThatGoesOn) {
  const auto file = test::sheet_file(
      "[defaults]\nmatch_lines=\"on\"\n[[sheet]]\nname=\"one\"\n[[sheet.view]]\n" +
      part_view("AFT", 120, kHere, kThere) + "[[sheet]]\nname=\"two\"\n[[sheet.view]]\n" +
      part_view("FORE", 120, R"("2m","0m","0m")", R"("6m","2m","2m")"));
  ASSERT_TRUE(file) << file.error().text();
  const auto model = test::three_boxes();
  const auto scene = model::make_scene(model.model, {}, {}).value();
  const auto texts = [&](const SheetFile& of) {
    std::vector<std::string> found;
    const auto sheets = of.compose_all(scene, {}, {}).value();
    for (const Sheet& sheet : sheets)
      for (const Text& text : sheet.views[0].match_lines.texts) found.push_back(text.text);
    return found;
  };
  EXPECT_EQ(texts(*file), (std::vector<std::string>{"MATCH LINE, SEE VIEW FORE, SHEET 2",
                                                    "MATCH LINE, SEE VIEW AFT, SHEET 1"}));
  // Behind three sheets of other files.
  EXPECT_EQ(texts(file->in_set(3, 5)),
            (std::vector<std::string>{"MATCH LINE, SEE VIEW FORE, SHEET 5",
                                      "MATCH LINE, SEE VIEW AFT, SHEET 4"}));
}

TEST(MatchLines, HaveALayerInEveryFormat) {
  const auto d = test::drawn(two_parts()).value();
  EXPECT_NE(d.svg.find("id=\"view-1-match-lines\""), std::string::npos);
  EXPECT_NE(d.svg.find("<path class=\"match_line\""), std::string::npos);
  const auto written = [&](auto&& write) {
    std::string text;
    EXPECT_TRUE(write(
        std::span(&d.sheet, 1), d.model.model, [&](std::string_view some) { text += some; },
        parallel::Context{}));
    return text;
  };
  EXPECT_NE(written(write_dxf).find("AM_11_MATCH"), std::string::npos);
  const test::PdfObjects pdf = test::read_pdf(written(write_pdf));
  EXPECT_EQ(pdf.fault, "");
  EXPECT_TRUE(pdf.has("/OCG/Name(Match lines)"));
}

}  // namespace
}  // namespace strake::sheets
