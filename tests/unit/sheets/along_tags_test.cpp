// SPDX-License-Identifier: Apache-2.0
// Tags along pipes: where they stand, how they are read, and what they cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sheets/labels/paper/line_bins.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "support/draw.hpp"
#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

using geometry::Vec3d;

struct Pipe {
  std::string name;
  Vec3d from, to;
  double radius = 50;
};

/// A model of exact cylinders.
model::Model pipes(const std::vector<Pipe>& all) {
  model::Model m;
  m.files.emplace_back();
  for (const Pipe& pipe : all) {
    const Vec3d way = pipe.to - pipe.from;
    const double length = std::sqrt(dot(way, way));
    const Vec3d w = way * (1 / length);
    const Vec3d aside = std::fabs(w.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
    Vec3d u = cross(aside, w);
    u = u * (1 / std::sqrt(dot(u, u)));
    const Vec3d v = cross(w, u);
    model::Object object;
    object.name = object.id = pipe.name;
    object.first_body = static_cast<std::uint32_t>(m.bodies.size());
    object.body_count = 1;
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(m.shapes.size())};
    body.placement.linear.row = {{{u.x, v.x, w.x}, {u.y, v.y, w.y}, {u.z, v.z, w.z}}};
    body.placement.translation = (pipe.from + pipe.to) * 0.5;
    m.shapes.emplace_back(geometry::CylinderPrimitive{pipe.radius, length});
    m.bodies.push_back(body);
    m.objects.push_back(std::move(object));
  }
  return m;
}

Sheet sheet_of(const model::Model& model, const std::string& more = {},
               const std::string& text = "{{name}}") {
  const auto scene = model::make_scene(model, {.sag_mm = 0.5}, {}).value();
  const auto sheet = test::sheet_file(
                         "[sheet]\nsize=\"A2\"\n[[view]]\nname=\"v\"\ndirection=\"front\"\n"
                         "scale=\"1:50\"\nposition=[\"250mm\",\"180mm\"]\n" +
                         more + "[[tag]]\nselect=\"*\"\nstyle=\"along\"\ntext=\"" + text + "\"\n")
                         .value()
                         .compose(scene, {}, {});
  EXPECT_TRUE(sheet) << sheet.error().text();
  return sheet ? *sheet : Sheet{};
}

/// How far the base line of a text stands above the middle of a view, which looks along y, across
/// the way in which it is read.
double above_middle(const PlacedView& view, const Text& text) {
  const double x = text.at.x - (view.box.left + view.box.right) / 2,
               y = text.at.y - (view.box.top + view.box.bottom) / 2;
  const double turn = text.turn_deg / 180 * 3.14159265358979323846;
  return -x * std::sin(turn) - y * std::cos(turn);
}

/// Whether a line of a view runs within the clearance of a text.
bool covers_lines(const PlacedView& view, const Text& text) {
  LineBins bins(594, 420);
  for (const drawing::Line& line : view.ink.lines) bins.add({line.a_paper, line.b_paper});
  for (const drawing::CentreLine& line : view.ink.centre_lines)
    bins.add({line.points.front(), line.points.back()});
  const auto corners = corners_of(text);
  const double turn = text.turn_deg / 180 * 3.14159265358979323846;
  return bins.any_in({{(corners[0].x + corners[2].x) / 2, (corners[0].y + corners[2].y) / 2},
                      {std::cos(turn), -std::sin(turn)},
                      text_width(text.text) * text.height_mm / 2 + 0.69,
                      text.height_mm * 0.625 + 0.69});
}

TEST(AlongTags, StandAboveTheMiddleOfAPipe) {
  const Sheet sheet = sheet_of(pipes({{"10-P-1001", {0, 0, 0}, {6000, 0, 0}}}));
  const PlacedView& view = sheet.views[0];
  ASSERT_EQ(view.tags.texts.size(), 1U);
  const Text& text = view.tags.texts[0];
  EXPECT_EQ(text.text, "10-P-1001");
  EXPECT_EQ(text.turn_deg, 0);
  EXPECT_TRUE(view.tags.paths.empty());
  EXPECT_NEAR(text.at.x, (view.box.left + view.box.right) / 2, 0.01);
  // 100 mm are 2 mm on paper; the letters stand off the outline, but near to it.
  EXPECT_GT(above_middle(view, text), 1);
  EXPECT_LT(above_middle(view, text), 1 + 2.5);
  EXPECT_FALSE(covers_lines(view, text));
  EXPECT_TRUE(sheet.diagnostics.counts().empty() || sheet.diagnostics.count("tag-not-along") == 0U);
}

