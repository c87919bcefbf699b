// SPDX-License-Identifier: Apache-2.0
// Sheets of small models: what stands on them, to the micrometre, and what is reported about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/parallel/team.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

using test::Drawn;

Drawn drawn(const std::string& text, const test::Templates& templates = {}) {
  auto result = test::drawn(text, templates);
  EXPECT_TRUE(result) << result.error().text();
  return result ? std::move(*result) : Drawn{};
}

bool reported(const Sheet& sheet, const std::string& code, const std::string& words = "") {
  for (const Diagnostic& d : sheet.diagnostics.kept())
    if (d.code == code && d.message.find(words) != std::string::npos) return true;
  return false;
}

std::size_t count_of(const std::string& text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

std::string with_frame(const std::string& more) {
  return more +
         "\n[fields]\ntitle=\"\"\nowner=\"\"\nsubtitle=\"\"\nnumber=\"\"\nrevision=\"\"\n"
         "sheet=\"\"\ndrawn=\"\"\nchecked=\"\"\napproved=\"\"\ndate=\"\"\n";
}

const PlacedView& view_of(const Sheet& sheet, const std::string& name) {
  for (const PlacedView& view : sheet.views)
    if (view.name == name) return view;
  ADD_FAILURE() << name;
  return sheet.views.front();
}

TEST(Sheet, ViewsAreInLineToTheMicrometre) {
  for (const char* const projection : {"first-angle", "third-angle"})
    for (const char* const scale : {"1:7", "1:30", "1:33.3"}) {
      const Drawn d = drawn(with_frame("[sheet]\nsize=\"A0\"\nscale=\"" + std::string(scale) +
                                       "\"\n[arrangement]\nprojection=\"" + projection +
                                       "\"\nviews=[\"top\",\"bottom\",\"left\",\"right\"]"));
      // Of the model's x, and z: one place on paper in every view that shows it.
      std::map<double, double> x, z;
      const auto same = [](std::map<double, double>& places, double model, double paper) {
        const auto [at, added] = places.try_emplace(model, paper);
        // Ends of lines that were cut where others lie on them are rounded once more.
        return added || std::fabs(at->second - paper) < 0.0011;
      };
      for (const PlacedView& view : d.sheet.views)
        for (const drawing::Line& line : view.ink.lines) {
          const bool plan = view.name == "top" || view.name == "bottom";
          if (plan || view.name == "front") {
            EXPECT_TRUE(same(x, line.a_mm.x, line.a_paper.x)) << view.name;
            EXPECT_TRUE(same(x, line.b_mm.x, line.b_paper.x)) << view.name;
          }
          if (!plan) {
            EXPECT_TRUE(same(z, line.a_mm.z, line.a_paper.y)) << view.name;
            EXPECT_TRUE(same(z, line.b_mm.z, line.b_paper.y)) << view.name;
          }
        }
      EXPECT_EQ(x.size(), 6U);
      EXPECT_EQ(z.size(), 4U);
    }
}

TEST(Sheet, AnArrangementOfOneWord) {
  const Drawn d = drawn(with_frame("arrangement = \"third-angle\""));
  ASSERT_EQ(d.sheet.views.size(), 4U);
  EXPECT_EQ(d.sheet.views[0].name, "front");
  EXPECT_EQ(d.sheet.views[2].name, "right");
  EXPECT_TRUE(d.sheet.diagnostics.counts().empty());
  EXPECT_LT(view_of(d.sheet, "top").box.bottom, view_of(d.sheet, "front").box.top);
  EXPECT_GT(view_of(d.sheet, "right").box.left, view_of(d.sheet, "front").box.right);
}

TEST(Sheet, AViewLiesWhereItStates) {
  const Drawn d = drawn(with_frame(
      "[[view]]\nname=\"a\"\ndirection=\"front\"\nscale=\"1:50\"\nposition=[\"100mm\",\"80mm\"]\n"
      "[[view]]\nname=\"b\"\ndirection=\"front\"\nscale=\"1:100\"\nposition=[\"300mm\",\"100mm\"]\n"
      "anchor=[\"1m\",0,\"500mm\"]\n"));
  const PaperBox& box = view_of(d.sheet, "a").box;
  EXPECT_NEAR((box.left + box.right) / 2, 100, 0.001);
  EXPECT_NEAR((box.top + box.bottom) / 2, 80, 0.001);
  EXPECT_NEAR(box.width(), 120, 1e-9);
  // 1 m right of the anchor's place on paper lies 10 mm.
  EXPECT_NEAR(view_of(d.sheet, "b").box.left, 290, 1e-9);
  EXPECT_NEAR(view_of(d.sheet, "b").box.bottom, 105, 1e-9);
  EXPECT_NE(d.svg.find(">1:100</text>"),
            std::string::npos);  // beside the view, it is not the sheet's
}

/// A pipe of 3 m: as fine as the scale of each view requests, given or chosen.
TEST(Sheet, CurvesAreAsFineAsTheScaleRequests) {
  model::Model model;
  model.files.emplace_back();
  model.objects.emplace_back();
  model.objects[0].body_count = 1;
  model.shapes.emplace_back(geometry::CylinderPrimitive{50, 3000});
  model.bodies.emplace_back();
  const auto scene = model::make_scene(model, {.sag_mm = 0.5}, {}).value();
  const auto sags = [&](const std::string& text, const ComposeOptions& options = {}) {
    std::vector<double> found;
    const auto sheet =
        test::sheet_file(with_frame(text), {}).value().compose(scene, options, {}).value();
    for (const PlacedView& view : sheet.views) found.push_back(view.drawing.sag_mm);
    return found;
  };
  const std::string two =
      "[[view]]\nname=\"a\"\ndirection=\"front\"\nscale=\"1:20\"\nposition=[\"100mm\",\"80mm\"]\n"
      "[[view]]\nname=\"b\"\ndirection=\"top\"\nscale=\"1:2\"\nposition=[\"300mm\",\"100mm\"]\n";
  EXPECT_EQ(sags(two), (std::vector<double>{0.5, 0.1}));
  EXPECT_EQ(sags(two, {.sag_for_paper = false}), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(sags("[[view]]\nname=\"a\"\ndirection=\"top\"\nposition=[\"200mm\",\"100mm\"]\n"),
            (std::vector<double>{0.05}));
  EXPECT_EQ(sags("[[view]]\nname=\"a\"\ndirection=\"front\"\n"), (std::vector<double>{0.5}));
}

TEST(Sheet, AViewFromAnEyeIsTrueInThePlaneOfItsTarget) {
  const std::string eye =
      "[[view]]\nname=\"v\"\neye=[\"2m\",\"-10m\",\"500mm\"]\ntarget=[\"2m\",0,\"500mm\"]\n"
      "scale=\"1:50\"\nposition=[\"200mm\",\"100mm\"]\n";
  const PaperBox middle = view_of(drawn(with_frame(eye)).sheet, "v").box;
  EXPECT_NEAR((middle.left + middle.right) / 2, 200, 0.001);
  const Drawn d = drawn(with_frame(eye + "anchor=[\"2m\",0,\"500mm\"]\n[grid]\nx=[[\"A\",0]]\n" +
                                   "[[view]]\nname=\"w\"\ndirection=\"front\"\nscale=\"1:100\"\n" +
                                   "position=[\"330mm\",\"200mm\"]\n"));
  // From x = 0 to x = 6 m of faces that lie in that plane.
  const PlacedView& view = view_of(d.sheet, "v");
  EXPECT_NEAR(view.box.left, 200 - 40, 1e-9);
  EXPECT_NEAR(view.box.right, 200 + 80, 1e-9);
  // The front of the upper box is 250.007 mm farther away.
  EXPECT_NEAR(view.box.top, 100 - (1777.777 - 500) / 50 * 10000 / 10250.007, 0.001);
  EXPECT_NE(d.svg.find("name=\"v\" direction=\"0,-1,0\" up=\"0,0,1\" projection=\"perspective\""),
            std::string::npos);
  EXPECT_TRUE(view.grid.paths.empty());
  // Nothing is cut off by the field of view, so the frame lies beside the lines.
  ASSERT_EQ(view.frame.paths.size(), 1U);
  EXPECT_NEAR(view.frame.paths[0].points[0].x, view.box.left - 3, 1e-9);
  EXPECT_NEAR(view.frame.paths[0].points[2].y, view.box.bottom + 3, 1e-9);
  EXPECT_NE(d.svg.find("id=\"view-1-frame\""), std::string::npos);
  EXPECT_TRUE(view_of(d.sheet, "w").frame.paths.empty());
  EXPECT_FALSE(view_of(d.sheet, "w").grid.paths.empty());
  // The scale of the sheet is that of the other view; nothing has it beside a picture.
  EXPECT_EQ(view.caption.texts.size(), 1U);
  EXPECT_EQ(view_of(d.sheet, "w").caption.texts.size(), 1U);
}

TEST(Sheet, PerspectivesAloneGiveTheSheetNoScale) {
  const std::string eye =
      "[[view]]\nname=\"v\"\neye=[\"2m\",\"-10m\",\"500mm\"]\ntarget=[\"2m\",0,\"500mm\"]\n"
      "scale=\"1:50\"\nposition=[\"200mm\",\"100mm\"]\n";
  const Drawn alone = drawn(eye);
  EXPECT_EQ(alone.svg.find(">1:50</text>"), std::string::npos);
  EXPECT_EQ(count_of(alone.svg, ">\xE2\x80\x93</text>"), 1U);
  EXPECT_FALSE(reported(alone.sheet, "field-not-filled", "scale"));
  // A view that can be measured has its scale in the title block, whichever comes first.
  const Drawn both = drawn(eye + "[[view]]\nname=\"w\"\ndirection=\"front\"\nscale=\"1:100\"\n" +
                           "position=[\"330mm\",\"200mm\"]\n");
  EXPECT_EQ(count_of(both.svg, ">1:100</text>"), 1U);
  EXPECT_EQ(both.svg.find(">1:50</text>"), std::string::npos);
}

TEST(Sheet, WhatAViewDoesNotShowIsNotWorkedOut) {
  const std::string view = "[[view]]\nname=\"v\"\nscale=\"1:50\"\n";
  const Drawn without = drawn(with_frame(view));
  const Drawn dashed = drawn(with_frame(view + "hidden=\"dashed\"\n"));
  const auto count = [](const Drawn& d, drawing::LineState state) {
    return d.sheet.views[0].drawing.count[static_cast<std::size_t>(state)];
  };
  for (const auto state :
       {drawing::LineState::hidden_by_self, drawing::LineState::hidden_by_other}) {
    EXPECT_EQ(count(without, state), 0U);
    EXPECT_GT(count(dashed, state), 0U);
  }
  EXPECT_EQ(count(without, drawing::LineState::visible),
            count(dashed, drawing::LineState::visible));
  std::vector<drawing::Line> visible_lines;
  for (const drawing::Line& line : dashed.sheet.views[0].ink.lines)
    if (line.state == drawing::LineState::visible) visible_lines.push_back(line);
  const std::vector<drawing::Line>& all = without.sheet.views[0].ink.lines;
  ASSERT_EQ(all.size(), visible_lines.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].a_paper, visible_lines[i].a_paper);
    EXPECT_EQ(all[i].b_paper, visible_lines[i].b_paper);
  }
  EXPECT_NE(without.svg.find("hidden-lines=\"not asked for\""), std::string::npos);
  EXPECT_EQ(dashed.svg.find("hidden-lines="), std::string::npos);
}

