// SPDX-License-Identifier: Apache-2.0
#include "strake/generate/ship.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/model/scene.hpp"

namespace strake::generate {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

Ship make(std::uint64_t objects, std::uint64_t seed = 1, bool turned = false) {
  Result<Ship> ship = generate_ship({objects, seed, turned}, {});
  EXPECT_TRUE(ship.has_value());
  return std::move(ship.value());
}

std::string truth_text(const Ship& ship) {
  std::ostringstream out;
  write_truth(ship, out);
  return out.str();
}

std::set<std::uint32_t> inside_out_shapes(const Ship& ship) {
  std::set<std::uint32_t> shapes;
  for (const model::ObjectId id : ship.truth.inside_out)
    shapes.insert(model::index(ship.model.bodies[ship.model.object(id).first_body].shape));
  return shapes;
}

TEST(Ship, has_exactly_the_objects_requested) {
  for (const std::uint64_t count : {100U, 101U, 137U, 250U, 999U, 1000U, 3001U, 7777U}) {
    const Ship ship = make(count, count);
    EXPECT_EQ(ship.model.objects.size(), count);
    EXPECT_EQ(ship.model.bodies.size(), count);
  }
}

TEST(Ship, refuses_numbers_that_make_no_ship) {
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{99}, std::uint64_t{1} << 40U}) {
    const Result<Ship> ship = generate_ship({count, 1, false}, {});
    ASSERT_FALSE(ship.has_value());
    EXPECT_EQ(ship.error().code, ErrorCode::usage);
  }
}

TEST(Ship, stops_on_request) {
  const std::stop_source source;
  source.request_stop();
  parallel::Context context;
  context.stop = source.get_token();
  const Result<Ship> ship = generate_ship({1000, 1, false}, context);
  ASSERT_FALSE(ship.has_value());
  EXPECT_EQ(ship.error().code, ErrorCode::cancelled);
}

TEST(Ship, equal_options_give_equal_ships_and_seeds_differ) {
  const std::string once = truth_text(make(1500, 4));
  EXPECT_EQ(once, truth_text(make(1500, 4)));
  EXPECT_NE(once, truth_text(make(1500, 5)));
}

TEST(Ship, is_finished_as_it_comes) {
  const Ship ship = make(1200, 2);
  model::Model copy = ship.model;
  model::finish(copy);
  ASSERT_EQ(copy.objects.size(), ship.model.objects.size());
  for (std::size_t i = 0; i < copy.objects.size(); ++i) {
    EXPECT_EQ(copy.objects[i].id, ship.model.objects[i].id);
    EXPECT_EQ(copy.objects[i].first_body, ship.model.objects[i].first_body);
  }
  EXPECT_EQ(copy.diagnostics.counts().size(), ship.model.diagnostics.counts().size());
}

TEST(Ship, meshes_are_closed_and_come_back_from_float32_metres) {
  const Ship ship = make(4000, 3);
  const std::set<std::uint32_t> reversed = inside_out_shapes(ship);
  for (std::uint32_t s = 0; s < ship.model.shapes.size(); ++s) {
    const auto* mesh = std::get_if<TriangleMesh>(&ship.model.shapes[s]);
    if (mesh == nullptr) continue;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    double six_volumes = 0;
    for (const geometry::Triangle& t : mesh->triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        ++balance[{t[k], t[(k + 1) % 3]}];
        --balance[{t[(k + 1) % 3], t[k]}];
      }
      six_volumes += dot(mesh->vertices[t[0]], cross(mesh->vertices[t[1]], mesh->vertices[t[2]]));
    }
    for (const auto& [edge, count] : balance) ASSERT_EQ(count, 0) << "shape " << s;
    EXPECT_EQ(six_volumes < 0, reversed.contains(s)) << "shape " << s;
    EXPECT_EQ(mesh->faces.size(), mesh->triangles.size());
    for (const Vec3d& v : mesh->vertices)
      for (int k = 0; k < 3; ++k) {
        const auto stored = static_cast<float>(v[k] / 1000);
        EXPECT_EQ(geometry::snap(static_cast<double>(stored) * 1000), geometry::snap(v[k]));
      }
  }
}

std::vector<std::uint32_t> shapes_of_kind(const Ship& ship, std::string_view code) {
  std::vector<std::uint32_t> shapes;
  for (const model::Object& object : ship.model.objects)
    if (object.id.starts_with(code))
      shapes.push_back(model::index(ship.model.bodies[object.first_body].shape));
  return shapes;
}

Result<Ship> with_imported(std::uint64_t objects, std::uint64_t imported, std::uint64_t triangles) {
  ShipOptions options{.objects = objects, .seed = 2};
  options.imported_detail = imported;
  options.imported_triangles = triangles;
  return generate_ship(options, {});
}

TEST(Ship, imported_meshes_are_heavy_closed_and_no_two_alike) {
  const Result<Ship> ship = with_imported(1500, 3, 30000);
  ASSERT_TRUE(ship.has_value());
  EXPECT_EQ(ship->model.objects.size(), 1500U);
  const std::vector<std::uint32_t> shapes = shapes_of_kind(*ship, "IMP");
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(std::set(shapes.begin(), shapes.end()).size(), 3U);
  std::set<double> volumes;
  for (const std::uint32_t s : shapes) {
    const auto& mesh = std::get<TriangleMesh>(ship->model.shapes[s]);
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), 30000, 3000);
    double six_volumes = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const geometry::Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        ++balance[{t[k], t[(k + 1) % 3]}];
        --balance[{t[(k + 1) % 3], t[k]}];
      }
      six_volumes += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    }
    for (const auto& [edge, count] : balance) ASSERT_EQ(count, 0);
    EXPECT_GT(six_volumes, 0);
    volumes.insert(six_volumes);
  }
  EXPECT_EQ(volumes.size(), 3U);
}

