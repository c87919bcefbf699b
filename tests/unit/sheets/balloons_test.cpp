// SPDX-License-Identifier: Apache-2.0
// Balloons of parts lists: which rows have one, where it points, and what it covers.
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

constexpr const char* kBalloonView =
    "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:50\"\nposition=[\"150mm\",\"120mm\"]\n";

Drawn ballooned(const std::string& views, const std::string& balloons,
                const std::string& list = "columns=[[\"NAME\",\"{{name}}\"]]\n") {
  auto d = test::drawn(views + "[[parts_list]]\nselect=\"*\"\n" + list + "balloons=" + balloons);
  EXPECT_TRUE(d) << d.error().text();
  return d ? std::move(*d) : Drawn{};
}

std::string message_of(const Drawn& d, const std::string& code) {
  const auto& kept = d.sheet.diagnostics.kept();
  const auto reported = std::ranges::find(kept, code, &Diagnostic::code);
  return reported == kept.end() ? std::string() : reported->message;
}

/// Returns the object that the leader of a balloon points at: the one on whose visible line its tip
/// lies.
std::string pointed_at(const Drawn& d, const PlacedView& view, const PaperPoint& tip) {
  const PaperBox at = widened({tip.x, tip.y, tip.x, tip.y}, 0.002);
  for (const drawing::Line& line : view.ink.lines)
    if (clipped({line.a_paper, line.b_paper}, at)) return d.model.model.object(line.object).name;
  return {};
}

/// The number of each balloon of a view and the object that it points at.
std::vector<std::pair<std::string, std::string>> balloons_in(const Drawn& d,
                                                             const PlacedView& view) {
  std::vector<std::pair<std::string, std::string>> found;
  const Marks& marks = view.tags;
  EXPECT_EQ(marks.circles.size(), marks.texts.size());
  EXPECT_EQ(marks.paths.size(), 2 * marks.texts.size());
  for (std::size_t b = 0; b < marks.texts.size(); ++b) {
    const Circle& circle = marks.circles[b];
    const Path& leader = marks.paths[2 * b];
    EXPECT_EQ(leader.points.size(), 2U);
    // The leader ends at the rim and points at the centre; the number stands in the middle.
    const PaperPoint &tip = leader.points.front(), &end = leader.points.back();
    EXPECT_NEAR(std::hypot(end.x - circle.center.x, end.y - circle.center.y), circle.radius_mm,
                0.002);
    EXPECT_NEAR(std::hypot(tip.x - circle.center.x, tip.y - circle.center.y),
                std::hypot(end.x - tip.x, end.y - tip.y) + circle.radius_mm, 0.003);
    const PaperBox text = box_of(marks.texts[b]);
    EXPECT_NEAR((text.left + text.right) / 2, circle.center.x, 1e-9);
    for (const PaperPoint& corner :
         {PaperPoint{text.left, text.top}, {text.right, marks.texts[b].at.y}})
      EXPECT_LT(std::hypot(corner.x - circle.center.x, corner.y - circle.center.y),
                circle.radius_mm - 0.4);
    const PaperBox box = widened(
        {circle.center.x, circle.center.y, circle.center.x, circle.center.y}, circle.radius_mm);
    for (const drawing::Line& line : view.ink.lines)
      EXPECT_FALSE(clipped({line.a_paper, line.b_paper}, box)) << marks.texts[b].text;
    found.emplace_back(marks.texts[b].text, pointed_at(d, view, tip));
  }
  return found;
}

using NumberedObjects = std::vector<std::pair<std::string, std::string>>;

TEST(Balloons, HaveTheNumbersOfTheRowsOfWhatTheyPointAt) {
  const Drawn d = ballooned(kBalloonView, "{}");
  EXPECT_EQ(balloons_in(d, d.sheet.views[0]),
            (NumberedObjects{{"1", "base"}, {"2", "far"}, {"3", "top"}}));
  for (const Circle& circle : d.sheet.views[0].tags.circles) EXPECT_EQ(circle.radius_mm, 4);
  // The rows of the list say the same.
  std::vector<std::string> texts;
  for (const Text& text : d.sheet.notes.texts) texts.push_back(text.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"POS", "NAME", "QTY", "1", "base", "1", "2", "far",
                                             "1", "3", "top", "1"}));
  EXPECT_TRUE(ballooned(kBalloonView, "{size=\"12mm\"}").sheet.views[0].tags.circles[0].radius_mm ==
              6);
}

TEST(Balloons, StandAtWhatShowsMostOfARow) {
  // All three have one text, and the base is the largest.
  const Drawn d = ballooned(kBalloonView, "{}", "columns=[[\"TYPE\",\"{{type}}\"]]\n");
  EXPECT_EQ(balloons_in(d, d.sheet.views[0]), (NumberedObjects{{"1", "base"}}));
}

