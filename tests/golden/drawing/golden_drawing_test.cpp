// SPDX-License-Identifier: Apache-2.0
// A real drawing, where STRAKE_DATA names the folder of real models: what it holds, to the bit, so
// that a change of results is never silent. When one is meant, the new values go here and a line
// with the marker [DRAWING] into CHANGELOG.md.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "strake/core/hash.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/view.hpp"
#include "strake/drawing/write.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake {
namespace {

struct Golden {
  const char* view;
  std::array<std::uint64_t, drawing::kLineStates> count;  ///< in the order of LineState
  const char* hash;                                       ///< of the pieces in the model
  const char* svg;                                        ///< of the bytes, hidden lines dashed
};

const Golden kSafe[] = {
    {"iso",
     {15587, 14355, 11983, 42, 0, 9496},
     "3752d1536f5ab7b0cbfbe498b972f8de",
     "c6d220fa342fdab4ebc08e7962c5955a"},
    {"top",
     {9488, 3501, 5444, 2438, 0, 28726},
     "4e1d81f053391d99f9c7ad82afa8a4e2",
     "cdedab4b529465a41c367cfec3ff408a"},
    {"front",
     {9358, 2459, 4145, 2994, 0, 30828},
     "a94c51469759660ed797f5f924eabc28",
     "5dce8d98ab4854680e364216c2a80aa0"},
};

TEST(GoldenDrawing, SafetyDisciplineOfThePlatform) {
  const char* const data = std::getenv("STRAKE_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "STRAKE_DATA is not set";
  parallel::Team team(2);
  const parallel::Context context{.team = &team};
  const auto file = std::filesystem::path(data) / "rvm" / "vegarringdal_rvm2glb" / "HA-SAFE.RVM";
  const auto model = io::read_models({&file, 1}, {}, context);
  ASSERT_TRUE(model);
  const auto scene = model::make_scene(*model, {}, context);
  ASSERT_TRUE(scene);
  for (const Golden& golden : kSafe) {
    SCOPED_TRACE(golden.view);
    hlr::View view;
    view.direction = *drawing::direction_by_name(golden.view);
    view.up = drawing::default_up(view.direction);
    const auto lines = hlr::draw(*scene, {}, view, {}, context);
    ASSERT_TRUE(lines);
    drawing::LayoutOptions layout;
    layout.view_name = golden.view;
    const auto sheet = drawing::lay_out(*lines, *model, layout, context);
    ASSERT_TRUE(sheet);
    EXPECT_EQ(sheet->count, golden.count);
    EXPECT_EQ(sheet->hash.text(), golden.hash);
    const auto ink = drawing::choose_ink(*sheet, {.hidden = true}, context);
    ASSERT_TRUE(ink);
    std::string svg;
    drawing::write_svg(*sheet, *ink, *model, [&](std::string_view text) { svg += text; });
    EXPECT_EQ(Hasher().add(std::string_view(svg)).value().text(), golden.svg);
  }
}

}  // namespace
}  // namespace strake
