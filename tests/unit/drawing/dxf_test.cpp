// SPDX-License-Identifier: Apache-2.0
// The encoder of DXF: values, handles and owners, entities in their places.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

using Group = std::pair<int, std::string>;

/// A record of a file: its type, and the groups behind it.
struct Record {
  std::string type;
  std::vector<Group> groups;

  [[nodiscard]] std::string of(int code) const {
    const auto found = std::ranges::find(groups, code, &Group::first);
    return found == groups.end() ? "" : found->second;
  }
  [[nodiscard]] double number(int code) const { return std::stod(of(code)); }
};

std::vector<Record> records_of(const std::string& text) {
  std::vector<Record> records;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t middle = text.find('\n', at), end = text.find('\n', middle + 1);
    const int code = std::stoi(text.substr(at, middle - at));
    std::string value = text.substr(middle + 1, end - middle - 1);
    if (code == 0)
      records.push_back({std::move(value), {}});
    else
      records.back().groups.emplace_back(code, std::move(value));
    at = end + 1;
  }
  return records;
}

std::vector<Record> of_type(const std::vector<Record>& records, const std::string& type) {
  std::vector<Record> found;
  std::ranges::copy_if(records, std::back_inserter(found),
                       [&](const Record& record) { return record.type == type; });
  return found;
}

/// A view from above at 1:10 on a sheet of 420 x 297 whose lower left corner is the model's origin.
struct Drawn {
  NeutralDrawing drawing;
  Ink ink;
  model::Model model;

  Drawn() {
    drawing.view.direction = {0, 0, 1};
    drawing.view.up = {0, 1, 0};
    drawing.sheet.scale = 10;
    drawing.sheet.scale_text = "1:10";
    model.files.emplace_back();
    model.files[0].label = "a.obj";
    for (const char* id : {"one", "two"}) {
      model::Object object;
      object.id = object.name = id;
      model.objects.push_back(object);
    }
  }

  static PaperPoint on_paper(double x, double y) {
    return {std::round(x * 100) / 1000, std::round(2970000 - y * 1000) / 10000};
  }

  Line& add(double ax, double ay, double bx, double by) {
    Line line;
    line.edge = static_cast<std::uint32_t>(ink.lines.size());
    line.a_mm = {ax, ay, 7};
    line.b_mm = {bx, by, 7};
    line.a_paper = on_paper(ax, ay);
    line.b_paper = on_paper(bx, by);
    ink.lines.push_back(line);
    return ink.lines.back();
  }

  /// Adds chords of an ellipse about (cx, cy), from one of its parameters to another.
  void add_arc(double cx, double cy, double rx, double ry, double from, double to, int chords) {
    const auto curve = static_cast<std::uint32_t>(drawing.curves.all.size());
    drawing.curves.all.push_back({{cx / 10, 297 - cy / 10}, {rx / 10, 0}, {0, -ry / 10}});
    const auto at = [&](int k) {
      const double t = from + (to - from) * k / chords;
      const auto um = [](double mm) { return std::round(mm * 1000) / 1000; };
      return std::pair(um(cx + rx * std::cos(t)), um(cy + ry * std::sin(t)));
    };
    for (int k = 0; k < chords; ++k) {
      const auto [ax, ay] = at(k);
      const auto [bx, by] = at(k + 1);
      const Line& line = add(ax, ay, bx, by);
      drawing.curves.edges.push_back({line.object, line.edge, curve});
    }
  }

  [[nodiscard]] std::string text(unsigned threads = 1) const {
    std::string out;
    parallel::Team team(threads);
    const parallel::Context context{.team = &team};
    const Status status =
        write_dxf(drawing, ink, model, [&](std::string_view part) { out += part; }, context);
    EXPECT_TRUE(status);
    return out;
  }
};

constexpr double kTurn = 2 * std::numbers::pi;

