// SPDX-License-Identifier: Apache-2.0
// The groups of objects are made by all workers, in pieces: the bytes are those of one worker, and
// what the sink throws comes out.
#include <gtest/gtest.h>

#include <cstddef>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::drawing {
namespace {

class SvgByTeams : public testing::Test {
 protected:
  void SetUp() override {
    auto ship = generate::generate_ship({.objects = 2000}, {});
    ASSERT_TRUE(ship.has_value());
    model_ = std::move(ship->model);
    const auto scene = model::make_scene(model_, {}, {});
    ASSERT_TRUE(scene.has_value());
    const auto lines = hlr::draw(*scene, {}, {.direction = {1, -1, 1}}, {}, {});
    ASSERT_TRUE(lines.has_value());
    auto sheet = lay_out(*lines, model_, {}, {});
    ASSERT_TRUE(sheet.has_value());
    sheet_ = std::move(*sheet);
  }

  [[nodiscard]] Ink ink(const InkOptions& options) const {
    auto ink = choose_ink(sheet_, options, {});
    EXPECT_TRUE(ink.has_value());
    return std::move(*ink);
  }

  [[nodiscard]] std::string svg(const Ink& ink, const parallel::Context& context) const {
    std::string text;
    const Status written =
        write_svg(sheet_, ink, model_, [&](std::string_view part) { text += part; }, context);
    EXPECT_TRUE(written);
    return text;
  }

  model::Model model_;
  NeutralDrawing sheet_;
};

TEST_F(SvgByTeams, HasTheSameBytes) {
  for (const InkOptions& options : {InkOptions{.hidden = false}, InkOptions{.hidden = true},
                                    InkOptions{.hidden = true, .split_hidden = true}}) {
    const Ink chosen = ink(options);
    std::string expected;
    write_svg(sheet_, chosen, model_, [&](std::string_view part) { expected += part; });
    EXPECT_TRUE(expected.ends_with("</svg>\n"));
    ASSERT_GT(expected.size(), 300'000U) << "of many pieces";
    for (const unsigned workers : {1U, 2U, 3U, 8U}) {
      parallel::Team team(workers);
      EXPECT_TRUE(svg(chosen, {.team = &team}) == expected) << workers << " workers";
    }
  }
}

TEST_F(SvgByTeams, PassesOnWhatTheSinkThrows) {
  struct Full {};
  const Ink chosen = ink({.hidden = true});
  parallel::Team team(3);
  std::size_t parts = 0;
  const auto full = [&](std::string_view /*text*/) {
    if (++parts == 4) throw Full();
  };
  EXPECT_THROW(
      static_cast<void>(write_svg(sheet_, chosen, model_, full, parallel::Context{.team = &team})),
      Full);
  EXPECT_EQ(parts, 4U);
}

TEST_F(SvgByTeams, ThatIsCancelledIsAnError) {
  const std::stop_source stop;
  stop.request_stop();
  const Status written =
      write_svg(sheet_, ink({}), model_, [](std::string_view) {}, {.stop = stop.get_token()});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::drawing