TEST(Ship, what_is_imported_stands_on_its_bed) {
  for (const std::uint64_t objects : {100U, 101U, 120U, 400U}) {
    const Result<Ship> ship = with_imported(objects, 1, 1000);
    ASSERT_TRUE(ship.has_value());
    EXPECT_EQ(ship->model.objects.size(), objects);
    const auto stands = std::ranges::count_if(ship->truth.pairs, [&](const TruthPair& pair) {
      return ship->model.object(pair.a).id.starts_with("FND") &&
             ship->model.object(pair.b).id.starts_with("IMP");
    });
    EXPECT_EQ(stands, 1) << objects;
  }
}

TEST(Ship, refuses_what_its_deck_has_no_room_for) {
  const Result<Ship> crowded = with_imported(200, 500, 1000);
  ASSERT_FALSE(crowded.has_value());
  EXPECT_EQ(crowded.error().code, ErrorCode::usage);
  EXPECT_EQ(crowded.error().where, "--imported-detail");
  EXPECT_EQ(with_imported(200, 1, 999).error().where, "--imported-triangles");
}

TEST(Ship, nothing_lies_near_a_threshold) {
  for (const bool turned : {false, true}) {
    const Ship ship = make(6000, 7, turned);
    const Result<model::Scene> scene = model::make_scene(ship.model, {}, {});
    ASSERT_TRUE(scene.has_value());
    const auto thickness = [&](model::ObjectId id) {
      double least = 1e300;
      for (const model::GridBody& body : scene->bodies_of(id))
        for (const geometry::Part& part : scene->shapes[body.grid_shape].parts) {
          EXPECT_EQ(part.kind, geometry::PartKind::solid) << ship.model.object(id).id;
          least = std::min(least, part.thickness() * geometry::kMmPerGrid);
        }
      return least;
    };
    for (const TruthPair& pair : ship.truth.pairs) {
      const double overlap = std::min({1.0, thickness(pair.a) / 4, thickness(pair.b) / 4});
      for (const double threshold : {-overlap, 1.0, Truth::kClearanceMm})
        EXPECT_GE(std::fabs(pair.d_mm - threshold), 0.5)
            << ship.model.object(pair.a).id << " " << ship.model.object(pair.b).id;
    }
  }
}

TEST(Ship, plants_every_kind_of_fault_and_some_solids_inside_out) {
  const Ship ship = make(20000, 1);
  std::set<std::uint8_t> reasons;
  for (const TruthPair& pair : ship.truth.pairs) reasons.insert(pair.why);
  EXPECT_EQ(reasons.size(), ship.truth.reasons.size());
  EXPECT_GT(ship.truth.inside_out.size(), 10U);
  EXPECT_TRUE(std::any_of(ship.model.bodies.begin(), ship.model.bodies.end(),
                          [](const model::Body& body) { return body.color.alpha < 255; }));
  EXPECT_TRUE(
      std::any_of(ship.model.bodies.begin(), ship.model.bodies.end(),
                  [](const model::Body& body) { return body.placement.linear.determinant() < 0; }))
      << "mirrored instances belong to a ship";
}

TEST(Ship, a_small_ship_has_hits_near_misses_and_shared_shapes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Ship ship = make(1000, seed);
    std::size_t hits = 0, near = 0;
    for (const TruthPair& pair : ship.truth.pairs) {
      hits += pair.cls == clash::Class::hit ? 1 : 0;
      near += pair.cls == clash::Class::clearance_violation ? 1 : 0;
    }
    EXPECT_GE(hits, 3U) << "seed " << seed;
    EXPECT_GE(near, 2U) << "seed " << seed;
    EXPECT_LT(ship.model.shapes.size(), 300U) << "seed " << seed;
  }
}

TEST(Ship, truth_file_states_what_the_truth_holds) {
  const Ship ship = make(2500, 6);
  const nlohmann::json truth = nlohmann::json::parse(truth_text(ship));
  EXPECT_EQ(truth["schema_version"], 1);
  EXPECT_EQ(truth["generator"]["objects"], 2500);
  EXPECT_EQ(truth["inside_out"].size(), ship.truth.inside_out.size());
  ASSERT_EQ(truth["pairs"].size(), ship.truth.pairs.size());
  std::map<std::string, std::uint64_t> counts{
      {"HIT", 0}, {"CONTACT", 0}, {"CLEARANCE_VIOLATION", 0}};
  for (std::size_t i = 0; i < ship.truth.pairs.size(); ++i) {
    const nlohmann::json& pair = truth["pairs"][i];
    EXPECT_EQ(pair["a"], ship.model.object(ship.truth.pairs[i].a).id);
    EXPECT_EQ(pair["b"], ship.model.object(ship.truth.pairs[i].b).id);
    EXPECT_EQ(pair["d_mm"].get<double>(), ship.truth.pairs[i].d_mm);
    ++counts[pair["class"].get<std::string>()];
  }
  EXPECT_EQ(truth["counts"], nlohmann::json(counts));
}

}  // namespace
}  // namespace strake::generate
