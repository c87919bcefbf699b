// SPDX-License-Identifier: Apache-2.0
// Drawings of real plant files, where STRAKE_DATA names the folder that holds them: judged by exact
// rays, and a cut of them by the brute-force solver. The ray check itself is shown to find faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/ray_check.hpp"

namespace strake {
namespace {

using geometry::Box3l;
using geometry::Vec3l;
using hlr::State;

const std::vector<Vec3l> kDirections = {{1, -1, 1}, {0, 0, 1}, {0, -1, 0}, {1, -2, 3}};

struct Platform {
  model::Model model;
  model::Scene scene;
};

std::unique_ptr<Platform> platform(const std::vector<std::string>& disciplines) {
  const char* const data = std::getenv("STRAKE_DATA");
  if (data == nullptr) return nullptr;
  std::vector<std::filesystem::path> files;
  for (const std::string& name : disciplines)
    files.push_back(std::filesystem::path(data) / "rvm" / "vegarringdal_rvm2glb" /
                    ("HA-" + name + ".RVM"));
  auto result = std::make_unique<Platform>();
  auto model = io::read_models(files, {}, {});
  EXPECT_TRUE(model);
  if (!model) return result;
  result->model = std::move(*model);
  auto scene = model::make_scene(result->model, {}, {});
  EXPECT_TRUE(scene);
  if (scene) result->scene = std::move(*scene);
  return result;
}

hlr::Drawing drawn(const model::Scene& scene, const Vec3l& direction) {
  auto drawing =
      hlr::draw(scene, {}, {.direction = direction, .limits = {}}, {.keep_specks = true}, {});
  EXPECT_TRUE(drawing);
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

std::uint64_t rays_each(std::uint64_t usual) {
  const char* const more = std::getenv("STRAKE_RAYS");
  return more != nullptr ? std::strtoull(more, nullptr, 10) : usual;
}

TEST(RayCheck, ApprovesLatticeScenes) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, {.unit = 1000});
    const Vec3l direction = test::direction_of(static_cast<std::uint32_t>(seed));
    const test::RayCheck check =
        test::check_by_rays(scene.scene(), drawn(scene.scene(), direction), 100, seed);
    EXPECT_EQ(check.wrong, 0U) << "seed " << seed << ": " << check.first_wrong;
  }
}

// Turned states are found, all of them: the check leaves nothing undecided.
TEST(RayCheck, FindsEveryTurnedState) {
  std::uint64_t rays = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, {.objects = 3, .unit = 1000});
    hlr::Drawing drawing =
        drawn(scene.scene(), test::direction_of(static_cast<std::uint32_t>(seed)));
    // Parts of one object that share an edge may differ along it, and a piece does not show its
    // part: objects of one part only are turned.
    const auto is_single = [&](const hlr::EdgePiece& p) {
      const auto bodies = scene.scene().bodies_of(p.object);
      return bodies.size() == 1 && scene.scene().shapes[bodies[0].grid_shape].parts.size() == 1;
    };
    std::erase_if(drawing.pieces, [&](const hlr::EdgePiece& p) {
      return p.state == State::projecting || !is_single(p);
    });
    for (hlr::EdgePiece& p : drawing.pieces)
      p.state = p.state == State::visible          ? State::hidden_by_other
                : p.state == State::hidden_by_self ? State::hidden_by_other
                                                   : State::visible;
    const test::RayCheck check = test::check_by_rays(scene.scene(), drawing, 50, seed);
    EXPECT_EQ(check.wrong, check.rays) << "seed " << seed;
    rays += check.rays;
  }
  EXPECT_GT(rays, 2000U);
}

// One discipline in the usual set, all four with 100,000 rays each in the nightly one.
TEST(RealDrawings, RaysAgree) {
  const bool all = std::getenv("STRAKE_RAYS") != nullptr;
  const auto ha = platform(all ? std::vector<std::string>{"ARCH", "HVAC", "MECH", "SAFE"}
                               : std::vector<std::string>{"SAFE"});
  if (!ha) GTEST_SKIP() << "STRAKE_DATA is not set";
  for (const Vec3l& direction : kDirections) {
    const test::RayCheck check =
        test::check_by_rays(ha->scene, drawn(ha->scene, direction), rays_each(4000), 1);
    EXPECT_EQ(check.wrong, 0U) << check.first_wrong;
    EXPECT_EQ(check.rays, rays_each(4000));
  }
}

/// The objects near the middle of an object's box, without the few of very many triangles.
[[nodiscard]] std::vector<bool> near_object(const model::Scene& scene, std::uint32_t object,
                                            std::int64_t reach) {
  const model::GridBody& body = scene.bodies[scene.first_body[object]];
  const Box3l box = body.box(scene.shapes[body.grid_shape]);
  Box3l about;
  for (int k = 0; k < 3; ++k) {
    about.lo[k] = (box.lo[k] + box.hi[k]) / 2 - reach;
    about.hi[k] = (box.lo[k] + box.hi[k]) / 2 + reach;
  }
  std::vector<bool> drawn(scene.model->objects.size());
  for (std::uint32_t o = 0; o < drawn.size(); ++o) {
    std::size_t triangles = 0;
    for (const model::GridBody& b : scene.bodies_of(model::ObjectId{o})) {
      const model::GridShape& shape = scene.shapes[b.grid_shape];
      for (const geometry::Part& part : shape.parts) triangles += part.triangles.size();
      drawn[o] = drawn[o] || b.box(shape).meets(about);
    }
    drawn[o] = drawn[o] && triangles < 500;
  }
  return drawn;
}

TEST(RealDrawings, CutsEqualTheBruteForceSolver) {
  const auto ha = platform({"HVAC", "MECH"});
  if (!ha) GTEST_SKIP() << "STRAKE_DATA is not set";
  std::uint64_t objects = 0, hidden = 0;
  const bool all = std::getenv("STRAKE_RAYS") != nullptr;
  const std::vector<std::uint32_t> places =
      all ? std::vector<std::uint32_t>{100, 400, 700, 1000, 1200, 1600, 2000, 2300, 2600}
          : std::vector<std::uint32_t>{700, 1200, 2600};
  for (const std::uint32_t object : places) {
    const std::vector<bool> selection = near_object(ha->scene, object, 100'000);
    for (const Vec3l& direction : kDirections) {
      const hlr::View view{.direction = direction, .limits = {}};
      hlr::Options options;
      const auto got = hlr::draw(ha->scene, selection, view, options, {});
      options.solver = hlr::Solver::brute_force;
      const auto expected = hlr::draw(ha->scene, selection, view, options, {});
      ASSERT_TRUE(got && expected);
      EXPECT_EQ(test::difference(expected->pieces, got->pieces), "") << "object " << object;
      objects += got->account.objects();
      hidden += static_cast<std::uint64_t>(
          std::count_if(got->pieces.begin(), got->pieces.end(),
                        [](const hlr::EdgePiece& p) { return p.state == State::hidden_by_other; }));
    }
  }
  EXPECT_GT(objects, 40U);
  EXPECT_GT(hidden, 100U);
  RecordProperty("objects", static_cast<int>(objects));
}

}  // namespace
}  // namespace strake
