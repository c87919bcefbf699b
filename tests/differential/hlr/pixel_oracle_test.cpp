// SPDX-License-Identifier: Apache-2.0
// Drawings against a rendering of the same view: where a line is visible nothing is in front, and
// where one surface ends in front of another there is a line.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "strake/generate/ship.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"
#include "support/pixel_view.hpp"

namespace strake {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr int kWidth = 700;

struct ViewCase {
  Vec3l direction, up;
};
const std::vector<ViewCase> kSights = {{{1, -1, 1}, {0, 0, 1}},
                                       {{0, 0, 1}, {0, 1, 0}},
                                       {{0, -1, 0}, {0, 0, 1}},
                                       {{7, -3, 2}, {0, 0, 1}}};

hlr::Drawing drawn(const model::Scene& scene, const ViewCase& sight) {
  auto drawing =
      hlr::draw(scene, {}, {.direction = sight.direction, .up = sight.up, .limits = {}}, {}, {});
  EXPECT_TRUE(drawing);
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

/// Boxes, pipes and balls in general position, through each other.
model::Model crowd(std::uint64_t seed, int objects) {
  test::Draw draw(seed);
  model::Model model;
  model.files.push_back({"crowd.obj", "OBJ", "mm", "z", 1, 0});
  for (int i = 0; i < objects; ++i) {
    model::Object object;
    object.id = object.name = std::to_string(i);
    object.first_body = static_cast<std::uint32_t>(model.bodies.size());
    object.body_count = 1;
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(model.shapes.size())};
    body.placement.translation = {draw.between(0, 2000), draw.between(0, 2000),
                                  draw.between(0, 2000)};
    if (draw.one_in(2)) body.placement.linear = draw.rotation();
    const double size = draw.between(60, 400);
    switch (draw.below(3)) {
      case 0:
        model.shapes.emplace_back(
            test::box_mesh({0, 0, 0}, {size, draw.between(40, 300), draw.between(5, 200)}));
        break;
      case 1:
        model.shapes.emplace_back(
            geometry::Primitive{geometry::CylinderPrimitive{size / 4, size * 3}});
        break;
      default:
        model.shapes.emplace_back(geometry::Primitive{geometry::SpherePrimitive{size}});
    }
    model.objects.push_back(object);
    model.bodies.push_back(body);
  }
  return model;
}

/// `most`: disagreements per million pixels that were asked about.
void expect_agreement(const model::Scene& scene, const ViewCase& sight, int width, double most,
                      const std::string& what) {
  const test::PixelCheck check = test::check_by_pixels(scene, drawn(scene, sight), width);
  const std::string reported =
      what + " from " + std::to_string(sight.direction.x) + "," +
      std::to_string(sight.direction.y) + "," + std::to_string(sight.direction.z) + ": " +
      check.first + "; " + std::to_string(check.covered) + " of " +
      std::to_string(check.line_pixels) + " pixels of lines covered (" +
      std::to_string(check.magnified) + " magnified), " + std::to_string(check.without_line) +
      " of " + std::to_string(check.jumps) + " jumps and " + std::to_string(check.borders) +
      " borders without a line";
  EXPECT_GT(check.line_pixels, 1000U) << reported;
  EXPECT_GT(check.borders, 300U) << reported;
  EXPECT_LE(static_cast<double>(check.covered),
            most * 1e-6 * static_cast<double>(check.line_pixels))
      << reported;
  EXPECT_LE(static_cast<double>(check.without_line),
            most * 1e-6 * static_cast<double>(check.borders + check.jumps))
      << reported;
}

TEST(PixelOracle, CrowdsAgree) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const model::Model model = crowd(seed, 60);
    const auto scene = model::make_scene(model, {}, {});
    ASSERT_TRUE(scene);
    for (const ViewCase& sight : kSights)
      expect_agreement(*scene, sight, kWidth, 0, "crowd " + std::to_string(seed));
  }
}

// A line that is missing, and one that is seen through what is in front, are found.
TEST(PixelOracle, FindsWhatIsWrong) {
  const model::Model model = crowd(1, 60);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const hlr::Drawing sound = drawn(*scene, kSights[0]);
  hlr::Drawing without = sound, through = sound;
  std::uint32_t object = 0;
  std::erase_if(without.pieces, [&](const hlr::EdgePiece& p) {
    const bool visible = p.state == hlr::State::visible && p.kind == hlr::EdgeKind::contour;
    if (visible && object == 0) object = model::index(p.object) + 1;
    return visible && model::index(p.object) + 1 == object;
  });
  EXPECT_GT(test::check_by_pixels(*scene, without, kWidth).without_line, 0U);
  std::size_t turned = 0;
  for (hlr::EdgePiece& p : through.pieces)
    if (p.state == hlr::State::hidden_by_other) {
      p.state = hlr::State::visible;
      ++turned;
    }
  ASSERT_GT(turned, 0U);
  // Nearly every pixel of such a line is found out: near what hides it, the next sees it.
  const auto right = test::check_by_pixels(*scene, sound, kWidth);
  const auto wrong = test::check_by_pixels(*scene, through, kWidth);
  EXPECT_EQ(right.covered, 0U);
  EXPECT_GT(static_cast<double>(wrong.covered),
            0.9 * static_cast<double>(wrong.line_pixels - right.line_pixels));
}

TEST(PixelOracle, AGeneratedShipAgrees) {
  auto ship = generate::generate_ship({.objects = 400, .seed = 3}, {});
  ASSERT_TRUE(ship);
  const auto scene = model::make_scene(ship->model, {}, {});
  ASSERT_TRUE(scene);
  for (const ViewCase& sight : kSights) expect_agreement(*scene, sight, kWidth, 0, "ship");
}

TEST(PixelOracle, TheRealPlatformAgrees) {
  const char* const data = std::getenv("STRAKE_DATA");
  if (data == nullptr) GTEST_SKIP() << "STRAKE_DATA is not set";
  const std::vector<std::filesystem::path> files{std::filesystem::path(data) / "rvm" /
                                                 "vegarringdal_rvm2glb" / "HA-SAFE.RVM"};
  const auto model = io::read_models(files, {}, {});
  ASSERT_TRUE(model);
  const auto scene = model::make_scene(*model, {}, {});
  ASSERT_TRUE(scene);
  for (const ViewCase& sight : kSights) expect_agreement(*scene, sight, 1600, 0, "platform");
}

}  // namespace
}  // namespace strake