TEST(Sheet, ATitleStatesItsSectionUnlessItIsGiven) {
  const Drawn d =
      drawn(with_frame("[arrangement]\nviews=[\"top\",\"left\",\"iso\"]\nsections=[\"z>500mm\"]\n"
                       "[arrangement.left]\ntitle=\"\"\n[arrangement.iso]\nsections=[]\n"));
  EXPECT_EQ(view_of(d.sheet, "front").title, "FRONT VIEW, SECTION z = 500 mm");
  EXPECT_EQ(view_of(d.sheet, "top").title, "SECTION z = 500 mm");
  EXPECT_EQ(view_of(d.sheet, "left").title, "");
  EXPECT_EQ(view_of(d.sheet, "iso").title, "ISOMETRIC VIEW");
  EXPECT_NE(d.svg.find(">SECTION z = 500 mm</text>"), std::string::npos);
  const Drawn own = drawn(with_frame(
      "[[view]]\nname=\"v\"\ndirection=\"top\"\ntitle=\"DECK\"\nsections=\"z>500mm\"\n"));
  EXPECT_EQ(view_of(own.sheet, "v").title, "DECK");
}

TEST(Sheet, APlaneCutsAwayWhatIsNearerInEachView) {
  // The defaults hold for views from both sides, and from an eye.
  const auto sheet = [](const std::string& all, const std::string& front, const std::string& back) {
    const auto view = [](const std::string& name, const std::string& from, const std::string& x,
                         const std::string& sections) {
      return "[[view]]\nname=\"" + name + "\"\n" + from + "\nscale=\"1:50\"\nposition=[\"" + x +
             "\",\"60mm\"]\n" + sections;
    };
    return drawn(with_frame(all + view("f", "direction=\"front\"", "90mm", front) +
                            view("b", "direction=\"back\"", "250mm", back) +
                            view("e", "eye=[\"2m\",\"-9m\",\"1m\"]\ntarget=[\"2m\",0,\"1m\"]",
                                 "350mm", front)))
        .svg;
  };
  const std::string below = "sections=[\"y<300mm\"]\n", above = "sections=\"y>300mm\"\n";
  EXPECT_EQ(sheet("[defaults]\nsections=[\"y = 300mm\"]\n", "", ""), sheet("", below, above));
  EXPECT_NE(sheet("", below, above), sheet("", below, below));
}