TEST(DxfValues, StayOnOneLineAndShowThemselves) {
  const auto value = [](std::string_view text) { return dxf::value_text(text, dxf::kMaxOfData); };
  EXPECT_EQ(value("PIPE-1 R\xC3\xB8r"), "PIPE-1 R\xC3\xB8r");
  EXPECT_EQ(value("a\nb\r\n0\nLINE"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD\xEF\xBF\xBD"
            "0\xEF\xBF\xBDLINE");
  EXPECT_EQ(value("\xE2\x80\xAE|\xE2\x80\xA8|\xFF"), "\xEF\xBF\xBD|\xEF\xBF\xBD|\xEF\xBF\xBD");
  EXPECT_EQ(value("^J^ "), "^ J^  ");
  EXPECT_EQ(value("\\U+202E \\M+1 \\P C:\\a"), "\\U+005CU+202E \\U+005CM+1 \\P C:\\a");
  EXPECT_EQ(value("100%%d"), "100%%d") << "only TEXT has such commands";
  EXPECT_EQ(dxf::shown_text("50% %%d 7%%"), "50% %%%%%%d 7%%%%%%");
}

TEST(DxfValues, AreCutBetweenCharacters) {
  const std::string of_255 = std::string(255, 'a'), long_name = std::string(10000, 'b');
  EXPECT_EQ(dxf::value_text(of_255, 255), of_255);
  EXPECT_EQ(dxf::value_text(of_255 + "a", 255), std::string(252, 'a') + "\xE2\x80\xA6");
  std::string wide;
  for (int i = 0; i < 200; ++i) wide += "\xE6\xBC\xA2";
  EXPECT_EQ(dxf::value_text(wide, 254), wide.substr(0, 249) + "\xE2\x80\xA6");
  EXPECT_EQ(dxf::shown_text(long_name).size(), dxf::kMaxOfText);
}

TEST(DxfLayers, HavePensAndColoursThatTheFormatKnows) {
  EXPECT_EQ(dxf::line_weight(0.5), 50);
  EXPECT_EQ(dxf::line_weight(0.18), 18);
  EXPECT_EQ(dxf::line_weight(0.72), 70);
  EXPECT_EQ(dxf::line_weight(9), 211);
  EXPECT_EQ(dxf::color_number({0, 0, 0, 255}), 7);
  EXPECT_EQ(dxf::color_number({250, 10, 0, 255}), 1);
  EXPECT_EQ(dxf::color_number({255, 255, 255, 255}), 255);
}

TEST(Dxf, EveryHandleIsItsOwnAndEveryOwnerIsThere) {
  Drawn drawn;
  drawn.add(0, 0, 100, 0);
  drawn.add(0, 50, 100, 50).state = LineState::hidden_by_self;
  drawn.add_arc(500, 500, 40, 40, 0, kTurn, 24);
  std::set<std::string> handles;
  std::vector<std::string> owners;
  std::string seed;
  std::uint64_t largest = 0;
  for (const Record& record : records_of(drawn.text())) {
    if (record.type == "SECTION" && record.of(2) == "HEADER") {
      for (std::size_t i = 0; i < record.groups.size(); ++i)
        if (record.groups[i] == Group(9, "$HANDSEED")) seed = record.groups[i + 1].second;
      continue;
    }
    if (record.type == "SECTION" || record.type == "CLASS") continue;
    const std::string handle = record.of(record.type == "DIMSTYLE" ? 105 : 5);
    if (handle.empty()) continue;
    EXPECT_TRUE(handles.insert(handle).second) << record.type << ' ' << handle;
    largest = std::max(largest, static_cast<std::uint64_t>(std::stoull(handle, nullptr, 16)));
    for (const auto& [code, value] : record.groups)
      if (code == 330 || code == 340 || code == 350 || code == 390) owners.push_back(value);
  }
  ASSERT_FALSE(seed.empty());
  EXPECT_GT(std::stoull(seed, nullptr, 16), largest);
  for (const std::string& owner : owners)
    EXPECT_TRUE(owner == "0" || handles.contains(owner)) << owner;
}

TEST(Dxf, JoinsLinesAtTrueSizeAndKeepsWhoseTheyAre) {
  Drawn drawn;
  drawn.add(0, 0, 1000.001, 0);
  drawn.add(1000.001, 0, 1000.001, 0.125);
  drawn.add(2000, 0, 2000, 3);
  drawn.ink.lines[2].object = model::ObjectId{1};
  drawn.model.objects[1].name = "two\n0\nLINE";
  const std::vector<Record> records = records_of(drawn.text());
  const auto joined = of_type(records, "LWPOLYLINE"), lines = of_type(records, "LINE");
  ASSERT_EQ(joined.size(), 1U);
  ASSERT_EQ(lines.size(), 2U) << "one of the model and one above the title";
  std::vector<std::string> points;
  for (const auto& [code, value] : joined[0].groups)
    if (code == 10 || code == 20) points.push_back(value);
  EXPECT_EQ(points, (std::vector<std::string>{"0", "0", "1000.001", "0", "1000.001", "0.125"}));
  EXPECT_EQ(joined[0].of(8), "AM_0_EDGE");
  EXPECT_EQ(joined[0].of(1001), "STRAKE");
  std::vector<std::string> data;
  for (const auto& [code, value] : lines[0].groups)
    if (code == 1000) data.push_back(value);
  EXPECT_EQ(data, (std::vector<std::string>{"two",
                                            "two\xEF\xBF\xBD"
                                            "0\xEF\xBF\xBDLINE",
                                            "a.obj"}));
}

TEST(Dxf, ChordsOfACurveAreTheCurve) {
  Drawn drawn;
  drawn.add_arc(500, 300, 40, 40, 0, kTurn, 24);
  drawn.add_arc(900, 300, 80, 20, 0, kTurn, 24);
  const std::vector<Record> records = records_of(drawn.text());
  const auto circles = of_type(records, "CIRCLE"), ellipses = of_type(records, "ELLIPSE");
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_NEAR(circles[0].number(10), 500, 1e-3);
  EXPECT_NEAR(circles[0].number(20), 300, 1e-3);
  EXPECT_DOUBLE_EQ(circles[0].number(40), 40);
  ASSERT_EQ(ellipses.size(), 1U);
  EXPECT_NEAR(std::fabs(ellipses[0].number(11)), 80, 1e-6);
  EXPECT_DOUBLE_EQ(ellipses[0].number(40), 0.25);
  EXPECT_DOUBLE_EQ(ellipses[0].number(42) - ellipses[0].number(41), kTurn);
}

/// An arc goes against the clock whichever way its chords do, and chords of a circle that are less
/// than a thousandth of a millimetre long do not become a full turn.
TEST(Dxf, ArcsGoAgainstTheClock) {
  for (const bool backwards : {false, true}) {
    Drawn drawn;
    if (backwards)
      drawn.add_arc(500, 300, 40, 40, kTurn / 4, -kTurn / 8, 9);
    else
      drawn.add_arc(500, 300, 40, 40, -kTurn / 8, kTurn / 4, 9);
    const auto arcs = of_type(records_of(drawn.text()), "ARC");
    ASSERT_EQ(arcs.size(), 1U);
    EXPECT_NEAR(arcs[0].number(50), 315, 0.01);
    EXPECT_NEAR(arcs[0].number(51), 90, 0.01);
  }
  Drawn tiny;
  tiny.add_arc(500, 300, 40, 40, 1, 1 + 5e-5, 1);
  const std::vector<Record> records = records_of(tiny.text());
  EXPECT_TRUE(of_type(records, "ARC").empty());
  EXPECT_TRUE(of_type(records, "CIRCLE").empty());
  EXPECT_EQ(of_type(records, "LINE").size(), 2U);
}

TEST(Dxf, EllipticalArcsEndWhereTheirChordsDo) {
  for (const auto& [from, to] : {std::pair(0.3, 2.9), std::pair(2.9, 0.3), std::pair(-1.0, 1.2)}) {
    Drawn drawn;
    drawn.add_arc(900, 300, 20, 80, from, to, 30);
    const auto arcs = of_type(records_of(drawn.text()), "ELLIPSE");
    ASSERT_EQ(arcs.size(), 1U);
    const Record& arc = arcs[0];
    const auto end = [&](int code) {
      const double t = arc.number(code), mx = arc.number(11), my = arc.number(21),
                   ratio = arc.number(40);
      return std::pair(arc.number(10) + mx * std::cos(t) - my * ratio * std::sin(t),
                       arc.number(20) + my * std::cos(t) + mx * ratio * std::sin(t));
    };
    std::set<std::pair<long, long>> ends, expected;
    for (const int code : {41, 42})
      ends.emplace(std::lround(end(code).first * 10), std::lround(end(code).second * 10));
    for (const double t : {from, to})
      expected.emplace(std::lround((900 + 20 * std::cos(t)) * 10),
                       std::lround((300 + 80 * std::sin(t)) * 10));
    EXPECT_EQ(ends, expected);
  }
}

TEST(Dxf, HiddenLinesLieOnALayerByWhatHidesThem) {
  Drawn drawn;
  drawn.add(0, 0, 100, 0).state = LineState::hidden_by_self;
  drawn.add(0, 50, 100, 50).state = LineState::hidden_by_other;
  const std::vector<Record> records = records_of(drawn.text());
  std::map<std::string, std::string> line_type;
  for (const Record& layer : of_type(records, "LAYER")) line_type[layer.of(2)] = layer.of(6);
  const auto lines = of_type(records, "LINE");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].of(8), "AM_3");
  EXPECT_EQ(lines[1].of(8), "AM_3_SELF");
  EXPECT_EQ(line_type["AM_3"], line_type["AM_3_SELF"]);
  EXPECT_NE(line_type["AM_3"], "Continuous");
  EXPECT_EQ(line_type["AM_0"], "Continuous");
  const auto types = of_type(records, "LTYPE");
  EXPECT_TRUE(std::ranges::any_of(
      types, [&](const Record& type) { return type.of(2) == line_type["AM_3"]; }));
}

