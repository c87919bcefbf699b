// SPDX-License-Identifier: Apache-2.0
// Section marks, levels, extents, scale bar, north, lists and revisions of a sheet of three boxes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sheets/annotation/note_table.hpp"
#include "sheets/annotation/sheet_notes.hpp"
#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

using test::Drawn;
using test::fault_of;

/// An arrangement of front, top and left view at 1:50 on an A2, and what is to be said of them.
Drawn with_notes(const std::string& more, const std::string& arrangement = {}) {
  auto d = test::drawn(
      "[sheet]\nsize=\"A2\"\n[arrangement]\nviews=[\"front\",\"top\",\"left\"]\nscale=\"1:50\"\n" +
      arrangement + more);
  EXPECT_TRUE(d) << d.error().text();
  return std::move(d).value();
}

const PlacedView& view_named(const Sheet& sheet, std::string_view name) {
  return *std::ranges::find(sheet.views, name, &PlacedView::name);
}

std::vector<std::string> texts_of(const Marks& marks) {
  std::vector<std::string> texts;
  for (const Text& text : marks.texts) texts.push_back(text.text);
  return texts;
}

std::vector<const Path*> paths_of(const Marks& marks, LineClass line) {
  std::vector<const Path*> paths;
  for (const Path& path : marks.paths)
    if (path.line == line) paths.push_back(&path);
  return paths;
}

TEST(Notes, ASectionIsMarkedWhereItIsSeenEdgeOn) {
  const Drawn d = with_notes("", "[arrangement.front]\nsections=\"y=1m\"\nsection_mark=\"B\"\n");
  EXPECT_EQ(view_named(d.sheet, "front").title, "SECTION B-B");
  EXPECT_TRUE(view_named(d.sheet, "front").notes.paths.empty());
  const PlacedView& top = view_named(d.sheet, "top");
  EXPECT_EQ(texts_of(top.notes), (std::vector<std::string>{"B", "B"}));
  const auto planes = paths_of(top.notes, LineClass::cutting_plane);
  ASSERT_EQ(planes.size(), 1U);
  const auto& [a, b] = std::pair(planes[0]->points.front(), planes[0]->points.back());
  // y = 1 m is 20 mm above y = 0, the lower rim of the plan, and goes 8 mm beyond its 120 mm.
  EXPECT_NEAR(a.y, b.y, 1e-9);
  EXPECT_NEAR(top.box.bottom - a.y, 20, 0.01);
  EXPECT_NEAR(std::abs(a.x - b.x), top.box.width() + 2 * 8, 0.01);
  EXPECT_EQ(paths_of(top.notes, LineClass::section).size(), 2U);
  // One looks along y: the arrows lie below the line and point up.
  for (const Text& letter : top.notes.texts) EXPECT_GT(letter.at.y, a.y + 9);
  const auto& left = view_named(d.sheet, "left").notes;
  ASSERT_EQ(paths_of(left, LineClass::cutting_plane).size(), 1U);
  const Path& upright = *paths_of(left, LineClass::cutting_plane)[0];
  EXPECT_NEAR(upright.points.front().x, upright.points.back().x, 1e-9);
}

TEST(Notes, SectionMarksTouchNoTitle) {
  const Drawn d = with_notes("", "[arrangement.front]\nsections=\"y=1m\"\nsection_mark=\"B\"\n");
  for (const PlacedView& view : d.sheet.views)
    for (const Path& path : view.notes.paths)
      for (const PaperPoint& p : path.points)
        for (const Text& title : view.caption.texts)
          EXPECT_LT(p.y, title.at.y - title.height_mm) << view.name;
}