TEST(Sheet, TheFirstHatchThatPicksAnObjectHolds) {
  const Drawn d = drawn(with_frame(
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:50\"\nsections=[\"y<300mm\"]\n"
      "hatch=[{select=\"top\",spacing=0},{select=[\"top\",\"base\"],angle=\"90deg\","
      "spacing=\"100mm\"},{select=\"nobody\"}]\n"));
  std::map<std::uint32_t, std::vector<double>> hatches;
  for (const drawing::Line& line : d.sheet.views[0].ink.lines)
    if (line.kind == hlr::EdgeKind::hatch) {
      hatches[model::index(line.object)].push_back(line.a_paper.x);
      if (line.object == model::ObjectId{0}) {
        EXPECT_EQ(line.a_paper.x, line.b_paper.x);
      }
    }
  EXPECT_EQ(hatches.count(1), 0U);
  EXPECT_GT(hatches[2].size(), 2U);
  // 4 m of upright lines 2 mm apart on paper.
  std::vector<double>& base = hatches[0];
  std::sort(base.begin(), base.end());
  ASSERT_NEAR(static_cast<double>(base.size()), 40, 1);
  for (std::size_t i = 1; i < base.size(); ++i) EXPECT_NEAR(base[i] - base[i - 1], 2, 0.0011);
  EXPECT_TRUE(reported(d.sheet, "selection-matches-nothing", "'nobody'"));
}

