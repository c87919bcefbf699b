// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "pictures/clash_picture.hpp"
#include "pictures/whole_run.hpp"
#include "strake/parallel/team.hpp"
#include "support/pictured_clash.hpp"

namespace strake::pictures {
namespace {

using test::ClashModel;
using test::PicturedClash;

ClashModel crossing(const std::string& a = "pipe", const std::string& b = "beam") {
  ClashModel m;
  m.box(a, {-400, -50, -50}, {400, 50, 50});
  m.box(b, {-60, -300, -60}, {40, 300, 40});
  m.box("floor", {-2000, -2000, -210}, {2000, 2000, -200});
  return m;
}

Result<ClashPicture> picture_of(const PicturedClash& clash, const Subject& subject,
                                const PictureOptions& options = {},
                                const parallel::Context& context = {}) {
  const Scenery scenery = clash.scenery();
  const auto viewpoint = choose_viewpoint(scenery, subject, {view_aspect(options)}, context);
  if (!viewpoint) return viewpoint.error();
  return draw_clash(scenery, subject, *viewpoint, options, context);
}

std::string svg_of(const ClashPicture& picture) {
  std::string text;
  EXPECT_TRUE(write_svg(picture, [&](std::string_view piece) { text += piece; }));
  return text;
}

std::size_t lines_of(const ClashPicture& picture, const Colour& colour) {
  return static_cast<std::size_t>(std::ranges::count_if(
      picture.lines, [&](const PictureLine& line) { return line.colour == colour; }));
}

TEST(ClashPicture, ShowsBothObjectsAndWhereTheyCross) {
  const PicturedClash clash(crossing());
  const auto picture = picture_of(clash, clash.subject("pipe", "beam"));
  ASSERT_TRUE(picture);
  EXPECT_GT(lines_of(*picture, kColourOfA), 3U);
  EXPECT_GT(lines_of(*picture, kColourOfB), 3U);
  EXPECT_GT(lines_of(*picture, kColourOfMark), 0U) << "the crossing";
  EXPECT_EQ(picture->rings.size(), 2U) << "a ring on white";
  EXPECT_NEAR(picture->rings[1].at.x, picture->width_mm / 2, 0.01);
  EXPECT_NEAR(picture->rings[1].at.y, picture->view_mm / 2, 0.01);
  for (const PictureLine& line : picture->lines)
    for (const PicturePoint& end : {line.a, line.b}) {
      EXPECT_GE(std::min(end.x, end.y), 0);
      EXPECT_LE(end.x, picture->width_mm);
      EXPECT_LE(end.y, picture->view_mm);
    }
  EXPECT_TRUE(std::ranges::any_of(
      picture->texts, [](const PictureText& t) { return t.text.starts_with("Hit, ") && t.bold; }));
}

TEST(ClashPicture, RingsDoNotCrowd) {
  const PicturedClash clash(crossing());
  Subject group = clash.subject("pipe", "beam");
  group.results.insert(group.results.end(), 5, group.results.front());
  const auto picture = picture_of(clash, group);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->rings.size(), 2U) << "one place, one ring";
}

TEST(ClashPicture, WithoutACaptionIsTheViewAlone) {
  const PicturedClash clash(crossing());
  PictureOptions options;
  options.caption = false;
  const auto picture = picture_of(clash, clash.subject("pipe", "beam"), options);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->texts.empty());
  EXPECT_EQ(picture->view_mm, picture->height_mm);
}

TEST(ClashPicture, IsTheSameForAnyTeam) {
  const PicturedClash clash(crossing());
  const Subject subject = clash.subject("pipe", "beam");
  std::string expected_svg, expected_png;
  for (const unsigned workers : {1U, 2U, 3U, 8U}) {
    parallel::Team team(workers);
    const auto picture = picture_of(clash, subject, {}, {.team = &team});
    ASSERT_TRUE(picture);
    const std::string svg = svg_of(*picture), png = png_of(*picture, 320, 240).value();
    if (expected_svg.empty()) {
      expected_svg = svg;
      expected_png = png;
    }
    EXPECT_EQ(svg, expected_svg);
    EXPECT_EQ(png, expected_png);
  }
}

