// SPDX-License-Identifier: Apache-2.0
#include "synthetic_plant.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "support/io_models.hpp"

namespace strake::bench {
namespace {

/// A closed tube about z; coordinates on a micrometre grid, as exporters round them.
geometry::TriangleMesh tube(std::uint32_t sides, double radius, double length) {
  geometry::TriangleMesh mesh;
  const auto rounded = [](double v) { return std::round(v * 1000) / 1000; };
  for (std::uint32_t i = 0; i < sides; ++i)
    for (const double z : {0.0, length}) {
      const double angle = 6.283185307179586 * i / sides;
      mesh.vertices.push_back(
          {rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle)), z});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    if (i > 1) mesh.triangles.push_back({0, a, a - 2});
    if (i > 1) mesh.triangles.push_back({1, a - 1, a + 1});
  }
  return mesh;
}

}  // namespace

model::Model plant(std::uint32_t objects, std::uint32_t shared, std::uint32_t sides) {
  model::Model model;
  model.files.push_back({});
  for (std::uint32_t i = 0; i < objects; ++i) {
    if (i % shared == 0) test::add_shape(model, tube(sides, 50 + i % 200, 1000 + i % 777));
    const std::string name = fmt::format("/ZONE-{}/PIPE-{:06}", i / 1000, i);
    model::Object& object = test::add_object(model, name, name);
    object.attributes = {{"TYPE", "TUBE"}, {"SPEC", "A150"}, {"BORE", std::to_string(i % 300)}};
    const auto last = static_cast<model::ShapeId>(model.shapes.size() - 1);
    test::add_body(model, last, test::quarter_turn({i % 1000 * 137.5, i / 1000 * 211.0, 2000.25}));
  }
  return model;
}

}  // namespace strake::bench