/// At 1:10, dashes are fitted to a tenth of the length at true size.
TEST(Dxf, DashesFitLinesAsLongAsTheyAreOnPaper) {
  Drawn drawn;
  for (const double length : {107.0, 10.0})
    drawn.add(0, length, length, length).state = LineState::hidden_by_other;
  drawn.add_arc(500, 500, 40, 40, 0, kTurn, 24);
  for (Line& line : drawn.ink.lines) line.state = LineState::hidden_by_other;
  const std::vector<Record> records = records_of(drawn.text());
  const auto lines = of_type(records, "LINE"), circles = of_type(records, "CIRCLE");
  ASSERT_EQ(lines.size(), 3U);
  ASSERT_EQ(circles.size(), 1U);
  const std::vector<double> dash = pen_dashes(kHiddenDashes, drawn.ink.pens.thin);
  ASSERT_NE(fitted_stretch(10.7, DashEnds::open, dash), 1);
  EXPECT_DOUBLE_EQ(lines[0].number(48), fitted_stretch(10.7, DashEnds::open, dash));
  EXPECT_EQ(lines[0].of(6), "") << "that of the layer";
  EXPECT_EQ(lines[1].of(6), "Continuous") << "too short for a gap";
  EXPECT_EQ(lines[1].of(48), "");
  EXPECT_EQ(lines[2].of(48) + lines[2].of(6), "") << "the line above the title";
  EXPECT_DOUBLE_EQ(circles[0].number(48), fitted_stretch(4 * kTurn, DashEnds::closed, dash));
}

