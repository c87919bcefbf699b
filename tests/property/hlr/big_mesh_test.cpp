// SPDX-License-Identifier: Apache-2.0
// A mesh so big that its own loops go by the team, among small objects.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/hlr_oracle.hpp"
#include "support/ray_check.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

class BigMesh : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    generate::ShipOptions options{.objects = 150, .seed = 3};
    options.imported_detail = 1;
    options.imported_triangles = 36'000;
    auto made = generate::generate_ship(options, {});
    ASSERT_TRUE(made.has_value()) << made.error().text();
    ship = new generate::Ship(std::move(*made));
    auto placed = model::make_scene(ship->model, {}, {});
    ASSERT_TRUE(placed.has_value());
    scene = new model::Scene(std::move(*placed));
  }
  static void TearDownTestSuite() {
    delete scene;
    delete ship;
    scene = nullptr;
    ship = nullptr;
  }

  static hlr::Drawing drawn(const hlr::View& view, const hlr::Options& options = {},
                            const parallel::Context& context = {}) {
    auto drawing = hlr::draw(*scene, {}, view, options, context);
    EXPECT_TRUE(drawing.has_value()) << drawing.error().text();
    return std::move(*drawing);
  }

  static inline generate::Ship* ship = nullptr;
  static inline model::Scene* scene = nullptr;
};

hlr::View slanting() { return {.direction = {3, -2, 2}, .limits = {}}; }

hlr::View from_an_eye() {
  hlr::View view{.direction = {3, -2, 2}, .limits = {}};
  view.perspective =
      hlr::Perspective{{30'000'000, -22'000'000, 26'000'000}, {3'000'000, -4'000'000, 8'000'000}};
  return view;
}

TEST_F(BigMesh, IsDrawnTheSameByAnyTeam) {
  for (const hlr::View& view : {slanting(), from_an_eye()}) {
    const hlr::Drawing alone = drawn(view);
    EXPECT_GT(alone.pieces.size(), 20'000U);
    for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
      parallel::Team team(threads);
      const hlr::Drawing drawing = drawn(view, {}, {.team = &team});
      ASSERT_EQ(test::difference(alone.pieces, drawing.pieces), "") << threads << " threads";
      ASSERT_EQ(alone.counters.face_tests, drawing.counters.face_tests);
    }
  }
}

TEST_F(BigMesh, IsDrawnTheSameWithAnyNumberOfBuckets) {
  for (const hlr::View& view : {slanting(), from_an_eye()}) {
    const hlr::Drawing chosen = drawn(view);
    hlr::Options options;
    for (const std::int32_t side : {1, 9, 100, 4096}) {
      if (test::kSanitized && side == 1) continue;
      options.bucketing = side;
      ASSERT_EQ(test::difference(chosen.pieces, drawn(view, options).pieces), "")
          << side << " buckets along a side";
    }
  }
}

TEST_F(BigMesh, IsDrawnTheSameWithNoBuckets) {
  hlr::Options options{.stage = hlr::Stage::local, .sharp_angle_deg = 89};
  const hlr::Drawing chosen = drawn(slanting(), options);
  options.bucketing = hlr::Options::kNoBuckets;
  const hlr::Drawing plain = drawn(slanting(), options);
  EXPECT_EQ(test::difference(plain.pieces, chosen.pieces), "");
}

TEST_F(BigMesh, RaysAgree) {
  const hlr::Drawing drawing = drawn(slanting());
  const test::RayCheck check =
      test::check_by_rays(*scene, drawing, test::rounds<std::uint64_t>(3000), 11);
  EXPECT_EQ(check.wrong, 0U) << check.first_wrong;
}

}  // namespace
}  // namespace strake
