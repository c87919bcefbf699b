// SPDX-License-Identifier: Apache-2.0
// Dimensions of a sheet of three boxes: "base" is 4 x 2 x 1 m, "top" lies at odd micrometres on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

using test::Drawn;
using test::fault_of;

Drawn dimensioned(const std::string& dimension, const std::string& view = "direction=\"front\"\n") {
  auto d = test::drawn("[sheet]\nsize=\"A2\"\n[[view]]\nname=\"v\"\nscale=\"1:50\"\n" + view +
                       "[[dimension]]\nview=\"v\"\n" + dimension);
  EXPECT_TRUE(d) << d.error().text();
  return std::move(d).value();
}

const Marks& marks_of(const Drawn& d) { return d.sheet.views[0].notes; }

std::string value_of(const Drawn& d) {
  EXPECT_EQ(marks_of(d).texts.size(), 1U);
  return marks_of(d).texts.empty() ? "" : marks_of(d).texts[0].text;
}

TEST(Dimensions, SidesOfObjectsAreMeasuredInTheModel) {
  const Drawn d =
      dimensioned("from={object=\"base\",side=\"left\"}\nto={object=\"base\",side=\"right\"}\n");
  EXPECT_EQ(value_of(d), "4000");
  // Two extension lines, the line, two arrows; above the lines of the view, the text above it.
  const Marks& marks = marks_of(d);
  ASSERT_EQ(marks.paths.size(), 5U);
  EXPECT_EQ(std::ranges::count_if(marks.paths, &Path::filled), 2);
  const double top = d.sheet.views[0].box.top;
  EXPECT_NEAR(marks.paths[2].points[0].y, top - 10, 1e-3);
  EXPECT_NEAR(marks.paths[2].points[1].x - marks.paths[2].points[0].x, 80, 1e-3);
  EXPECT_NEAR(marks.texts[0].at.y, top - 11, 1e-3);
  // An extension line begins beside its object, whose top lies below that of the view.
  EXPECT_NEAR(marks.paths[0].points[0].y, d.sheet.views[0].box.bottom - 20 - 1, 0.01);
}

TEST(Dimensions, ValuesAreExactOrRounded) {
  const std::string ends =
      "from={object=\"top\",side=\"left\"}\nto={object=\"top\",side=\"right\"}\n";
  EXPECT_EQ(value_of(dimensioned(ends)), "1000.008");
  EXPECT_EQ(value_of(dimensioned(ends + "decimals=0\n")), "1000");
  EXPECT_EQ(value_of(dimensioned(ends + "decimals=2\n")), "1000.01");
  EXPECT_EQ(value_of(dimensioned("from=[0,0,0]\nto=[\"4m\",\"9m\",\"1m\"]\nalong=\"vertical\"\n")),
            "1000");
}

TEST(Dimensions, UprightOnesAreReadFromTheRight) {
  const Drawn d = dimensioned(
      "from={object=\"base\",side=\"bottom\"}\nto={object=\"base\",side=\"top\"}\n"
      "along=\"vertical\"\nplace=\"right\"\noffset=\"14mm\"\n");
  const Marks& marks = marks_of(d);
  EXPECT_EQ(value_of(d), "1000");
  EXPECT_TRUE(marks.texts[0].clears);
  for (const Path& path : marks.paths) {
    for (std::size_t i = 1; !path.filled && i < path.points.size(); ++i)
      EXPECT_FALSE(clipped({path.points[i - 1], path.points[i]}, box_of(marks.texts[0])));
  }
  // The text stands on its line, at the left of it, and runs upwards.
  EXPECT_NEAR(marks.texts[0].at.x, d.sheet.views[0].box.right + 14 - 1, 0.01);
  EXPECT_EQ(marks.texts[0].turn_deg, 90);
  const PaperBox box = box_of(marks.texts[0]);
  EXPECT_GT(box.height(), box.width());
  EXPECT_LT(box.right, d.sheet.views[0].box.right + 14);
}