TEST(AlongTags, AreReadFromBelowOrFromTheRight) {
  struct Case {
    Vec3d to;
    double turn;
  };
  for (const auto& [to, turn] :
       {Case{{0, 0, 6000}, 90}, Case{{0, 0, -6000}, 90}, Case{{-6000, 0, 0}, 0},
        Case{{5000, 0, 5000}, 45}, Case{{-5000, 0, 5000}, -45}, Case{{-5000, 0, -5000}, 45}}) {
    const Sheet sheet = sheet_of(pipes({{"10-P-1001", {0, 0, 0}, to}}));
    ASSERT_EQ(sheet.views[0].tags.texts.size(), 1U) << turn;
    const Text& text = sheet.views[0].tags.texts[0];
    EXPECT_NEAR(text.turn_deg, turn, 1e-6);
    EXPECT_GT(above_middle(sheet.views[0], text), 1) << turn;
    EXPECT_LT(above_middle(sheet.views[0], text), 3.5) << turn;
    EXPECT_FALSE(covers_lines(sheet.views[0], text)) << turn;
  }
}

TEST(AlongTags, StandInPipesThatHaveRoomForThem) {
  const auto above = [](double radius, const std::string& more) {
    const Sheet sheet = sheet_of(pipes({{"P-1", {0, 0, 0}, {6000, 0, 0}, radius}}), more);
    const PlacedView& view = sheet.views[0];
    EXPECT_EQ(view.tags.texts.size(), 1U);
    EXPECT_FALSE(covers_lines(view, view.tags.texts[0]));
    return above_middle(view, view.tags.texts[0]);
  };
  const std::string centre = "centre_lines=\"on\"\n";
  EXPECT_NEAR(above(150, ""), -1.25, 0.01) << "in the middle of 6 mm";
  EXPECT_GT(above(150, centre), 3) << "a centre line leaves no room in 6 mm";
  EXPECT_NEAR(above(300, centre), 1.4, 0.1) << "above the centre line in 12 mm";
}

TEST(AlongTags, StandAboveSingleLines) {
  const Sheet sheet =
      sheet_of(pipes({{"P-1", {0, 0, 0}, {6000, 0, 0}}}), "single_line=\"DN150\"\n");
  ASSERT_EQ(sheet.views[0].tags.texts.size(), 1U);
  EXPECT_NEAR(above_middle(sheet.views[0], sheet.views[0].tags.texts[0]), 1.4, 0.1);
}

TEST(AlongTags, ThatAreTooLongHaveLeadersAndAreReported) {
  const model::Model model = pipes({{"P-1", {0, 0, 0}, {400, 0, 0}}});
  const Sheet sheet = sheet_of(model, {}, "THE PIPE {{name}}");
  ASSERT_EQ(sheet.views[0].tags.texts.size(), 1U);
  EXPECT_EQ(sheet.views[0].tags.texts[0].turn_deg, 0);
  EXPECT_EQ(sheet.views[0].tags.paths.size(), 2U);
  const auto& kept = sheet.diagnostics.kept();
  const auto reported = std::ranges::find(kept, "tag-not-along", &Diagnostic::code);
  ASSERT_NE(reported, kept.end());
  EXPECT_EQ(reported->severity, Severity::note);
  EXPECT_NE(reported->message.find("1 object has its tag 'THE PIPE P-1' at a leader"),
            std::string::npos);
  EXPECT_NE(reported->where.find("the view 'v'"), std::string::npos);
}

TEST(AlongTags, StandWhereAPipeIsSeen) {
  // A plate before the right two thirds of the pipe.
  model::Model model = pipes({{"P-1", {0, 0, 0}, {6000, 0, 0}}});
  model::Object plate;
  plate.name = plate.id = "PLATE";
  plate.first_body = 1;
  plate.body_count = 1;
  model::Body body;
  body.shape = model::ShapeId{1};
  body.placement.translation = {4000, -500, 0};
  model.shapes.emplace_back(geometry::BoxPrimitive{4000, 10, 4000});
  model.bodies.push_back(body);
  model.objects.push_back(plate);
  const Sheet sheet = sheet_of(model);
  const PlacedView& view = sheet.views[0];
  const auto text = std::ranges::find(view.tags.texts, "P-1", &Text::text);
  ASSERT_NE(text, view.tags.texts.end());
  const double visible = view.box.left + 2000.0 / 50;
  EXPECT_LT(box_of(*text).right, visible);
  EXPECT_FALSE(covers_lines(view, *text));
}

