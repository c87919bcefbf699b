// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drawing/layout/paper_size.hpp"
#include "drawing/layout/view_plane.hpp"
#include "drawing/strokes/strokes.hpp"
#include "drawing/svg/svg_path.hpp"
#include "strake/drawing/view.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::State;

constexpr std::int64_t kMm = 1000;  // grid units

/// Two objects in one file; the name of the second is hostile.
model::Model two_objects() {
  model::Model model;
  model.files.emplace_back();
  model.files[0].label = "a.obj";
  for (const char* id : {"one", "two"}) {
    model::Object object;
    object.id = object.name = id;
    model.objects.push_back(object);
  }
  model.objects[1].name = "<\"&'>\x01\xE2\x80\xAE\xFF end";
  return model;
}

hlr::EdgePiece piece(std::uint32_t object, Vec3l a, Vec3l b, State state = State::visible,
                     EdgeKind kind = EdgeKind::sharp, std::uint32_t edge = 0) {
  const model::ObjectId own{object};
  return {own, edge, kind, state, own, a, b};
}

hlr::Drawing from_top(std::vector<hlr::EdgePiece> pieces) {
  hlr::Drawing drawing;
  drawing.view.direction = {0, 0, 1};
  drawing.view.up = {0, 1, 0};
  drawing.pieces = std::move(pieces);
  return drawing;
}

NeutralDrawing laid_out(const hlr::Drawing& drawing, const LayoutOptions& options = {}) {
  auto result = lay_out(drawing, two_objects(), options, {});
  EXPECT_TRUE(result) << result.error().text();
  return std::move(result).value();
}

std::string svg_of(const NeutralDrawing& drawing, bool hidden = true) {
  std::string text;
  const auto ink = choose_ink(drawing, {.hidden = hidden}, {});
  EXPECT_TRUE(ink);
  if (ink) write_svg(drawing, *ink, two_objects(), [&](std::string_view part) { text += part; });
  return text;
}

std::string json_of(const NeutralDrawing& drawing, const model::Model& model = two_objects()) {
  std::string text;
  EXPECT_TRUE(write_view_json(drawing, model, [&](std::string_view part) { text += part; }, {}));
  return text;
}

/// Exit status of a shell command fed with a text; -1 when the program is absent.
int run_on(const std::string& program, const std::string& command, const std::string& text) {
  if (std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) != 0) return -1;
  FILE* const pipe = popen(command.c_str(), "w");
  if (pipe == nullptr) return -1;
  std::fwrite(text.data(), 1, text.size(), pipe);
  return pclose(pipe);
}