TEST(Sheet, SectionsLeaveWhatAViewStatesWhole) {
  const std::string view =
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:50\"\nsections=[\"y<300mm\"]\n";
  const auto cut_lines = [](const Drawn& d, std::uint32_t object) {
    return std::ranges::count_if(d.sheet.views[0].ink.lines, [&](const drawing::Line& line) {
      return model::index(line.object) == object &&
             (line.kind == hlr::EdgeKind::section || line.kind == hlr::EdgeKind::hatch);
    });
  };
  constexpr std::uint32_t kBase = 0, kTop = 1;
  const Drawn d = drawn(with_frame(view + "uncut=[\"top\",\"nobody\"]\n"));
  EXPECT_EQ(cut_lines(d, kTop), 0);
  EXPECT_GT(cut_lines(d, kBase), 0);
  EXPECT_EQ(d.sheet.views[0].drawing.counters.uncut_objects, 1U);
  EXPECT_EQ(d.sheet.views[0].drawing.uncut_selections, (std::vector<std::string>{"nobody", "top"}));
  EXPECT_EQ(count_of(d.svg, " objects-uncut=\"1\""), 1U);
  EXPECT_TRUE(reported(d.sheet, "selection-matches-nothing", "'nobody'"));
  // An empty list takes back what holds for all views.
  const Drawn all = drawn(with_frame("[defaults]\nuncut=\"top\"\n" + view + "uncut=[]\n"));
  EXPECT_GT(cut_lines(all, kTop), 0);
  EXPECT_EQ(count_of(all.svg, "objects-uncut"), 0U);
}