TEST(AlongTags, OfParallelPipesKeepClearOfEachOther) {
  std::vector<Pipe> rack;
  for (int i = 0; i < 8; ++i)
    rack.push_back({"10-P-100" + std::to_string(i), {0, 0, 350.0 * i}, {8000, 0, 350.0 * i}, 40});
  const Sheet sheet = sheet_of(pipes(rack));
  const PlacedView& view = sheet.views[0];
  ASSERT_EQ(view.tags.texts.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_FALSE(covers_lines(view, view.tags.texts[i])) << i;
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(box_of(view.tags.texts[i]).overlaps(box_of(view.tags.texts[k])));
    // Each stands at its own pipe: they are 7 mm apart, and it is not 3 mm above.
    const double pipe = view.box.bottom - 40.0 / 50 - 7.0 * static_cast<double>(i);
    EXPECT_GT(pipe - view.tags.texts[i].at.y, 0.8) << i;
    EXPECT_LT(pipe - view.tags.texts[i].at.y, 3) << i;
  }
}

// Sixteen metres of paper: the text lies where the pipe is on the sheet, in the middle of that.
TEST(AlongTags, StandOnTheSheetWhateverReachesBeyondIt) {
  const Sheet sheet = sheet_of(
      pipes({{"LEFT", {-4e5, 0, 0}, {-1000, 0, 0}}, {"RIGHT", {1000, 0, 0}, {4e5, 0, 0}}}));
  ASSERT_EQ(sheet.views[0].tags.texts.size(), 2U);
  for (const Text& text : sheet.views[0].tags.texts) {
    EXPECT_EQ(text.turn_deg, 0);
    if (text.text == "LEFT")
      EXPECT_NEAR(text.at.x, 125, 15);
    else
      EXPECT_NEAR(text.at.x, 430, 25);
  }
}

TEST(AlongTags, LieAlongTheLinesOfWhatIsNotRound) {
  const auto d = test::drawn(
      "[[view]]\nname=\"v\"\ndirection=\"front\"\nscale=\"1:50\"\nposition=[\"150mm\",\"120mm\"]\n"
      "[[tag]]\nselect=\"base\"\ntext=\"{{name}}\"\nstyle=\"along\"\n");
  ASSERT_TRUE(d);
  ASSERT_EQ(d->sheet.views[0].tags.texts.size(), 1U);
  EXPECT_FALSE(covers_lines(d->sheet.views[0], d->sheet.views[0].tags.texts[0]));
  EXPECT_TRUE(d->sheet.views[0].tags.paths.empty());
}

// Bins must miss no line, and find none that is not there.
TEST(LineBins, FindTheLinesInTurnedBoxes) {
  test::Draw draw(11);
  for (int round = 0; round < 3000; ++round) {
    LineBins bins(100, 80);
    const PaperSegment line{{draw.between(-20, 120), draw.between(-20, 100)},
                            {draw.between(-20, 120), draw.between(-20, 100)}};
    bins.add(line);
    const double turn = draw.between(0, 6.3);
    const TurnedBox box{{draw.between(5, 95), draw.between(5, 75)},
                        {std::cos(turn), std::sin(turn)},
                        draw.between(0.5, 20),
                        draw.between(0.5, 4)};
    // By points of the line: one inside, or none within a little more.
    bool inside = false, near = false;
    for (int i = 0; i <= 2000; ++i) {
      const double t = i / 2000.0, x = line.a.x + (line.b.x - line.a.x) * t - box.middle.x,
                   y = line.a.y + (line.b.y - line.a.y) * t - box.middle.y;
      if (x + box.middle.x < 0 || x + box.middle.x > 100 || y + box.middle.y < 0 ||
          y + box.middle.y > 80)
        continue;
      const double along = std::fabs(x * box.way.x + y * box.way.y),
                   across = std::fabs(y * box.way.x - x * box.way.y);
      inside = inside || (along < box.half_length && across < box.half_height);
      near = near || (along < box.half_length + 0.1 && across < box.half_height + 0.1);
    }
    if (inside) {
      EXPECT_TRUE(bins.any_in(box)) << round;
    }
    if (!near) {
      EXPECT_FALSE(bins.any_in(box)) << round;
    }
  }
}

}  // namespace
}  // namespace strake::sheets
