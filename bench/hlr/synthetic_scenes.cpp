// SPDX-License-Identifier: Apache-2.0
#include "hlr/synthetic_scenes.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/io_models.hpp"
#include "support/lattice_scene.hpp"

namespace strake::bench {
namespace {

using geometry::Vec3d;

void add(model::Model& model, model::ShapeId shape, const Vec3d& at) {
  const std::string id = fmt::format("{:06}", model.objects.size());
  test::add_object(model, id, id);
  test::add_body(model, shape, {{}, at});
}

/// About x, from 0 on: two walls and two annular ends. Whole micrometres, as exporters round them.
geometry::TriangleMesh hollow_tube(double outer_mm, double inner_mm, double length_mm) {
  constexpr std::uint32_t kSides = 24;
  geometry::TriangleMesh mesh;
  const auto rounded = [](double v) { return std::round(v * 1000) / 1000; };
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    for (const double radius : {outer_mm, inner_mm})
      for (const double x : {0.0, length_mm})
        mesh.vertices.push_back(
            {x, rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle))});
  }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    // Of a corner: outer at 0 and at the end, inner at 0 and at the end.
    const std::uint32_t a = 4 * i, b = 4 * ((i + 1) % kSides);
    const auto quad = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) {
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({p, r, s});
    };
    quad(a, b, b + 1, a + 1);
    quad(a + 2, a + 3, b + 3, b + 2);
    quad(a, a + 2, b + 2, b);
    quad(a + 1, b + 1, b + 3, a + 3);
  }
  return mesh;
}

}  // namespace

model::Model stacked_boxes(std::uint32_t side, std::uint32_t deep) {
  constexpr double kPitch_mm = 100;
  model::Model model;
  model.files.push_back({});
  test::Random random(1);
  const auto between = [&](std::uint32_t lo, std::uint32_t hi) {
    return lo + random.below((hi - lo) * 16) / 16.0;
  };
  for (std::uint32_t layer = 0; layer < deep; ++layer)
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t i = 0; i < side; ++i) {
        const auto box = test::box_mesh(between(110, 180), between(110, 180), between(40, 70));
        add(model, test::add_shape(model, box),
            {kPitch_mm * i + between(0, 60), kPitch_mm * j + between(0, 60),
             80.0 * layer + between(0, 9)});
      }
  return model;
}

model::Model pipe_bundle(std::uint32_t side, std::uint32_t lengths) {
  constexpr double kPitch_mm = 260, kLength_mm = 6000;
  model::Model model;
  model.files.push_back({});
  const model::ShapeId pipe = test::add_shape(model, hollow_tube(57, 50, kLength_mm));
  const model::ShapeId insulation = test::add_shape(model, hollow_tube(107, 57, kLength_mm));
  const model::ShapeId cladding = test::add_shape(model, hollow_tube(110, 107, kLength_mm));
  for (std::uint32_t k = 0; k < lengths; ++k)
    for (std::uint32_t j = 0; j < side; ++j)
      for (std::uint32_t i = 0; i < side; ++i)
        for (const model::ShapeId shape : {pipe, insulation, cladding})
          add(model, shape, {kLength_mm * k, kPitch_mm * i, kPitch_mm * j});
  return model;
}

}  // namespace strake::bench
