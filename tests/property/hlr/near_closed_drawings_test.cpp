// SPDX-License-Identifier: Apache-2.0
// A soup whose corners are a little off is drawn as the body that it stands for.
#include <gtest/gtest.h>

#include <cstdint>

#include "strake/hlr/hlr.hpp"
#include "support/drawn_lengths.hpp"
#include "support/near_closed.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3l;

TEST(NearClosedDrawings, LookLikeTheCleanBody) {
  for (std::uint64_t seed = 1; seed <= test::rounds(40U, 2'000U); ++seed) {
    SCOPED_TRACE(seed);
    test::Draw draw(seed);
    TriangleMesh clean = test::drawn_body(draw).mesh;
    TriangleMesh soup = test::soup_of(clean);
    constexpr double kWeldMm = 0.01;
    // An edge that is cut at a T-junction is two edges, which are one line on paper only.
    const bool with_junctions = seed % 2 == 0;
    if (with_junctions) test::split_sides_mm(soup, 5, 4 * kWeldMm, draw);
    soup = test::soup_of(soup);
    test::jitter(soup, (kWeldMm - 0.0018) / 2, draw);
    const auto turn = draw.rotation();
    for (TriangleMesh* const mesh : {&clean, &soup}) test::place_mesh(*mesh, turn, {10, 20, 30});
    const Vec3l direction{draw.whole(-50, 50), draw.whole(-50, 50), 60};
    const test::DrawnLengths is = test::drawn_lengths(soup, kWeldMm, direction),
                             was = test::drawn_lengths(clean, 0, direction);
    for (const auto& [what, count] : was.edges) {
      const auto edges = is.edges.find(what);
      ASSERT_NE(edges, is.edges.end());
      if (what.second == hlr::State::visible && !with_junctions) {
        EXPECT_EQ(edges->second, count);
      }
      EXPECT_NEAR(is.lengths.at(what), was.lengths.at(what), 0.001 * was.lengths.at(what) + 1000);
    }
    for (const auto& [what, count] : is.edges) EXPECT_NE(what.first, hlr::EdgeKind::boundary);
  }
}

}  // namespace
}  // namespace strake
