// SPDX-License-Identifier: Apache-2.0
// Drawings written again from their neutral form, without the model that they are of.
#include "strake/report/view_drawing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/generate/ship.hpp"
#include "support/view_documents.hpp"

namespace strake::report {
namespace {

using drawing::NeutralDrawing;
using test::Drawn;
using test::ViewForm;

model::Model ship() {
  auto made = generate::generate_ship({.objects = 300}, {});
  EXPECT_TRUE(made);
  return made ? std::move(made->model) : model::Model{};
}

/// Pipes, whose rims stand for circles, and a box that cuts them.
model::Model pipes() {
  test::ClashModel m;
  m.object("pipe").body(geometry::Primitive{geometry::CylinderPrimitive{300, 2000}});
  m.object("other").again({{}, {900, 150, 0}});
  m.box("box", {200, -500, -500}, {700, 500, 500});
  return std::move(m.model);
}

NeutralDrawing on_paper(const model::Model& model, const Drawn& how) {
  const auto scene = model::make_scene(model, {}, {});
  EXPECT_TRUE(scene);
  const auto lines = hlr::draw(*scene, {}, how.view, how.options, {});
  EXPECT_TRUE(lines);
  auto paper = drawing::lay_out(*lines, model, how.layout, {});
  EXPECT_TRUE(paper);
  return paper ? std::move(*paper) : NeutralDrawing{};
}

std::string text_of(const NeutralDrawing& drawing, const model::Model& model, ViewForm form) {
  std::string text;
  const auto append = [&](std::string_view piece) { text += piece; };
  EXPECT_TRUE(form == ViewForm::rows ? drawing::write_view_rows(drawing, model, append, {})
                                     : drawing::write_view_json(drawing, model, append, {}));
  return text;
}

std::string svg_of(const NeutralDrawing& drawing, const model::Model& model,
                   const drawing::InkOptions& options) {
  const auto ink = drawing::choose_ink(drawing, options, {});
  EXPECT_TRUE(ink);
  std::string text;
  drawing::write_svg(drawing, *ink, model, [&](std::string_view piece) { text += piece; });
  return text;
}

Result<ViewDrawing> read(const std::string& text) {
  std::istringstream in(text);
  return parse_view_drawing(in, "view.json");
}

std::string fault_of(const std::string& text) {
  const auto drawing = read(text);
  return drawing ? std::string() : drawing.error().text();
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

std::array<Drawn, 5> views() {
  std::array<Drawn, 5> all;
  all[0].layout.view_name = "iso";
  all[1].view.direction = {0, 0, 1};
  all[1].view.up = {0, 1, 0};
  all[1].view.sections = {{{0, 0, 1}, {0, 0, 4'500'000}}};
  all[1].layout.title = "SECTION \"A-A\"";
  all[2].view.direction = {0, -1, 0};
  all[2].view.limits = geometry::Box3l{{0, -2'000'000, 0}, {9'000'000, 9'000'000, 9'000'000}};
  all[2].options.smooth = hlr::Smooth::tangent;
  all[2].options.flush_seams = false;
  all[3].view.perspective =
      hlr::Perspective{{2'000'000, -9'000'000, 6'000'000}, {9'000'000, 0, 3'000'000}, 100, 40};
  all[3].view.direction = {-7, -9, 3};
  all[4].options.hidden = false;
  all[4].options.stage = hlr::Stage::local;
  all[4].options.own_polylines = hlr::OwnPolylines::hidden;
  return all;
}

void expect_written_again(const model::Model& model, const Drawn& how) {
  const NeutralDrawing drawn = on_paper(model, how);
  for (const ViewForm form : {ViewForm::text, ViewForm::rows}) {
    const auto again = read(text_of(drawn, model, form));
    ASSERT_TRUE(again) << again.error().text();
    for (const ViewForm as : {ViewForm::text, ViewForm::rows})
      EXPECT_TRUE(text_of(again->drawing, again->model, as) == text_of(drawn, model, as));
    for (const bool hidden : {false, true})
      for (const bool clean_up : {false, true}) {
        const drawing::InkOptions ink{.hidden = hidden, .clean_up = clean_up};
        EXPECT_TRUE(svg_of(again->drawing, again->model, ink) == svg_of(drawn, model, ink));
      }
  }
}

TEST(ViewDrawing, IsWrittenAgainByteByByte) {
  for (const model::Model& model : {ship(), pipes()})
    for (const Drawn& how : views()) expect_written_again(model, how);
  EXPECT_GT(on_paper(ship(), views()[0]).lines.size(), 1000U);
  EXPECT_GT(on_paper(pipes(), views()[0]).curves.edges.size(), 20U);
}

void expect_on_another_sheet(const model::Model& model, const Drawn& how) {
  const auto read_back = read(text_of(on_paper(model, how), model, ViewForm::text));
  ASSERT_TRUE(read_back);
  Drawn other = how;
  other.layout.scale = 400;
  other.layout.title = "elsewhere";
  const NeutralDrawing expected = on_paper(model, other);
  ASSERT_NE(expected.sheet.scale, read_back->drawing.sheet.scale);
  const auto again = drawing::lay_out_again(read_back->drawing, other.layout, {});
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(again->title, expected.title);
  EXPECT_EQ(again->sheet.scale_text, expected.sheet.scale_text);
  EXPECT_EQ(again->sheet.width_mm, expected.sheet.width_mm);
  ASSERT_EQ(again->lines.size(), expected.lines.size());
  for (std::size_t i = 0; i < expected.lines.size(); ++i) {
    const drawing::Line &a = again->lines[i], &b = expected.lines[i];
    if (a.state == drawing::LineState::clipped) continue;
    for (const auto& [x, y] :
         {std::pair(a.a_paper.x, b.a_paper.x), std::pair(a.a_paper.y, b.a_paper.y),
          std::pair(a.b_paper.x, b.b_paper.x), std::pair(a.b_paper.y, b.b_paper.y)})
      EXPECT_NEAR(x, y, 0.0021);
  }
  ASSERT_EQ(again->curves.all.size(), expected.curves.all.size());
  for (std::size_t c = 0; c < expected.curves.all.size(); ++c) {
    EXPECT_NEAR(again->curves.all[c].centre.x, expected.curves.all[c].centre.x, 1e-6);
    EXPECT_NEAR(again->curves.all[c].u.y, expected.curves.all[c].u.y, 1e-9);
  }
  EXPECT_EQ(again->frame.has_value(), expected.frame.has_value());
}

TEST(ViewDrawing, IsPutOnAnotherSheet) {
  for (const model::Model& model : {ship(), pipes()})
    for (const Drawn& how : views()) expect_on_another_sheet(model, how);
}

TEST(ViewDrawing, KeepsItsSheetWhereRequested) {
  const model::Model model = ship();
  const NeutralDrawing drawn = on_paper(model, views()[0]);
  drawing::LayoutOptions same;
  same.scale = drawn.sheet.scale;
  const auto again = drawing::lay_out_again(drawn, same, {});
  ASSERT_TRUE(again);
  EXPECT_TRUE(text_of(*again, model, ViewForm::text) == text_of(drawn, model, ViewForm::text));
}

TEST(ViewDrawing, OfAnotherLayoutIsNotPutElsewhere) {
  const model::Model model = ship();
  NeutralDrawing moved = on_paper(model, views()[0]);
  for (drawing::Line& line : moved.lines) line.a_paper.x += 1;
  drawing::LayoutOptions other;
  other.scale = 500;
  const auto again = drawing::lay_out_again(moved, other, {});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::input);
}

TEST(ViewDrawing, WhatIsWrongIsReported) {
  const std::string sound = text_of(on_paper(ship(), views()[1]), ship(), ViewForm::text);
  EXPECT_EQ(fault_of(sound), "");
  const auto reported = [&](const std::string& what, const std::string& by) {
    return fault_of(with(sound, what, by));
  };
  EXPECT_NE(reported("\"edge\":", "\"other\":").find("\"edge\""), std::string::npos);
  EXPECT_NE(reported("\"direction\":[0,0,1]", "\"direction\":[0,0,1.5]").find("direction"),
            std::string::npos);
  EXPECT_NE(reported("\"direction\":[0,0,1]", "\"direction\":[0,0]").find("direction"),
            std::string::npos);
  EXPECT_NE(reported("\"scale_text\":\"", "\"scale_word\":\"").find("scale_text"),
            std::string::npos);
  EXPECT_NE(reported("\"stage\":\"global\"", "\"stage\":\"worldwide\"").find("stage"),
            std::string::npos);
  EXPECT_NE(reported("\"hash\":\"", "\"hash\":\"x").find("hash"), std::string::npos);
  const std::string round = text_of(on_paper(pipes(), views()[0]), pipes(), ViewForm::text);
  EXPECT_NE(fault_of(with(round, "\"curve_index\":0", "\"curve_index\":4000")).find("curve 4000"),
            std::string::npos);
  EXPECT_NE(reported("\"width_mm\":420", "\"width_mm\":4e9").find("sheet"), std::string::npos);
  EXPECT_NE(reported("\"width_mm\":420", "\"width_mm\":0.001").find("sheet"), std::string::npos);
  EXPECT_NE(fault_of(with(round, "\"a_paper_mm\":[", "\"a_paper_mm\":[9")).find("sheet"),
            std::string::npos);
  for (std::size_t length = 0; length < sound.size(); length += sound.size() / 97 + 1)
    EXPECT_NE(fault_of(sound.substr(0, length)), "") << length;
}

TEST(ViewDrawing, IsKnownByItsContent) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const std::string text = text_of(on_paper(ship(), views()[0]), ship(), ViewForm::text);
  const auto is_one = [&](const std::string& content) {
    const auto file = folder / "strake_view_drawing_test.bin";
    std::ofstream(file, std::ios::binary) << content;
    const bool known = is_view_document(file);
    std::filesystem::remove(file);
    return known;
  };
  EXPECT_TRUE(is_one(text));
  EXPECT_TRUE(is_one("\n  " + text));
  EXPECT_TRUE(is_one("STRKVIEW and more"));
  EXPECT_FALSE(is_one(""));
  EXPECT_FALSE(is_one("STRK"));
  EXPECT_FALSE(is_one("{\"asset\":{\"version\":\"2.0\"}}"));
  EXPECT_FALSE(is_one("{\"schema_version\":1,\"results\":[]}"));
  EXPECT_FALSE(is_view_document(folder));
  EXPECT_FALSE(is_view_document(folder / "nothing.json"));
}

}  // namespace
}  // namespace strake::report