std::size_t count_of(const std::string& text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// A 100 x 50 mm rectangle seen from above and a hidden diagonal of another object.
hlr::Drawing rectangle() {
  const Vec3l a{0, 0, 0}, b{100 * kMm, 0, 0}, c{100 * kMm, 50 * kMm, 0}, d{0, 50 * kMm, 0};
  return from_top({piece(0, a, b, State::visible, EdgeKind::contour, 0),
                   piece(0, b, c, State::visible, EdgeKind::contour, 1),
                   piece(0, c, d, State::visible, EdgeKind::contour, 2),
                   piece(0, d, a, State::visible, EdgeKind::contour, 3),
                   piece(1, a, c, State::hidden_by_other, EdgeKind::sharp, 4),
                   piece(1, a, {0, 0, 5 * kMm}, State::projecting, EdgeKind::sharp, 5)});
}

TEST(View, NamesAndDirections) {
  EXPECT_EQ(*direction_by_name("front"), Vec3l(0, -1, 0));
  EXPECT_EQ(*direction_by_name("iso"), Vec3l(1, -1, 1));
  EXPECT_EQ(direction_by_name("sideways").error().code, ErrorCode::usage);
  EXPECT_EQ(default_up({0, 0, -5}), Vec3l(0, 1, 0));
  EXPECT_EQ(default_up({1, -1, 1}), Vec3l(0, 0, 1));
  const auto whole = parse_direction(" 2, -4,+6");
  ASSERT_TRUE(whole) << whole.error().text();
  EXPECT_EQ(whole->vector, Vec3l(1, -2, 3));
  EXPECT_FALSE(whole->rounded);
  const auto decimal = parse_direction("0.5,-.25,1");
  ASSERT_TRUE(decimal) << decimal.error().text();
  EXPECT_EQ(decimal->vector, Vec3l(2, -1, 4));
  EXPECT_FALSE(decimal->rounded);
  const auto rounded = parse_direction("0.1234567891,1,1e300");
  ASSERT_TRUE(rounded) << rounded.error().text();
  EXPECT_EQ(rounded->vector, Vec3l(0, 0, 1));
  EXPECT_TRUE(rounded->rounded);
  const auto third = parse_direction("0.33333333333,1,1");
  ASSERT_TRUE(third) << third.error().text();
  EXPECT_TRUE(third->rounded);
  EXPECT_LT(third->rounding_error, 1e-6);
  for (const char* bad : {"", "1,2", "1,2,3,4", "0,0,0", "1,nan,2", "a,b,c", "1,,2"})
    EXPECT_FALSE(parse_direction(bad)) << bad;
}

TEST(Layout, ScalesAndSheets) {
  const NeutralDrawing small = laid_out(rectangle());
  EXPECT_EQ(small.sheet.scale_text, "2:1");
  EXPECT_EQ(small.sheet.width_mm, 420);
  // Centred: 200 wide on 420, 100 high on the 289 above the title.
  EXPECT_EQ(small.lines[0].a_paper, (PaperPoint{110, 194.5}));
  EXPECT_EQ(small.lines[1].b_paper, (PaperPoint{310, 94.5}));
  EXPECT_EQ(small.lines[0].b_mm, Vec3d(100, 0, 0));
  hlr::Drawing ship = rectangle();
  for (hlr::EdgePiece& p : ship.pieces) {
    p.a = p.a * 300;
    p.b = p.b * 300;
  }
  EXPECT_EQ(laid_out(ship).sheet.scale_text, "1:100");
  LayoutOptions stated;
  stated.scale = 50;
  const NeutralDrawing grown = laid_out(ship, stated);
  EXPECT_EQ(grown.sheet.scale_text, "1:50");
  EXPECT_EQ(grown.sheet.width_mm, 841);
  stated.scale = 2;
  EXPECT_EQ(laid_out(ship, stated).sheet.width_mm, 15020);
  stated.scale = 0.5;
  EXPECT_EQ(laid_out(rectangle(), stated).sheet.scale_text, "2:1");
  stated.scale = 200000;
  EXPECT_EQ(laid_out(rectangle(), stated).sheet.scale_text, "1:200000");
  stated.scale = 1.0 / 100000;
  EXPECT_EQ(laid_out(rectangle(), stated).sheet.scale_text, "100000:1");
  stated.scale = 0;
  EXPECT_FALSE(lay_out(ship, two_objects(), stated, {}));
  EXPECT_EQ(laid_out(from_top({})).sheet.scale_text, "1:1");
}

/// The rectangle of 100 x 50 mm, so many times as large.
hlr::Drawing rectangle_times(std::int64_t factor) {
  hlr::Drawing drawing = rectangle();
  for (hlr::EdgePiece& p : drawing.pieces) {
    p.a = p.a * factor;
    p.b = p.b * factor;
  }
  return drawing;
}

TEST(Layout, AnIntermediateScaleWhereHalfTheSheetWouldBeEmptyBothWays) {
  // A3 has 400 x 269 mm for the view, which at 1:5 shows 2000 x 1345 mm and at 1:2.5 half of it.
  const auto scale = [](std::int64_t factor) {
    return laid_out(rectangle_times(factor)).sheet.scale_text;
  };
  EXPECT_EQ(scale(8), "1:2");
  EXPECT_EQ(scale(9), "1:2.5");
  EXPECT_EQ(scale(10), "1:2.5");
  EXPECT_EQ(scale(11), "1:5");
  EXPECT_EQ(scale(20), "1:5");
  EXPECT_EQ(scale(21), "1:10");
  EXPECT_EQ(scale(100), "1:25");
  EXPECT_EQ(scale(10'000), "1:2500");
  EXPECT_EQ(intermediate_scale(5), 2.5);
  EXPECT_EQ(intermediate_scale(5e8), 2.5e8);
  for (const double none : {0.02, 0.05, 0.5, 1.0, 2.0, 10.0, 20.0, 1e9})
    EXPECT_EQ(intermediate_scale(none), std::nullopt) << none;
}

TEST(Layout, ThePaperDecidesTheScale) {
  const auto on = [](std::string_view paper, std::int64_t factor) {
    LayoutOptions options;
    options.paper = parse_paper(paper).value();
    return laid_out(rectangle_times(factor), options).sheet;
  };
  EXPECT_EQ(on("A3", 20).scale_text, laid_out(rectangle_times(20)).sheet.scale_text);
  EXPECT_EQ(on("A1", 8).scale_text, "1:1");  // 821 x 566 mm are for the view
  EXPECT_EQ(on("A1", 8).width_mm, 841);
  EXPECT_EQ(on("A1,portrait", 8).scale_text, "1:2");
  EXPECT_EQ(on("A1,portrait", 8).height_mm, 841);
  EXPECT_EQ(on("A4", 8).scale_text, "1:5");
  EXPECT_EQ(on("2000x500", 9).scale_text, "1:1");
  // In the middle of what is above the title.
  LayoutOptions options;
  options.paper = PaperSize{1000, 500};
  EXPECT_EQ(laid_out(rectangle(), options).lines[0].a_paper, (PaperPoint{250, 371}));
}

TEST(Layout, WhatDoesNotFitItsPaperIsAnError) {
  LayoutOptions options;
  options.paper = PaperSize{420, 297};
  options.scale = 2;
  EXPECT_EQ(laid_out(rectangle_times(8), options).sheet.scale_text, "1:2");
  options.scale = 1;
  const auto result = lay_out(rectangle_times(8), two_objects(), options, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::usage);
  EXPECT_EQ(
      result.error().message,
      "at 1:1 the view is 800 x 400 mm, and of the paper of 420 x 297 mm 400 x 269 mm are for "
      "it");
  EXPECT_EQ(result.error().mend, "give larger paper, or no larger scale than 1:2");
}

TEST(Layout, ASectionIsNamedWhereNoTitleIsGiven) {
  hlr::Drawing cut = rectangle();
  cut.view.sections = {{{0, 0, 1}, {0, 0, 4'500 * kMm}}};
  LayoutOptions options;
  options.view_name = "top";
  EXPECT_EQ(laid_out(cut, options).title, "SECTION z = 4.5 m");
  EXPECT_NE(svg_of(laid_out(cut, options)).find(">SECTION z = 4.5 m</text>"), std::string::npos);
  options.title = "DECK <1>";
  EXPECT_EQ(laid_out(cut, options).title, "DECK <1>");
  EXPECT_NE(svg_of(laid_out(cut, options)).find(">DECK &lt;1&gt;</text>"), std::string::npos);
}

TEST(Layout, APerspectiveHasAFrameWhereItEnds) {
  // 1 m before the plane: the field of view is 2 m wide there, 200 mm on paper.
  hlr::Drawing drawing = from_top({piece(0, {-1000 * kMm, 0, 0}, {200 * kMm, 100 * kMm, 0}),
                                   piece(1, {0, 0, 0}, {5000 * kMm, 0, 0}, State::clipped)});
  LayoutOptions options;
  options.scale = 10;
  EXPECT_FALSE(laid_out(drawing, options).frame);
  EXPECT_EQ(svg_of(laid_out(drawing, options)).find("view-frame"), std::string::npos);
  drawing.view.perspective = hlr::Perspective{{0, 0, 1000 * kMm}, {0, 0, 0}};
  const NeutralDrawing other_view = laid_out(drawing, options);
  ASSERT_TRUE(other_view.frame);
  EXPECT_EQ(other_view.lines[0].a_paper, (PaperPoint{150, 149.5}));
  // At the left the field ends; the other sides are beside the lines.
  EXPECT_EQ(other_view.frame->left, 150);
  EXPECT_EQ(other_view.frame->top, 136.5);
  EXPECT_EQ(other_view.frame->right, 273);
  EXPECT_EQ(other_view.frame->bottom, 152.5);
  EXPECT_NE(svg_of(other_view)
                .find("id=\"view-frame\" class=\"frame\">\n<path d=\"M150 136.5L273 136.5 "
                      "273 152.5 150 152.5Z\"/>"),
            std::string::npos);
  drawing.pieces.clear();
  EXPECT_FALSE(laid_out(drawing, options).frame);
}

/// A cylinder along x, so long.
model::Model pipe(double length_mm) {
  model::Model model;
  model.files.emplace_back();
  model.objects.emplace_back();
  model.objects[0].body_count = 1;
  model.shapes.emplace_back(geometry::CylinderPrimitive{50, length_mm});
  model.bodies.emplace_back();
  model.bodies[0].placement.linear = {{Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}};
  return model;
}

TEST(SagForPaper, RefusesASelectionOfTheWrongSize) {
  const model::Model model = pipe(1500);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const auto sag = sag_for_paper(*scene, {true, true}, {}, {}, {});
  ASSERT_FALSE(sag);
  EXPECT_EQ(sag.error().code, ErrorCode::usage);
}

TEST(SagForPaper, FollowsTheScale) {
  const model::Model model = pipe(1500);
  const auto scene = model::make_scene(model, {.sag_mm = 0.5}, {});
  ASSERT_TRUE(scene);
  const auto sag = [&](const hlr::View& view, const LayoutOptions& options = {},
                       const std::vector<bool>& drawn = {}) {
    return sag_for_paper(*scene, drawn, view, options, {}).value();
  };
  hlr::View top;
  top.direction = {0, 0, 1};
  top.up = {0, 1, 0};
  EXPECT_DOUBLE_EQ(sag(top), 0.05 * 5);
  LayoutOptions stated;
  stated.scale = 20;
  EXPECT_DOUBLE_EQ(sag(top, stated), 0.05 * 20);
  stated.placement = Placement{{420, 297, 0.5, "2:1"}, {}, {}};
  // No finer than on an A0 sheet that has all of it.
  EXPECT_DOUBLE_EQ(sag(top, stated), 1500.0 / 1189 / 20);
  // Only what is drawn and lies within the limits counts, and is not cut away.
  EXPECT_EQ(sag(top, {}, {false}), 0);
  hlr::View cut = top;
  cut.sections = {{{1, 0, 0}, {-700 * kMm, 0, 0}}};
  EXPECT_DOUBLE_EQ(sag(cut), 0.05 * 0.5);
  cut.sections = {{{-1, 0, 2}, {0, 0, -500 * kMm}}};
  EXPECT_EQ(sag(cut), 0);
  for (const std::int64_t z : {0, 500}) {
    cut.sections = {{{-1, 0, 2}, {0, 0, z * kMm}}};
    EXPECT_DOUBLE_EQ(sag(cut), 0.05 * 5);
  }
  cut.sections = {{{0, -1, 0}, {0, 60 * kMm, 0}}};
  EXPECT_EQ(sag(cut), 0);
  hlr::View end = top;
  end.limits = geometry::Box3l{{700 * kMm, -1000 * kMm, -1000 * kMm}, {900 * kMm, 0, 1000 * kMm}};
  EXPECT_DOUBLE_EQ(sag(end), 0.05 * 0.2);
  hlr::View along = top;
  along.direction = {1, 0, 0};
  along.up = {0, 0, 1};
  EXPECT_DOUBLE_EQ(sag(along), 0.05 * 0.5);
  // Twice as near as the plane of the target, and cut off by the field of view.
  hlr::View other_view = along;
  other_view.perspective = hlr::Perspective{{2000 * kMm, 0, 0}, {}, 100, 90};
  EXPECT_DOUBLE_EQ(sag(other_view), 0.05);
  other_view.perspective->field_of_view_deg = 2;
  EXPECT_DOUBLE_EQ(sag(other_view), 0.05 * 0.5);
}

/// What a drawing is made with stands in it.
TEST(SagForPaper, IsReportedInTheDrawing) {
  const model::Model model = pipe(1500);
  const auto scene = model::make_scene(model, {.sag_mm = 0.5}, {});
  ASSERT_TRUE(scene);
  for (const double sag : {0.0, 0.05, 2.0}) {
    const auto lines = hlr::draw(*scene, {}, {}, {.sag_mm = sag}, {});
    ASSERT_TRUE(lines);
    const auto sheet = lay_out(*lines, model, {}, {});
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->sag_mm, sag == 0.05 ? 0.05 : 0.5);
    const auto json = nlohmann::json::parse(json_of(*sheet, model));
    EXPECT_EQ(json["settings"]["sag_mm"], sheet->sag_mm);
  }
}

TEST(Layout, AMoveOfTheModelDoesNotMoveTheDrawing) {
  hlr::Drawing moved = rectangle();
  const Vec3l far{90'000'000'123, -290'000'000'456, 7};
  for (hlr::EdgePiece& p : moved.pieces) {
    p.a = p.a + far;
    p.b = p.b + far;
  }
  const NeutralDrawing here = laid_out(rectangle()), there = laid_out(moved);
  ASSERT_EQ(here.lines.size(), there.lines.size());
  for (std::size_t i = 0; i < here.lines.size(); ++i)
    EXPECT_EQ(here.lines[i].a_paper, there.lines[i].a_paper);
  EXPECT_NE(here.hash, there.hash);
}

TEST(Layout, UpParallelToTheDirectionIsAnError) {
  hlr::Drawing drawing = rectangle();
  drawing.view.up = {0, 0, 2};
  EXPECT_EQ(lay_out(drawing, two_objects(), {}, {}).error().code, ErrorCode::usage);
}

TEST(Duplicates, TheVisibleThenTheNearestStays) {
  const auto line = [](std::uint32_t object, std::int64_t x0, std::int64_t x1, std::int64_t z,
                       State state) {
    return piece(object, {x0 * kMm, 0, z * kMm}, {x1 * kMm, 0, z * kMm}, state);
  };
  // Far and long, near and short over its middle, hidden over its end.
  const NeutralDrawing out =
      laid_out(from_top({line(0, 0, 100, 0, State::visible), line(1, 40, 60, 5, State::visible),
                         line(1, 90, 120, 9, State::hidden_by_other)}));
  std::vector<std::pair<double, LineState>> got;
  for (const Line& l : out.lines) got.emplace_back(l.a_mm.x, l.state);
  const std::vector<std::pair<double, LineState>> expected = {
      {0, LineState::visible},  {40, LineState::duplicate}, {60, LineState::visible},
      {40, LineState::visible}, {90, LineState::duplicate}, {100, LineState::hidden_by_other}};
  EXPECT_EQ(got, expected);
  EXPECT_EQ(out.count[static_cast<std::size_t>(LineState::duplicate)], 2U);
}

TEST(Duplicates, LinesThatOnlyCrossTouchOrRunBesideEachOtherStay) {
  const NeutralDrawing out = laid_out(from_top(
      {piece(0, {0, 0, 0}, {100 * kMm, 0, 0}), piece(0, {100 * kMm, 0, 0}, {200 * kMm, 0, 0}),
       piece(1, {50 * kMm, -50 * kMm, 0}, {50 * kMm, 50 * kMm, 0}),
       piece(1, {0, 10, 0}, {100 * kMm, 10, 0}), piece(1, {0, 0, 0}, {100 * kMm, 100, 0})}));
  EXPECT_EQ(out.count[static_cast<std::size_t>(LineState::duplicate)], 0U);
  EXPECT_EQ(out.lines.size(), 5U);
}

TEST(Chains, JoinEndToEnd) {
  std::vector<Line> lines(4);
  const std::vector<PaperPoint> corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    lines[i].a_paper = corners[i];
    lines[i].b_paper = corners[(i + 1) % 4];
  }
  std::swap(lines[2].a_paper, lines[2].b_paper);
  std::vector<const Line*> all;
  for (const Line& line : lines) all.push_back(&line);
  const auto closed = join_lines(all);
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(closed[0].points.size(), 5U);
  EXPECT_EQ(closed[0].points.front(), closed[0].points.back());
  all.pop_back();
  std::swap(all[0], all[1]);
  const auto open = join_lines(all);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open[0].points.size(), 4U);
}

/// A regular polygon in an ellipse, whose edges from `first` on are chords of it.
std::string polygon_path(std::uint32_t corners, std::uint32_t first, const PaperCurve& curve) {
  std::vector<Line> lines(corners);
  PaperCurves curves{{curve}, {}};
  const auto at = [&](std::uint32_t k) {
    const double turn = 2 * std::acos(-1.0) * k / corners;
    const double x = std::cos(turn), y = std::sin(turn);
    const auto rounded = [](double mm) { return std::round(mm * 1000) / 1000; };
    return PaperPoint{rounded(curve.centre.x + curve.u.x * x + curve.v.x * y),
                      rounded(curve.centre.y + curve.u.y * x + curve.v.y * y)};
  };
  std::vector<const Line*> all;
  for (std::uint32_t k = 0; k < corners; ++k) {
    lines[k].edge = k;
    lines[k].a_paper = at(k);
    lines[k].b_paper = at((k + 1) % corners);
    if (k >= first) curves.edges.push_back({{}, k, 0});
    all.push_back(&lines[k]);
  }
  std::string path;
  for (const JoinedLines& chain : join_lines(all)) append_svg_path(path, stroke_of(chain, curves));
  return path;
}

TEST(Svg, ChordsOfACurveAreArcs) {
  const PaperCurve circle{{50, 50}, {40, 0}, {0, 40}};
  EXPECT_EQ(polygon_path(8, 0, circle),
            "M90 50A40 40 0 0 1 50 90A40 40 0 0 1 10 50A40 40 0 0 1 50 10A40 40 0 0 1 90 50Z");
  EXPECT_EQ(polygon_path(8, 8, circle).find('A'), std::string::npos);
  // Two straight edges and the rest of the ellipse.
  const std::string some = polygon_path(4, 2, {{50, 50}, {40, 0}, {0, 20}});
  EXPECT_EQ(some, "M90 50L50 70 10 50A40 20 0 0 1 50 30A40 20 0 0 1 90 50Z");
  // Seen edge-on it is a line.
  EXPECT_EQ(polygon_path(8, 0, {{50, 50}, {40, 0}, {1e-6, 0}}).find('A'), std::string::npos);
}

TEST(Svg, EllipsesNarrowerThanAPenAreStraightLines) {
  const auto has_arcs = [](double major, double minor) {
    return polygon_path(32, 0, {{50, 50}, {0, major}, {minor, 0}}).find('A') != std::string::npos;
  };
  for (const double major : {0.5, 4.0, 40.0}) {
    EXPECT_TRUE(has_arcs(major, 0.101)) << major;
    EXPECT_FALSE(has_arcs(major, 0.099)) << major;
  }
  // The flattest of all is as long as its corners are apart.
  EXPECT_EQ(polygon_path(4, 0, {{50, 50}, {40, 0}, {0, 0.05}}), "M90 50L50 50.05 10 50 50 49.95Z");
  // What is small and round stays a circle.
  EXPECT_TRUE(has_arcs(0.09, 0.09));
  EXPECT_TRUE(has_arcs(0.09, 0.03));
  EXPECT_FALSE(has_arcs(0.005, 0.005));
}

TEST(Svg, HoldsLayersGroupsAndPathsInMillimetres) {
  const std::string svg = svg_of(laid_out(rectangle()));
  EXPECT_NE(svg.find("width=\"420mm\" height=\"297mm\" viewBox=\"0 0 420 297\""),
            std::string::npos);
  EXPECT_NE(svg.find("id=\"visible-contour\" class=\"visible contour\""), std::string::npos);
  EXPECT_NE(svg.find("<g data-id=\"one\" data-name=\"one\" data-file=\"a.obj\">"
                     "<path d=\"M110 194.5L310 194.5 310 94.5 110 94.5Z\"/></g>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("M110 194.5L310 94.5\""), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const std::string visible_only = svg_of(laid_out(rectangle()), false);
  EXPECT_EQ(visible_only.find("class=\"hidden"), std::string::npos);
  EXPECT_EQ(count_of(visible_only, "<path"), 2U) << "the outline and the title's line";
}

TEST(Svg, NamesCannotEscape) {
  EXPECT_EQ(xml_escaped("<\"&'>\x01\xE2\x80\xAE\xFF end"),
            "&lt;&quot;&amp;&#39;&gt;\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD end");
  EXPECT_EQ(xml_escaped("R\xC3\xB8r \xE6\xBC\xA2 \xF0\x9F\x9A\xA2"),
            "R\xC3\xB8r \xE6\xBC\xA2 \xF0\x9F\x9A\xA2");
  EXPECT_EQ(xml_escaped("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(json_quoted("a\"\\\n\xFF"), "\"a\\\"\\\\\\n\xEF\xBF\xBD\"");
}

TEST(Svg, IsWellFormedAndRenders) {
  const std::string svg = svg_of(laid_out(rectangle()));
  const int xml = run_on("xmllint", "xmllint --noout - 2>/dev/null", svg);
  const int picture = run_on("rsvg-convert", "rsvg-convert -f png >/dev/null 2>&1", svg);
  if (xml == -1 && picture == -1) GTEST_SKIP() << "neither xmllint nor rsvg-convert is here";
  EXPECT_LE(xml, 0);
  EXPECT_LE(picture, 0);
}

TEST(ViewJson, StatesWhatTheDrawingHolds) {
  LayoutOptions options;
  options.view_name = "top";
  const NeutralDrawing drawing = laid_out(rectangle(), options);
  const auto json = nlohmann::json::parse(json_of(drawing));
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["view"]["name"], "top");
  EXPECT_EQ(json["view"]["direction"], nlohmann::json({0, 0, 1}));
  EXPECT_TRUE(json["view"]["limits_mm"].is_null());
  EXPECT_EQ(json["counts"]["pieces"], 6);
  EXPECT_EQ(json["counts"]["visible"], 4);
  EXPECT_EQ(json["counts"]["hidden_by_other"], 1);
  EXPECT_EQ(json["counts"]["projecting"], 1);
  EXPECT_EQ(json["hash"], drawing.hash.text());
  ASSERT_EQ(json["objects"].size(), 2U);
  const auto& first = json["pieces"][0];
  EXPECT_EQ(first["object"], "one");
  EXPECT_EQ(first["kind"], "contour");
  EXPECT_EQ(first["state"], "visible");
  EXPECT_EQ(first["b_mm"], nlohmann::json({100.0, 0.0, 0.0}));
  EXPECT_EQ(first["a_paper_mm"], nlohmann::json({110.0, 194.5}));
  EXPECT_EQ(json["pieces"][4]["object_index"], 1);
}

TEST(ViewJson, ChordsNameTheirCurve) {
  NeutralDrawing drawing = laid_out(rectangle());
  drawing.curves.all = {{{10, 20}, {4, 0}, {0, 4}}, {{50, 50}, {40, 0}, {0, 40.5}}};
  drawing.curves.edges = {{drawing.lines[1].object, drawing.lines[1].edge, 1}};
  const auto json = nlohmann::json::parse(json_of(drawing));
  ASSERT_EQ(json["curves"].size(), 2U);
  EXPECT_EQ(json["curves"][1]["centre_paper_mm"], nlohmann::json({50.0, 50.0}));
  EXPECT_EQ(json["curves"][1]["v_paper_mm"], nlohmann::json({0.0, 40.5}));
  for (const auto& piece : json["pieces"]) {
    const bool chord = piece["object_index"] == 0 && piece["edge"] == drawing.lines[1].edge;
    EXPECT_EQ(piece.contains("curve_index"), chord);
    if (chord) {
      EXPECT_EQ(piece["curve_index"], 1);
    }
  }
}

TEST(ViewJson, FollowsItsSchema) {
  hlr::Drawing limited = rectangle();
  limited.view.limits = geometry::Box3l{{0, 0, 0}, {1, 2, 3}};
  const std::string schema = STRAKE_SOURCE_DIR "/schemas/view.schema.json";
  const std::string check =
      "python3 -c \"import json,sys,jsonschema;"
      "jsonschema.validate(json.load(sys.stdin),json.load(open('" +
      schema + "')))\" 2>/dev/null";
  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-jsonschema is not here";
  EXPECT_EQ(run_on("python3", check, json_of(laid_out(rectangle()))), 0);
  EXPECT_EQ(run_on("python3", check, json_of(laid_out(limited))), 0);
  EXPECT_EQ(run_on("python3", check, json_of(laid_out(from_top({})))), 0);
  EXPECT_NE(run_on("python3", check, "{}"), 0) << "the schema accepts anything";
}

/// Wherever the text ends that a sink takes: the exception comes out, and the process goes on.
TEST(Drawing, WhatASinkThrowsComesOut) {
  struct Full {};
  const NeutralDrawing drawing = laid_out(from_top({piece(0, {0, 0, 0}, {100 * kMm, 0, 0})}));
  const model::Model model = two_objects();
  const auto ink = choose_ink(drawing, {}, {});
  ASSERT_TRUE(ink);
  const auto full = [](std::string_view) { throw Full(); };
  EXPECT_THROW(write_svg(drawing, *ink, model, full), Full);
  EXPECT_THROW((void)write_view_json(drawing, model, full, {}), Full);
  EXPECT_THROW((void)write_view_rows(drawing, model, full, {}), Full);
}

}  // namespace
}  // namespace strake::drawing