TEST(Dimensions, TextsRunAlongTheirLinesAndAreNeverUpsideDown) {
  struct Case {
    std::string from, to;
    double turn_deg;
  };
  for (const Case& c :
       {Case{"[0,0,0]", "[\"3m\",0,\"3m\"]", 45}, Case{"[\"3m\",0,\"3m\"]", "[0,0,0]", 45},
        Case{"[0,0,\"3m\"]", "[\"3m\",0,0]", -45}, Case{"[\"3m\",0,0]", "[0,0,\"3m\"]", -45},
        Case{"[0,0,0]", "[0,0,\"3m\"]", 90}, Case{"[0,0,\"3m\"]", "[0,0,0]", 90},
        Case{"[\"3m\",0,0]", "[0,0,0]", 0}}) {
    const Drawn d = dimensioned("from=" + c.from + "\nto=" + c.to + "\nalong=\"aligned\"\n");
    const Marks& marks = marks_of(d);
    ASSERT_EQ(marks.texts.size(), 1U);
    const Text& text = marks.texts[0];
    EXPECT_NEAR(text.turn_deg, c.turn_deg, 1e-6) << c.from;
    // It covers neither its line nor what it measures.
    const auto corners = corners_of(text);
    const Path& line = marks.paths.at(marks.paths.size() - 3);
    const PaperPoint a = line.points[0], b = line.points[1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    double least = 1e9, most = -1e9;
    for (const PaperPoint& p : corners) {
      const double beside = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
      least = std::min(least, beside);
      most = std::max(most, beside);
    }
    EXPECT_GT(least * most, 0) << c.from;
    EXPECT_NEAR(std::min(std::fabs(least), std::fabs(most)), 1 - text.height_mm / 4, 1e-3);
  }
}

TEST(Dimensions, WhatATextCoversIsNoMoreThanItself) {
  Text text{LineClass::dimension, {100, 100}, 2.5, Align::middle, "1234567890", false, 30};
  double area = 0;
  for (const PaperBox& box : boxes_of(text)) area += box.width() * box.height();
  const PaperBox level = level_box_of(text), round = box_of(text);
  EXPECT_LT(area, 0.75 * round.width() * round.height());
  EXPECT_GE(area, level.width() * level.height());
  for (const PaperPoint& corner : corners_of(text))
    EXPECT_TRUE(std::ranges::any_of(boxes_of(text), [&](const PaperBox& box) {
      return box.left - 1e-9 <= corner.x && corner.x <= box.right + 1e-9 &&
             box.top - 1e-9 <= corner.y && corner.y <= box.bottom + 1e-9;
    }));
  text.turn_deg = 90;
  EXPECT_EQ(boxes_of(text).size(), 1U);
  EXPECT_NEAR(box_of(text).height(), level.width(), 1e-9);
}

TEST(Dimensions, AlignedOnesRunAlongTheirPoints) {
  const Drawn d = dimensioned("from=[0,0,0]\nto=[\"3m\",0,\"4m\"]\nalong=\"aligned\"\n");
  EXPECT_EQ(value_of(d), "5000");
  const PaperPoint a = marks_of(d).paths[2].points[0], b = marks_of(d).paths[2].points[1];
  EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 100, 0.01);
}

TEST(Dimensions, NarrowOnesHaveTheirArrowsOutside) {
  const Drawn d = dimensioned("from=[0,0,0]\nto=[\"200mm\",0,0]\n");
  const Path& line = marks_of(d).paths.at(marks_of(d).paths.size() - 3);
  EXPECT_NEAR(line.points[1].x - line.points[0].x, 4 + 2 * 5, 0.01);
  EXPECT_EQ(marks_of(d).texts[0].align, Align::start);
}

TEST(Dimensions, WhatCannotBeMeasuredIsReported) {
  const auto reported = [](const Drawn& d, std::string_view what) {
    EXPECT_TRUE(marks_of(d).paths.empty());
    for (const Diagnostic& one : d.sheet.diagnostics.kept())
      if (one.code == "dimension-not-drawn" && one.message.find(what) != std::string::npos)
        return true;
    return false;
  };
  const std::string side = "from={object=\"base\"}\nto=[0,0,0]\n";
  EXPECT_TRUE(
      reported(dimensioned("from={object=\"<none>\"}\nto=[0,0,0]\n"), "no object is called"));
  EXPECT_TRUE(reported(dimensioned(side, "direction=\"iso\"\n"), "looks along no axis"));
  EXPECT_TRUE(reported(dimensioned("from=[0,0,0]\nto=[0,\"1m\",0]\n"), "lie on each other"));
  EXPECT_TRUE(reported(dimensioned(side, "eye=[\"9m\",\"-9m\",\"3m\"]\ntarget=[0,0,0]\n"),
                       "is in perspective"));
}

TEST(Dimensions, FaultsNameWhatIsMissing) {
  const std::string head = "[[view]]\nname=\"v\"\n[[dimension]]\nview=\"v\"\n";
  for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
           {"to=[0,0,0]\n", "has no 'from'"},
           {"from=[0,0,0]\nto=\"here\"\n", "to"},
           {"from=[0,0,0]\nto=[1,0,0]\nplace=\"left\"\n", "does not go with 'along'"},
           {"from=[0,0,0]\nto=[1,0,0]\ndecimals=4\n", "three decimals"},
           {"from=[0,0,0]\nto={object=\"a\",side=\"middle\"}\n", "side"}})
    EXPECT_NE(fault_of(head + text).find(fault), std::string::npos) << fault_of(head + text);
}

}  // namespace
}  // namespace strake::sheets