TEST(ClashPicture, HostileNamesAreText) {
  const std::string hostile = "</text><script>\xff\x01\xE2\x80\xAE=cmd" + std::string(10000, 'x');
  const PicturedClash clash(crossing(hostile, "&beam"));
  const auto picture = picture_of(clash, clash.subject(hostile, "&beam"));
  ASSERT_TRUE(picture);
  const std::string svg = svg_of(*picture);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;/text&gt;"), std::string::npos);
  EXPECT_NE(svg.find("&amp;beam"), std::string::npos);
  EXPECT_EQ(svg.find("\xE2\x80\xAE"), std::string::npos);
  EXPECT_EQ(svg.find('\x01'), std::string::npos);
  EXPECT_EQ(svg.find(std::string(500, 'x')), std::string::npos) << "it is cut to what fits";
  EXPECT_TRUE(png_of(*picture, 400, 300));
}

TEST(ClashPicture, APngDistinguishesLetters) {
  const auto png_with = [](const std::string& name) {
    const PicturedClash clash(crossing(name, "beam"));
    return png_of(*picture_of(clash, clash.subject(name, "beam")), 400, 300).value();
  };
  EXPECT_NE(png_with("Труба"), png_with("?????"));
  EXPECT_NE(png_with("Труба"), png_with("Трубы"));
  EXPECT_NE(png_with("Σωλήνας"), png_with("???????"));
  EXPECT_EQ(png_with("配管"), png_with("船体")) << "what the font lacks are boxes";
}

TEST(ClashPicture, APngHasTheSizeThatIsRequested) {
  const PicturedClash clash(crossing());
  const auto picture = picture_of(clash, clash.subject("pipe", "beam"));
  ASSERT_TRUE(picture);
  const std::string png = png_of(*picture, 200, 333).value();
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\xc8\0\0\x01\x4d", 8));
  EXPECT_EQ(png_of(*picture, 8, 100).error().code, ErrorCode::usage);
  EXPECT_EQ(png_of(*picture, 100, 9000).error().code, ErrorCode::usage);
}

TEST(ClashPicture, RefusesSizesAndEndsWhenCancelled) {
  const PicturedClash clash(crossing());
  const Subject subject = clash.subject("pipe", "beam");
  EXPECT_EQ(picture_of(clash, subject, {.width_mm = 10}).error().code, ErrorCode::usage);
  const Scenery scenery = clash.scenery();
  const ClashViewpoint viewpoint = choose_viewpoint(scenery, subject, {}, {}).value();
  const std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(draw_clash(scenery, subject, viewpoint, {}, {.stop = stop.get_token()}).error().code,
            ErrorCode::cancelled);
}

/// A mesh of very many triangles is drawn by those near the clash, and looks as it does whole.
TEST(ClashPicture, ALargeMeshIsDrawnByWhatIsNear) {
  geometry::TriangleMesh terrain;
  constexpr std::uint32_t kSide = 80;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      terrain.vertices.push_back(
          {x * 300.0 - 12000, y * 300.0 - 12000, ((x * 7 + y * 13) % 5) * 40.0});
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t at = y * (kSide + 1) + x;
      terrain.triangles.push_back({at, at + 1, at + kSide + 2});
      terrain.triangles.push_back({at, at + kSide + 2, at + kSide + 1});
    }
  ClashModel m;
  m.object("terrain").body(terrain);
  m.box("post", {-100, -100, -500}, {100, 100, 900});
  const PicturedClash clash(std::move(m));
  const auto picture = picture_of(clash, clash.subject("terrain", "post"));
  ASSERT_TRUE(picture);
  EXPECT_GT(lines_of(*picture, kColourOfA), 3U);
  EXPECT_GT(lines_of(*picture, kColourOfB), 3U);
  EXPECT_GT(lines_of(*picture, kColourOfMark), 0U);
  EXPECT_LT(picture->lines.size(), 3000U);
}

TEST(WholeRun, NeedsTheModel) {
  const PicturedClash clash(crossing());
  const report::ClashContents without{clash.findings, clash.model};
  EXPECT_EQ(write_overview(without, [](std::string_view) {}, {}).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace strake::pictures