TEST(Notes, MarksCoverNoLabelsOfTheGrid) {
  // The grid lines stand where the view is cut, where a dimension begins, and along its way.
  const Drawn d = with_notes(
      "[grid]\nx=[[\"FR 0\",\"0m\"],[\"1\",\"1m\"],[\"2\",\"2m\"]]\ny=[[\"CL\",\"1m\"]]\n"
      "[levels]\nz=[\"0m\",[\"DECK\",\"1m\"]]\n"
      "[[dimension]]\nview=\"top\"\nfrom=[0,0,0]\nto=[\"2m\",0,0]\n"
      "[[dimension]]\nview=\"front\"\nfrom=[0,0,0]\nto=[0,0,\"1m\"]\nalong=\"vertical\"\n"
      "place=\"right\"\n",
      "[arrangement.front]\nsections=\"y=1m\"\nsection_mark=\"B\"\n"
      "[arrangement.left]\nsections=\"x=1m\"\nsection_mark=\"A\"\n"
      "[arrangement.top]\nextents_of=[\"front\",\"left\",\"top\"]\n");
  for (const PlacedView& view : d.sheet.views) {
    std::vector<PaperBox> boxes;
    for (const Text& text : view.notes.texts) boxes.push_back(box_of(text));
    for (const Circle& c : view.grid.circles)
      boxes.push_back(widened({c.center.x, c.center.y, c.center.x, c.center.y}, c.radius_mm));
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(boxes[i].overlaps(boxes[k])) << view.name << ' ' << k << ' ' << i;
    for (const Path& path : view.notes.paths) {
      if (path.line == LineClass::extent) continue;
      for (std::size_t p = 1; p < path.points.size(); ++p)
        for (const Circle& c : view.grid.circles)
          EXPECT_FALSE(
              clipped({path.points[p - 1], path.points[p]},
                      widened({c.center.x, c.center.y, c.center.x, c.center.y}, 0.9 * c.radius_mm)))
              << view.name;
    }
  }
  const PlacedView& top = view_named(d.sheet, "top");
  EXPECT_EQ(top.notes.texts.size(), 2 + 2 + 3 + 1U);
  EXPECT_EQ(top.grid.circles.size(), 4U);
}

TEST(Notes, SectionsThatNobodySeesAreReportedAndAMarkNeedsOne) {
  const auto d = test::drawn(
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nsections=\"y=1m\"\nsection_mark=\"A\"\n");
  ASSERT_TRUE(d);
  EXPECT_EQ(d->sheet.diagnostics.count("section-mark-nowhere"), 1U);
  EXPECT_NE(
      fault_of("[[view]]\nname=\"v\"\nsection_mark=\"A\"\n").find("has a section mark and no"),
      std::string::npos);
  EXPECT_NE(fault_of("[[view]]\nname=\"v\"\nsection_mark=\"\"\n").find("is no letter"),
            std::string::npos);
}

TEST(Notes, OneLetterForTwoSectionsIsReported) {
  const auto twice = [](const std::string& front, const std::string& left) {
    const Drawn d = with_notes("", "[arrangement.front]\nsections=\"y=1m\"\nsection_mark=\"" +
                                       front + "\"\n[arrangement.left]\nsections=\"x=1m\"\n" +
                                       "section_mark=\"" + left + "\"\n");
    return d.sheet.diagnostics.count("section-mark-twice");
  };
  EXPECT_EQ(twice("A", "A"), 1U);
  EXPECT_EQ(twice("A", "B"), 0U);
}

TEST(Notes, WhatLiesOffThePaperIsReported) {
  const auto off = [](const std::string& more) {
    return with_notes(more).sheet.diagnostics.count("note-off-the-sheet");
  };
  const std::string dimension = "[[dimension]]\nview=\"front\"\nfrom=[0,0,0]\n";
  EXPECT_EQ(off(dimension + "to=[\"1m\",0,0]\n[scale_bar]\n"), 0U);
  EXPECT_EQ(off(dimension + "to=[\"900km\",0,0]\n"), 1U);
  EXPECT_EQ(off("[scale_bar]\nposition=[\"-9mm\",\"20mm\"]\n"), 1U);
}