TEST(Balloons, StandInTheFirstViewThatShowsTheRow) {
  const std::string views = std::string(kBalloonView) +
                            "select=\"base\"\n[[view]]\nname=\"w\"\ndirection=\"top\"\n"
                            "scale=\"1:50\"\nposition=[\"300mm\",\"120mm\"]\n";
  const Drawn d = ballooned(views, "{}");
  EXPECT_EQ(balloons_in(d, d.sheet.views[0]), (NumberedObjects{{"1", "base"}}));
  EXPECT_EQ(balloons_in(d, d.sheet.views[1]), (NumberedObjects{{"2", "far"}, {"3", "top"}}));
  const Drawn other = ballooned(views, "{views=[\"w\"]}");
  EXPECT_TRUE(other.sheet.views[0].tags.circles.empty());
  EXPECT_EQ(balloons_in(other, other.sheet.views[1]).size(), 3U);
  const Drawn only = ballooned(views, "{views=\"v\"}");
  EXPECT_EQ(only.sheet.diagnostics.count("balloon-not-seen"), 1U);
  EXPECT_NE(message_of(only, "balloon-not-seen").find("2 rows have no balloons, POS 2, 3"),
            std::string::npos);
}

TEST(Balloons, StandOnTheSideThatIsRequested) {
  for (const std::string side : {"left", "right", "top", "bottom"}) {
    const Drawn d = ballooned(
        "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:100\"\n"
        "position=[\"150mm\",\"120mm\"]\n",
        "{side=\"" + side + "\"}");
    const PlacedView& view = d.sheet.views[0];
    EXPECT_EQ(balloons_in(d, view).size(), 3U) << side;
    for (const Circle& c : view.tags.circles) {
      const double beyond = side == "left"    ? view.box.left - c.center.x
                            : side == "right" ? c.center.x - view.box.right
                            : side == "top"   ? view.box.top - c.center.y
                                              : c.center.y - view.box.bottom;
      EXPECT_GE(beyond, c.radius_mm) << side;
    }
  }
}

TEST(Balloons, OfRowsThatTheListHasNoRoomForAreNotDrawn) {
  // Room for the headings and two rows above the lower edge of the paper.
  const Drawn d = ballooned(kBalloonView, "{}",
                            "columns=[[\"NAME\",\"{{name}}\"]]\nposition=[\"20mm\",\"281mm\"]\n");
  EXPECT_EQ(d.sheet.diagnostics.count("parts-list-no-room"), 1U);
  EXPECT_EQ(balloons_in(d, d.sheet.views[0]), (NumberedObjects{{"1", "base"}, {"2", "far"}}));
}

TEST(Balloons, WithoutRoomAreReported) {
  const Drawn d =
      ballooned("[sheet]\nsize=\"A4\"\n" + std::string(kBalloonView), "{size=\"100mm\"}");
  EXPECT_NE(message_of(d, "balloon-no-room").find("no balloon"), std::string::npos);
}

TEST(Balloons, KeepClearOfTagsAndOfEachOther) {
  const Drawn d =
      ballooned(std::string(kBalloonView) + "[[tag]]\nselect=\"*\"\ntext=\"THE {{name}}\"\n", "{}");
  const Marks& marks = d.sheet.views[0].tags;
  ASSERT_EQ(marks.circles.size(), 3U);
  ASSERT_EQ(marks.texts.size(), 6U);
  std::vector<PaperBox> boxes;
  for (const Circle& c : marks.circles)
    boxes.push_back(widened({c.center.x, c.center.y, c.center.x, c.center.y}, c.radius_mm));
  for (const Text& text : marks.texts)
    if (text.text.starts_with("THE ")) boxes.push_back(box_of(text));
  ASSERT_EQ(boxes.size(), 6U);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].overlaps(boxes[k])) << i << ' ' << k;
}

TEST(Balloons, NumbersOfManyDigitsBecomeSmallerInAllCircles) {
  const Drawn few = ballooned(kBalloonView, "{}");
  EXPECT_EQ(few.sheet.views[0].tags.texts[0].height_mm, 3.5);
  EXPECT_LT(ballooned(kBalloonView, "{size=\"3mm\"}").sheet.views[0].tags.texts[0].height_mm, 1.4);
}

TEST(Balloons, StateWhatIsWrongWithThem) {
  const auto fault = [](const std::string& balloons) {
    return fault_of(
        std::string(kBalloonView) +
        "[[parts_list]]\nselect=\"*\"\ncolumns=[[\"A\",\"{{name}}\"]]\nballoons=" + balloons);
  };
  EXPECT_EQ(fault("{}"), "");
  EXPECT_NE(fault("{views=[\"w\"]}").find("the sheet has no view 'w'"), std::string::npos);
  EXPECT_NE(fault("{size=\"1mm\"}").find("hold no numbers"), std::string::npos);
  EXPECT_NE(fault("{side=\"up\"}").find("'side'"), std::string::npos);
  EXPECT_NE(fault("{colour=\"red\"}").find("'colour'"), std::string::npos);
  EXPECT_NE(fault("true").find("line 9"), std::string::npos);
}

}  // namespace
}  // namespace strake::sheets