TEST(Sheet, UncutWithoutSectionsIsReported) {
  const std::string cut =
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nsections=[\"y=300mm\"]\n"
      "position=[\"100mm\",\"100mm\"]\n";
  const std::string whole =
      "[[view]]\nname=\"w\"\ndirection=\"front\"\nposition=[\"300mm\",\"100mm\"]\n";
  const auto stated = [](const std::string& text) {
    std::vector<std::string> where;
    const Drawn composed = drawn(with_frame(text));
    for (const Diagnostic& d : composed.sheet.diagnostics.kept())
      if (d.code == "uncut-without-sections") where.push_back(d.where);
    return where;
  };
  const auto faults = stated(cut + whole + "uncut=\"top\"\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("line 10: [[view]] 'w', uncut"), std::string::npos) << faults[0];
  EXPECT_TRUE(stated(cut + "uncut=\"top\"\n" + whole).empty());
  // What holds for all views is for those that have sections.
  EXPECT_TRUE(stated("[defaults]\nuncut=\"top\"\n" + cut + whole).empty());
  EXPECT_EQ(stated("[defaults]\nuncut=\"top\"\n" + whole).size(), 1U);
}

TEST(Sheet, FlushSeamsAreLeftOutWhereAViewStatesIt) {
  const std::string view = "[[view]]\nname=\"v\"\nscale=\"1:50\"\n";
  EXPECT_EQ(count_of(drawn(with_frame(view)).svg, "edges-with-seams"), 0U);
  const Drawn d = drawn(with_frame(view + "flush_seams=\"off\"\n"));
  EXPECT_EQ(count_of(d.svg, " edges-with-seams=\"0\""), 1U);
}

TEST(Sheet, FreeViewsShareTheLargestScaleThatKeepsThemApart) {
  const Drawn d =
      drawn(with_frame("[[view]]\nname=\"a\"\ndirection=\"front\"\nposition=[\"120mm\","
                       "\"80mm\"]\n[[view]]\nname=\"b\"\ndirection=\"top\"\nposition=["
                       "\"300mm\",\"80mm\"]\n"));
  EXPECT_EQ(d.sheet.views[0].drawing.sheet.scale, 50);
  EXPECT_EQ(d.sheet.views[1].drawing.sheet.scale, 50);
  EXPECT_TRUE(d.sheet.diagnostics.counts().empty());
}

TEST(Sheet, WhatIsAmissIsNamed) {
  const std::string view = "[[view]]\nname=\"v\"\nselect=\"nobody\"\n";
  const Drawn nobody = drawn(with_frame(view));
  EXPECT_TRUE(reported(nobody.sheet, "selection-matches-nothing", "'nobody' picks no object"));
  EXPECT_TRUE(
      reported(nobody.sheet, "view-empty", "the view 'v' shows nothing: it has no objects"));
  const Drawn outside = drawn(
      with_frame("[[view]]\nname=\"v\"\nlimits={min=[\"90m\",0,0],max=[\"91m\",\"1m\",\"1m\"]}\n"));
  EXPECT_TRUE(reported(outside.sheet, "view-empty", "nothing lies within what it shows"));
  const Drawn off =
      drawn(with_frame("[[view]]\nname=\"v\"\nscale=\"1:1\"\nposition=[\"10mm\",\"10mm\"]\n"));
  EXPECT_TRUE(reported(off.sheet, "view-off-the-sheet"));
  const Drawn over =
      drawn(with_frame("[[view]]\nname=\"a\"\nscale=\"1:50\"\nposition=[\"200mm\",\"100mm\"]\n"
                       "[[view]]\nname=\"b\"\nscale=\"1:50\"\nposition=[\"210mm\",\"110mm\"]\n"
                       "[[view]]\nname=\"c\"\ndirection=\"front\"\nscale=\"1:50\"\nposition=["
                       "\"350mm\",\"250mm\"]\n"));
  EXPECT_TRUE(reported(over.sheet, "views-overlap", "'b' at 1:50 overlaps 'a'"));
  EXPECT_TRUE(reported(over.sheet, "view-off-the-frame", "'c'"));
  EXPECT_TRUE(reported(over.sheet, "view-on-title-block", "'c'"));
  const Drawn fields = drawn("[fields]\ntitel = \"x\"\n[[view]]\nname=\"v\"\n");
  EXPECT_TRUE(reported(fields.sheet, "field-not-filled",
                       "fields of the title block left empty: drawn, checked"));
  const Drawn without = drawn("[[view]]\nname=\"v\"\n");
  EXPECT_TRUE(reported(without.sheet, "field-not-filled", "; [fields] gives them"));
  for (const Diagnostic& d : without.sheet.diagnostics.kept())
    EXPECT_TRUE(d.code != "field-not-filled" || d.severity == Severity::note) << "a sheet without";
  EXPECT_TRUE(reported(fields.sheet, "field-not-in-template", "no place for titel"));
  const Drawn longer =
      drawn("[fields]\nrevision = \"" + std::string(200, 'W') + "\"\n[[view]]\nname=\"v\"\n");
  EXPECT_TRUE(reported(longer.sheet, "field-too-long", "revision"));
}

TEST(Sheet, NoRoomIsAnErrorThatNamesTheFile) {
  const auto none = test::drawn("[sheet]\nsize=[\"100mm\",\"100mm\"]\n[arrangement]\ngap=\"90mm\"");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().text().find("s.toml: the views have no room"), std::string::npos);
}

TEST(Sheet, AViewThatCannotBeDrawnIsNamed) {
  std::string planes;
  for (int i = 0; i < 17; ++i) planes += "\"z>" + std::to_string(i + 1) + "m\",";
  const auto cut = test::drawn("[[view]]\nname=\"v\"\nsections=[" + planes + "]\n");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().where, "s.toml, line 1: [[view]] 'v', section");
}

TEST(Sheet, AViewOfWhatIsAllHiddenReportsIt) {
  // The upper box behind the floor of the base, whose own edges lie outside.
  const Drawn d = drawn(with_frame(
      "[[view]]\nname=\"v\"\ndirection=\"bottom\"\nselect=[\"base\",\"top\"]\n"
      "limits={min=[\"400mm\",\"200mm\",\"-1m\"],max=[\"1600mm\",\"1100mm\",\"2m\"]}\n"));
  EXPECT_TRUE(reported(d.sheet, "view-empty", "all that lies within is hidden"));
}