TEST(Notes, LevelsStandAtTheirHeights) {
  const Drawn d = with_notes("[levels]\nz=[\"0m\",[\"DECK\",\"1m\"],\"1.01m\",[\"SKY\",\"9m\"]]\n");
  const PlacedView& front = view_named(d.sheet, "front");
  // The level 0.2 mm above DECK has no room, and that at 9 m no view.
  EXPECT_EQ(texts_of(front.notes), (std::vector<std::string>{"\xC2\xB1"
                                                             "0.000",
                                                             "DECK +1.000"}));
  EXPECT_NEAR(front.notes.texts[0].at.y - front.notes.texts[1].at.y, 20, 0.01);
  EXPECT_NEAR(front.notes.paths[0].points[0].y, front.box.bottom, 0.01);
  EXPECT_TRUE(view_named(d.sheet, "top").notes.paths.empty());
  EXPECT_EQ(d.sheet.diagnostics.count("level-nowhere"), 1U);
  const Drawn one = with_notes("[levels]\nz=[\"0m\"]\nviews=[\"left\"]\n");
  EXPECT_TRUE(view_named(one.sheet, "front").notes.texts.empty());
  EXPECT_EQ(view_named(one.sheet, "left").notes.texts.size(), 1U);
}

TEST(Notes, AKeyPlanOutlinesWhatOtherViewsShow) {
  const Drawn d = with_notes(
      "[[view]]\nname=\"detail\"\ndirection=\"front\"\nposition=[\"500mm\",\"60mm\"]\n"
      "limits={min=[\"0m\",\"0m\",\"0m\"],max=[\"1m\",\"2m\",\"1m\"]}\n",
      "[arrangement.top]\nextents_of=[\"detail\"]\n");
  const PlacedView& top = view_named(d.sheet, "top");
  const auto extents = paths_of(top.notes, LineClass::extent);
  ASSERT_EQ(extents.size(), 1U);
  EXPECT_NEAR(std::abs(extents[0]->points[0].x - extents[0]->points[1].x), 20, 0.01);
  EXPECT_NEAR(std::abs(extents[0]->points[1].y - extents[0]->points[2].y), 40, 0.01);
  EXPECT_EQ(texts_of(top.notes), std::vector<std::string>{"detail"});
  EXPECT_NE(fault_of("[[view]]\nname=\"v\"\nextents_of=[\"w\"]\n").find("has no view 'w'"),
            std::string::npos);
}

TEST(Notes, ScaleBarsHaveRoundLengths) {
  for (const double scale : {0.5, 1.0, 2.5, 50.0, 75.0, 1000.0}) {
    Marks marks;
    draw_scale_bar({10, 10}, scale, marks);
    double left = 1e9, right = 0;
    for (const Path& path : marks.paths)
      for (const PaperPoint& p : path.points) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
      }
    const std::string last = marks.texts.back().text;
    const double metres = last.ends_with(" mm") ? 0.001 : 1;
    EXPECT_NEAR((right - left) * scale, std::stod(last) * metres * 1000, 0.01 * scale) << last;
    EXPECT_GE(right - left, 32 - 1e-6) << scale;
    EXPECT_LE(right, 10 + kScaleBarWidthMm) << scale;
  }
  const auto d = test::drawn(
      "[scale_bar]\n[[view]]\nname=\"v\"\neye=[\"9m\",\"-9m\",\"3m\"]\ntarget=[0,0,0]\n");
  ASSERT_TRUE(d);
  EXPECT_EQ(d->sheet.diagnostics.count("scale-bar-without-scale"), 1U);
}

TEST(Notes, NorthPointsWhereItIsInTheView) {
  const Drawn d = with_notes("[north]\ndirection=\"1,0,0\"\nposition=[\"300mm\",\"200mm\"]\n");
  const auto letter = std::ranges::find(d.sheet.notes.texts, "N", &Text::text);
  ASSERT_NE(letter, d.sheet.notes.texts.end());
  EXPECT_GT(letter->at.x, 305);  // to the right, where x goes in front view and plan
  EXPECT_NEAR(letter->at.y, 200 + 3.5 / 2, 0.01);
  const auto along = test::drawn("[north]\n[[view]]\nname=\"v\"\ndirection=\"front\"\n");
  ASSERT_TRUE(along);
  EXPECT_EQ(along->sheet.diagnostics.count("north-not-shown"), 1U);
}

