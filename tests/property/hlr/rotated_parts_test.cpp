// SPDX-License-Identifier: Apache-2.0
// Racks of pipes that run askew to the paper: found in frames of their own, with the same answer.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/hlr_oracle.hpp"
#include "support/tube_mesh.hpp"

namespace strake {
namespace {

/// Hollow pipes upright in a square, and rods and plates across them; mm.
test::ClashModel rack(int side) {
  const auto mesh = test::tube<geometry::TriangleMesh>(
      24, 50, 44, 0, 3000, [](double x, double y, double z) { return geometry::Vec3d{x, y, z}; });
  test::ClashModel m;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      m.object("P" + std::to_string(i) + "-" + std::to_string(j));
      const geometry::Placement at{{}, {110.0 * i, 110.0 * j, 7.0 * i}};
      if (m.model.shapes.empty())
        m.body(mesh, at);
      else
        m.body_of(0, at);
    }
  for (int k = 0; k < 4; ++k) {
    const double z = 500.0 + 600 * k;
    m.box("R" + std::to_string(k), {-400, 40.0 * k, z},
          {110.0 * side + 300, 40.0 * k + 12, z + 15});
    m.box("S" + std::to_string(k), {200.0 * k, -600, z - 70}, {200.0 * k + 9, 900, z + 300});
  }
  return m;
}

class RotatedPartsTest : public testing::Test {
 protected:
  static hlr::Drawing drawn(const hlr::View& view, const hlr::Options& options = {},
                            const parallel::Context& context = {}) {
    static const test::ClashModel model = rack(6);
    static const model::Scene scene = model::make_scene(model.model, {}, {}).value();
    return drawn_of(scene, view, options, context);
  }
  static hlr::Drawing drawn_of(const model::Scene& scene, const hlr::View& view,
                               const hlr::Options& options = {},
                               const parallel::Context& context = {}) {
    auto drawing = hlr::draw(scene, {}, view, options, context);
    EXPECT_TRUE(drawing.has_value()) << drawing.error().text();
    return std::move(*drawing);
  }
};

/// Pipes upright on paper, along its diagonals, nearly along either axis, and far too fine to turn.
const std::array<hlr::View, 6> kViews{{
    {.direction = {1, -1, 1}, .limits = {}},
    {.direction = {-3, 1, 2}, .up = {1, 2, 0}, .limits = {}},
    {.direction = {2, -7, 1}, .up = {3, 1, 40}, .limits = {}},
    {.direction = {5, 4, 3}, .up = {-7, 0, 3}, .limits = {}},
    {.direction = {1, 100, -1}, .limits = {}},
    {.direction = {1'000'003, -999'983, 700'001}, .limits = {}},
}};

TEST_F(RotatedPartsTest, AreDrawnTheSameHoweverTheirFacesAreFound) {
  for (const hlr::View& view : kViews)
    for (const bool limited : {false, true}) {
      hlr::View within = view;
      if (limited)
        within.limits = geometry::Box3l{{-100'000, 0, 300'000}, {400'000, 390'000, 2'000'000}};
      const hlr::Drawing chosen = drawn(within);
      ASSERT_GT(chosen.pieces.size(), 3000U);
      hlr::Options options;
      for (const std::int32_t bucketing : {hlr::Options::kNoBuckets, 16}) {
        options.bucketing = bucketing;
        ASSERT_EQ(test::difference(drawn(within, options).pieces, chosen.pieces), "")
            << bucketing << " buckets along a side";
      }
      options = {.culling = false};
      ASSERT_EQ(test::difference(drawn(within, options).pieces, chosen.pieces), "");
    }
}

TEST_F(RotatedPartsTest, AreDrawnAsByTheOtherSolvers) {
  const test::ClashModel model = rack(2);
  const model::Scene scene = model::make_scene(model.model, {}, {}).value();
  for (const hlr::View& view : {kViews[0], kViews[1]}) {
    const hlr::Drawing chosen = drawn_of(scene, view);
    for (const hlr::Solver solver : {hlr::Solver::push, hlr::Solver::brute_force})
      ASSERT_EQ(test::difference(drawn_of(scene, view, {.solver = solver}).pieces, chosen.pieces),
                "");
  }
}

TEST_F(RotatedPartsTest, AreDrawnTheSameByAnyTeam) {
  const hlr::Drawing alone = drawn(kViews[0]);
  for (const unsigned threads : {2U, 8U}) {
    parallel::Team team(threads);
    const hlr::Drawing drawing = drawn(kViews[0], {}, {.team = &team});
    ASSERT_EQ(test::difference(alone.pieces, drawing.pieces), "") << threads << " threads";
    ASSERT_EQ(alone.counters.face_tests, drawing.counters.face_tests);
  }
}

// Boxes along the paper's own axes hold all pipes of a rack that is seen along its diagonal.
TEST_F(RotatedPartsTest, CostFewTests) {
  const hlr::Options buckets{.bucketing = 16};
  EXPECT_LT(5 * drawn(kViews[0]).counters.face_tests,
            drawn(kViews[0], buckets).counters.face_tests);
}

}  // namespace
}  // namespace strake