TEST(Sheet, ViewsOffAnyPaperAreAnError) {
  const auto far = test::drawn(
      "[[view]]\nname=\"v\"\nscale=\"1000000:1\"\nposition=[0,0]\n"
      "anchor=[\"1e9m\",0,0]\n[[tag]]\nselect=\"*\"\ntext=\"x\"\n");
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().text().find("s.toml, line 1: [[view]] 'v': at 1000000:1"),
            std::string::npos)
      << far.error().text();
  // Far, but not that far: tags have no room there, and nothing else happens.
  const auto off = test::drawn(
      "[[view]]\nname=\"v\"\nscale=\"1:1\"\nposition=[\"1km\",0]\n"
      "[[tag]]\nselect=\"*\"\ntext=\"x\"\n");
  ASSERT_TRUE(off);
  EXPECT_TRUE(reported(off->sheet, "tag-no-room"));
}

TEST(Sheet, TemplatesReplaceTheFrame) {
  const test::Templates templates{
      {"f.svg",
       "<svg xmlns='http://www.w3.org/2000/svg' width='420mm' height='297mm' viewBox='0 0 420 297'>"
       "<text>{{title}} {{scale}} {{owner}}</text></svg>"}};
  const Drawn d = drawn(
      "[sheet]\ntemplate=\"f.svg\"\n[fields]\ntitle=\"<A & B>\"\nspare=\"x\"\n"
      "[[view]]\nname=\"v\"\nscale=\"1:50\"\n",
      templates);
  EXPECT_NE(d.svg.find("<text>&lt;A &amp; B&gt; 1:50 </text>"), std::string::npos);
  EXPECT_TRUE(reported(d.sheet, "field-not-filled", "fields of the template left empty: owner"));
  EXPECT_TRUE(reported(d.sheet, "field-not-in-template", "no place for spare"));
  EXPECT_EQ(d.svg.find("DRAWING NUMBER"), std::string::npos);
  const Drawn bare = drawn("[sheet]\nframe=false\n[[view]]\nname=\"v\"\n");
  EXPECT_TRUE(bare.sheet.frame.paths.empty());
  EXPECT_TRUE(bare.sheet.diagnostics.counts().empty());
}

TEST(Sheet, StylesAreWhatTheFileStates) {
  const Drawn d = drawn(with_frame(
      "[[view]]\nname=\"v\"\nhidden=\"dashed\"\n[styles]\nhidden={width=\"0.2mm\",dash=[\"2mm\","
      "\"1.5mm\"],color=\"#123ABC\"}\noutline={width=\"0.9mm\"}\n"));
  EXPECT_NE(
      d.svg.find(".strake .hidden { stroke: #123abc; stroke-width: 0.2; stroke-dasharray: 2 1.5;"),
      std::string::npos);
  EXPECT_NE(
      d.svg.find(".strake .outline { stroke: #000000; stroke-width: 0.9; stroke-dasharray: none;"),
      std::string::npos);
  EXPECT_EQ(d.sheet.views[0].ink.pens.outline, 0.9);
  // Dashes follow the width where only that is given.
  const Drawn wide =
      drawn(with_frame("[[view]]\nname=\"v\"\n[styles]\nhidden={width=\"0.5mm\"}\n"));
  EXPECT_NE(wide.svg.find("stroke-width: 0.5; stroke-dasharray: 6 1.5;"), std::string::npos);
}

TEST(Sheet, WhatIsHiddenByItselfMayBeALayerOfItsOwn) {
  const std::string view = "[[view]]\nname=\"v\"\ndirection=\"iso\"\nhidden=\"all\"\n";
  const Drawn one = drawn(with_frame(view));
  EXPECT_EQ(one.svg.find("\"by-self\""), std::string::npos);
  EXPECT_EQ(one.svg.find("hidden_self"), std::string::npos);
  const Drawn two = drawn(with_frame("[sheet]\nhidden_layers=\"two\"\n" + view));
  for (const char* const part : {"id=\"view-1-hidden-sharp\" class=\"hidden sharp\"",
                                 "id=\"view-1-hidden-sharp-by-other\" class=\"by-other\"",
                                 "id=\"view-1-hidden-sharp-by-self\" class=\"by-self\"",
                                 ".strake .hidden .by-self path, .strake .hidden_self { stroke: "
                                 "#000000; stroke-width: 0.25; "
                                 "stroke-dasharray: 3 0.75;"})
    EXPECT_NE(two.svg.find(part), std::string::npos) << part;
  // A style for one of them says the same, and the other one is as hidden lines are.
  const Drawn styled = drawn(with_frame(view + "[styles]\nhidden={color=\"#102030\",dash=[]}\n"
                                               "hidden_other={color=\"#ff0000\"}\n"));
  EXPECT_NE(styled.svg.find(".hidden .by-other path, .strake .hidden_other { stroke: #ff0000; "
                            "stroke-width: 0.25; stroke-dasharray: none;"),
            std::string::npos);
  EXPECT_NE(styled.svg.find(".hidden .by-self path, .strake .hidden_self { stroke: #102030;"),
            std::string::npos);
}