TEST(Notes, PartsAreListedOnceForEqualTexts) {
  const auto model = test::three_boxes().model;
  const auto [table, objects] = parts_list({.where = {},
                                            .title = "PLATES",
                                            .select = {},
                                            .headings = {"DN"},
                                            .columns = {"{{@DN}}"},
                                            .position = {}},
                                           {true, true, true}, model);
  EXPECT_EQ(table.headings, (std::vector<std::string>{"POS", "DN", "QTY"}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1", "", "1"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"2", "50", "1"}));
  EXPECT_EQ(objects, (std::vector<std::vector<model::ObjectId>>{
                         {model::ObjectId{2}}, {model::ObjectId{1}}, {model::ObjectId{0}}}));
  const Drawn d = with_notes("[[parts_list]]\nselect=\"*\"\ncolumns=[[\"TYPE\",\"{{type}}\"]]\n");
  const auto texts = texts_of(d.sheet.notes);
  EXPECT_EQ(texts, (std::vector<std::string>{"POS", "TYPE", "QTY", "1", "mesh", "3"}));
}

TEST(Notes, TextsOfTablesStayInTheirCells) {
  std::string greek;
  for (int i = 0; i < 3000; ++i) greek += "\xCE\xA9";
  const NoteTable table{"T", {"A", "B"}, {{std::string(20'000, 'W'), greek}, {"short", "1"}}, 0};
  Marks marks;
  draw_table(table, {10, 20}, marks);
  const PaperBox within = extent_of(table).moved(10, 20);
  for (const Text& text : marks.texts) EXPECT_TRUE(within.holds(box_of(text))) << text.text.size();
  EXPECT_TRUE(marks.texts[3].text.ends_with("W\xE2\x80\xA6"));
  EXPECT_TRUE(marks.texts[4].text.ends_with("\xCE\xA9\xE2\x80\xA6"));
  EXPECT_LE(box_of(marks.texts[3]).right, box_of(marks.texts[4]).left);
  EXPECT_EQ(marks.texts[5].text, "short");
}

TEST(Notes, RowsWithoutRoomAreReported) {
  NoteTable table{"T", {"A"}, {{"1"}, {"2"}, {"3"}}, 0};
  table.fit(20);
  EXPECT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.left_out, 1U);
  table.fit(0);
  EXPECT_TRUE(table.rows.empty());
}

TEST(Notes, RevisionsStandOnTheTitleBlockTheNewestOnTop) {
  const Drawn d = with_notes(
      "[[revision]]\nrevision=\"A\"\ntext=\"first\"\n"
      "[[revision]]\nrevision=\"B\"\ndate=\"2026-02-11\"\ntext=\"<moved> & \\u202eturned\"\n");
  const auto texts = texts_of(d.sheet.notes);
  EXPECT_EQ(texts[4], "B");
  double bottom = 0;
  for (const Path& path : d.sheet.notes.paths)
    for (const PaperPoint& p : path.points) bottom = std::max(bottom, p.y);
  EXPECT_NEAR(bottom, 420 - 10 - 48, 1e-6);
  EXPECT_NE(d.svg.find("&lt;moved&gt; &amp; \xEF\xBF\xBDturned"), std::string::npos);
}

TEST(Notes, ViewsKeepClearOfThem) {
  const std::string notes =
      "[scale_bar]\n[north]\n[[revision]]\nrevision=\"A\"\n[[parts_list]]\nselect=\"*\"\n"
      "columns=[[\"NAME\",\"{{name}}\"]]\n";
  const Drawn d = with_notes(notes);
  for (const PlacedView& view : d.sheet.views)
    for (const Path& path : d.sheet.notes.paths)
      for (const PaperPoint& p : path.points)
        EXPECT_FALSE(view.box.overlaps({p.x, p.y, p.x + 1e-6, p.y + 1e-6})) << view.name;
  EXPECT_EQ(d.sheet.diagnostics.count("view-on-title-block"), 0U);
  EXPECT_EQ(with_notes("").svg.find("note"), std::string::npos);
}

}  // namespace
}  // namespace strake::sheets
