// SPDX-License-Identifier: Apache-2.0
// Drawings of whole generated ships, in the nightly set of a hundred thousand objects, judged by
// exact rays.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/ray_check.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3l;

const std::uint64_t kObjects = test::rounds(1'000, 100'000);
const std::uint64_t kRays = test::rounds(2'000, 100'000);

void observe(bool turned, const std::vector<Vec3l>& directions) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};
  const auto ship = generate::generate_ship({kObjects, 1, turned}, context);
  ASSERT_TRUE(ship);
  const auto scene = model::make_scene(ship->model, {}, context);
  ASSERT_TRUE(scene);
  for (const Vec3l& direction : directions) {
    const auto drawing = hlr::draw(*scene, {}, {.direction = direction, .limits = {}},
                                   {.keep_specks = true}, context);
    ASSERT_TRUE(drawing) << drawing.error().text();
    const test::RayCheck check = test::check_by_rays(*scene, *drawing, kRays, 1);
    EXPECT_EQ(check.rays, kRays);
    EXPECT_EQ(check.wrong, 0U) << "seen from " << direction.x << "," << direction.y << ","
                               << direction.z << ": " << check.first_wrong;
  }
}

TEST(GeneratedShip, NoRayDisagrees) { observe(false, {{1, -1, 1}, {0, 0, 1}, {5, -7, 4}}); }

// No face lies along an axis, and what is flush is so to within rounding.
TEST(GeneratedShip, NoRayDisagreesWhenItStandsAskew) { observe(true, {{1, -1, 1}, {0, -1, 0}}); }

}  // namespace
}  // namespace strake