TEST(Sheet, OutlinesAndEdgesAreOfOneWeightThatGoesByTheSize) {
  for (const auto& [size, wide] : std::map<std::string, double>{{"A1", 0.7}, {"A3", 0.5}}) {
    const Drawn d = drawn(with_frame("[sheet]\nsize=\"" + size + "\"\n[[view]]\nname=\"v\"\n"));
    const auto width = [&](LineClass line) {
      return d.sheet.styles.at(static_cast<std::size_t>(line)).width_mm;
    };
    for (const LineClass line :
         {LineClass::outline, LineClass::edge, LineClass::boundary, LineClass::intersection})
      EXPECT_EQ(width(line), wide) << class_name(line);
    for (const LineClass line : {LineClass::hidden, LineClass::hatch, LineClass::smooth})
      EXPECT_EQ(width(line), wide / 2) << class_name(line);
  }
}

TEST(Sheet, TagsStandAtTheirObjectsAndTouchNothing) {
  const Drawn d = drawn(with_frame(
      "arrangement=\"first-angle\"\n[[tag]]\nselect=\"*\"\ntext=\"{{name}} DN {{@DN}}\"\n"
      "[[tag]]\nselect=\"@MARK\"\ntext=\"{{@MARK}}\"\nstyle=\"plain\"\nviews=[\"top\"]\n"));
  const auto& tags = view_of(d.sheet, "top").tags;
  ASSERT_EQ(tags.texts.size(), 4U);
  EXPECT_EQ(tags.texts[0].text, "base DN 80");
  EXPECT_EQ(tags.texts[3].text, "B1");
  EXPECT_EQ(tags.paths.size(), 6U);  // a leader and its arrow, three times
  EXPECT_TRUE(reported(d.sheet, "tag-attribute-partly-missing", "1 object lacks some"));
  for (const PlacedView& view : d.sheet.views)
    for (std::size_t i = 0; i < view.tags.texts.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(box_of(view.tags.texts[i]).overlaps(box_of(view.tags.texts[k])));
  const Drawn none =
      drawn(with_frame("[[view]]\nname=\"v\"\n[[tag]]\nselect=\"far\"\ntext=\"{{@DN}}\"\n"));
  EXPECT_TRUE(reported(none.sheet, "tag-attribute-missing", "1 object has nothing"));
  const Drawn once =
      drawn(with_frame("[[view]]\nname=\"v\"\ndirection=\"top\"\n[[tag]]\nselect=\"*\"\ntext="
                       "\"PLATE\"\nonce=true\n"));
  ASSERT_EQ(once.sheet.views[0].tags.texts.size(), 1U);
  const Drawn unseen = drawn(with_frame(
      "[[view]]\nname=\"v\"\nselect=\"base\"\n[[tag]]\nselect=\"far\"\ntext=\"{{name}}\"\n"));
  EXPECT_TRUE(reported(unseen.sheet, "tag-not-seen", "'far'"));
}

TEST(Sheet, TagsCoverNoLineOfAnyViewAndTheirLeadersDoNotCross) {
  const Drawn d =
      drawn(with_frame("arrangement=\"first-angle\"\n[defaults]\nhidden=\"dashed\"\n"
                       "[[tag]]\nselect=\"*\"\ntext=\"{{name}} OF THE SHIP\"\n"
                       "[[tag]]\nselect=\"*\"\ntext=\"{{id}}\"\nstyle=\"plain\"\nviews=[\"top\"]\n"
                       "[grid]\nx=[[\"A\",0],[\"B\",\"2m\"]]\n"));
  EXPECT_FALSE(reported(d.sheet, "tag-no-room"));
  std::vector<PaperSegment> lines, leaders;
  for (const PlacedView& view : d.sheet.views) {
    for (const drawing::Line& line : view.ink.lines) lines.push_back({line.a_paper, line.b_paper});
    for (const Path& path : view.grid.paths)
      lines.push_back({path.points.front(), path.points.back()});
    for (const Path& path : view.tags.paths)
      if (!path.filled) leaders.push_back({path.points[0], path.points[1]});
  }
  EXPECT_GE(leaders.size(), 10U);
  for (const PlacedView& view : d.sheet.views)
    for (const Text& text : view.tags.texts)
      for (const PaperSegment& line : lines)
        EXPECT_FALSE(clipped(line, box_of(text))) << view.name << ": " << text.text;
  for (std::size_t i = 0; i < leaders.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(segments_cross(leaders[i], leaders[k]));
}

TEST(Sheet, TagsWithoutRoomAreCountedAndTheFirstIsNamed) {
  // Letters so high that one text alone has room beside the boxes, or none.
  const Drawn d = drawn(with_frame(
      "[sheet]\nsize=\"A4\"\n[[view]]\nname=\"v\"\ndirection=\"top\"\n[[tag]]\nselect=\"*\"\n"
      "text=\"THE OBJECT {{name}} OF ALL\"\nheight=\"20mm\"\n"));
  EXPECT_TRUE(d.sheet.views[0].tags.texts.empty());
  EXPECT_TRUE(reported(d.sheet, "tag-no-room",
                       "3 objects are without their tags, as 'THE OBJECT base OF ALL'"));
}

TEST(Sheet, GridLinesShowWhereTheViewLooksAlongThem) {
  const Drawn d =
      drawn(with_frame("arrangement=\"first-angle\"\n[sheet]\nscale=\"1:50\"\nsize=\"A1\"\n[grid]"
                       "\nx=[[\"A\",0],[\"B\",\"2m\"],"
                       "[\"Z\",\"99m\"]]\nz=[[\"BL\",0]]\n"));
  EXPECT_EQ(view_of(d.sheet, "front").grid.paths.size(), 3U);
  EXPECT_EQ(view_of(d.sheet, "top").grid.paths.size(), 2U);
  EXPECT_EQ(view_of(d.sheet, "left").grid.paths.size(), 1U);
  EXPECT_TRUE(view_of(d.sheet, "iso").grid.paths.empty());
  EXPECT_TRUE(reported(d.sheet, "grid-line-nowhere", "'Z'"));
  // 2 m are 40 mm, and front and top have them in one line.
  const auto& front = view_of(d.sheet, "front").grid.paths;
  const auto& top = view_of(d.sheet, "top").grid.paths;
  EXPECT_NEAR(front[1].points[0].x - front[0].points[0].x, 40, 1e-9);
  EXPECT_EQ(front[1].points[0].x, top[1].points[0].x);
}

TEST(Sheet, LabelsOfGridLinesThatStandCloseAreThinnedOut) {
  const Drawn d = drawn(with_frame(
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:100\"\nposition=[\"150mm\",\"100mm\"]\n"
      "[[grid.series]]\naxis=\"x\"\nlabel=\"{{n}}\"\nfirst=0\nlast=60\nat=\"0m\"\nspacing="
      "\"100mm\"\n"));
  const Marks& grid = d.sheet.views[0].grid;
  EXPECT_EQ(grid.paths.size(), 61U);
  EXPECT_TRUE(reported(d.sheet, "grid-label-no-room", "54 grid lines"));
  ASSERT_EQ(grid.texts.size(), 7U);
  EXPECT_EQ(grid.texts[1].text, "10");
}

TEST(Sheet, TheFrameOfASheetIsThatOfIso5457) {
  const Drawn d = drawn(with_frame("[[view]]\nname=\"v\"\n"));
  const Path& border = d.sheet.frame.paths.front();
  EXPECT_EQ(border.line, LineClass::frame);
  EXPECT_EQ(border.points[0], (PaperPoint{20, 10}));
  EXPECT_EQ(border.points[2], (PaperPoint{410, 287}));
}

TEST(Sheet, OneThreadAndManyGiveTheSameBytes) {
  const std::string text = with_frame(
      "[defaults]\nhidden=\"dashed\"\n[arrangement]\n[[tag]]\nselect=\"*\"\ntext=\"{{id}}\"\n"
      "[grid]\nx=[[\"A\",0]]\n");
  const std::string expected = drawn(text).svg;
  for (const unsigned workers : {2U, 3U, 8U, 64U}) {
    parallel::Team team(workers);
    const auto again = test::drawn(text, {}, {.team = &team});
    ASSERT_TRUE(again);
    EXPECT_EQ(again->svg, expected) << workers;
  }
}

TEST(SheetSvg, IsWellFormedWhateverTheNames) {
  const Drawn d = drawn(
      "arrangement=\"first-angle\"\n[fields]\ntitle = \"<&\\\"'>\\u0001\"\n"
      "[[tag]]\nselect=\"*\"\ntext=\"</text><script>{{name}}\"\n"
      "[grid]\nx=[[\"<A&\",0]]\n");
  EXPECT_EQ(d.svg.find("<script"), std::string::npos);
  EXPECT_EQ(count_of(d.svg, "<g "), count_of(d.svg, "</g>"));
  EXPECT_EQ(count_of(d.svg, "class=\"view\""), 4U);
  if (std::system("command -v xmllint >/dev/null 2>&1") != 0) GTEST_SKIP() << "no xmllint";
  FILE* const pipe = popen("xmllint --noout -", "w");
  ASSERT_NE(pipe, nullptr);
  std::fwrite(d.svg.data(), 1, d.svg.size(), pipe);
  EXPECT_EQ(pclose(pipe), 0);
}

}  // namespace
}  // namespace strake::sheets