TEST(Dxf, CentreLinesLieAtTrueSizeWithinTheirWindow) {
  Drawn drawn;
  drawn.add(1000, 500, 1400, 500);
  drawn.ink.centre_lines.push_back(
      {model::ObjectId{1}, {Drawn::on_paper(700, 600), Drawn::on_paper(1700, 600)}, true});
  drawn.ink.centre_lines.push_back(
      {model::ObjectId{0},
       {Drawn::on_paper(700, 600), Drawn::on_paper(900, 700), Drawn::on_paper(1000, 900)},
       false});
  const std::vector<Record> records = records_of(drawn.text());
  const auto lines = of_type(records, "LINE"), bent = of_type(records, "LWPOLYLINE");
  ASSERT_EQ(lines.size(), 3U);
  const Record& line = lines[1];
  EXPECT_EQ(line.of(8), "AM_7");
  EXPECT_EQ(line.of(1000), "two");
  EXPECT_EQ(line.of(10) + ' ' + line.of(20) + ' ' + line.of(11), "700 600 1700");
  const std::vector<double> dash = pen_dashes(kCentreDashes, drawn.ink.pens.thin);
  EXPECT_DOUBLE_EQ(line.number(48), fitted_stretch(100, DashEnds::centred, dash));
  ASSERT_EQ(bent.size(), 1U);
  EXPECT_EQ(bent[0].of(8), "AM_7");
  const auto layers = of_type(records, "LAYER");
  const auto layer = std::ranges::find(layers, "AM_7", [](const Record& r) { return r.of(2); });
  ASSERT_NE(layer, layers.end());
  EXPECT_EQ(layer->of(6), "CENTER_AM_7");
  const auto viewports = of_type(records, "VIEWPORT");
  ASSERT_EQ(viewports.size(), 2U);
  EXPECT_LE(viewports[1].number(10) - viewports[1].number(40) / 2, 70);
  EXPECT_GE(viewports[1].number(10) + viewports[1].number(40) / 2, 170);
}

TEST(Dxf, AViewportShowsTheViewAtItsScale) {
  Drawn drawn;
  drawn.add(1000, 500, 3000, 1500);
  const auto viewports = of_type(records_of(drawn.text()), "VIEWPORT");
  ASSERT_EQ(viewports.size(), 2U);
  const Record& view = viewports[1];
  EXPECT_NEAR(view.number(45) / view.number(41), 10, 1e-12);
  // The middle of the window, mm from the lower left corner, shows that point of the model.
  EXPECT_NEAR(view.number(12), view.number(10) * 10, 1e-3);
  EXPECT_NEAR(view.number(22), view.number(20) * 10, 1e-3);
  EXPECT_LE(view.number(10) - view.number(40) / 2, 100);
  EXPECT_GE(view.number(10) + view.number(40) / 2, 300);
}

TEST(Dxf, IsTheSameForAnyTeam) {
  Drawn drawn;
  for (int i = 0; i < 20000; ++i) {
    Line& line = drawn.add(i, 0, i + 0.5, 10);
    line.object = model::ObjectId{static_cast<std::uint32_t>(i / 2)};
    if (i % 3 == 0) line.state = LineState::hidden_by_other;
  }
  drawn.model.objects.resize(10000, drawn.model.objects[0]);
  const std::string expected = drawn.text(1);
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(drawn.text(threads), expected) << threads;
}

TEST(Dxf, ADrawingOfNothingIsAFile) {
  const std::vector<Record> records = records_of(Drawn().text());
  EXPECT_EQ(records.back().type, "EOF");
  EXPECT_EQ(of_type(records, "VIEWPORT").size(), 1U);
}

}  // namespace
}  // namespace strake::drawing
