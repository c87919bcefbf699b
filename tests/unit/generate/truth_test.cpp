// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "strake/generate/ship.hpp"
#include "support/brute_distance.hpp"

namespace strake::generate {
namespace {

using clash::Class;
using test::WorldObject;

struct Case {
  std::uint64_t objects, seed;
  bool turned;
};

Ship ship_of(const Case& c) {
  Result<Ship> ship = generate_ship({c.objects, c.seed, c.turned}, {});
  EXPECT_TRUE(ship.has_value());
  return std::move(ship.value());
}

std::vector<WorldObject> world_of(const Ship& ship) {
  std::vector<WorldObject> world;
  for (const model::Object& object : ship.model.objects)
    world.push_back(test::world_object(ship.model, object));
  return world;
}

/// Boxes and triangle distances in doubles, straight from the model: what the truth leaves out is
/// far away, and what it lists has the distance that it says.
class TruthAgainstBruteForce : public testing::TestWithParam<Case> {};

TEST_P(TruthAgainstBruteForce, every_near_pair_is_declared) {
  const Ship ship = ship_of(GetParam());
  const std::vector<WorldObject> world = world_of(ship);
  std::map<std::pair<std::uint32_t, std::uint32_t>, const TruthPair*> declared;
  for (const TruthPair& pair : ship.truth.pairs) {
    const auto [place, fresh] =
        declared.try_emplace({model::index(pair.a), model::index(pair.b)}, &pair);
    ASSERT_LT(pair.a, pair.b);
    ASSERT_TRUE(fresh) << "declared twice: " << ship.model.object(pair.a).id << " "
                       << ship.model.object(pair.b).id;
  }
  constexpr double kReach = 25.5;
  std::size_t found = 0, wrong = 0;
  for (const auto& [a, b] : test::near_boxes(world, kReach)) {
    const auto known = declared.find({a, b});
    const double d = test::surface_distance(world[a], world[b], 30);
    const std::string names = ship.model.objects[a].id + " " + ship.model.objects[b].id;
    if (known == declared.end()) {
      const bool buried = test::inside(world[a], world[b].triangles[0][0]) ||
                          test::inside(world[b], world[a].triangles[0][0]);
      if ((d < kReach || buried) && ++wrong < 40)
        ADD_FAILURE() << "undeclared: " << names << " d " << d << (buried ? " buried" : "");
      continue;
    }
    ++found;
    const TruthPair& pair = *known->second;
    const bool fits = pair.d_mm >= 0 ? std::fabs(d - pair.d_mm) < 2e-3
                                     : d < 1e-3 || test::sampled_depth(world[a], world[b], 4) > 0;
    if (!fits && ++wrong < 40)
      ADD_FAILURE() << names << ": " << ship.truth.reasons[pair.why] << " says " << pair.d_mm
                    << ", measured " << d;
  }
  for (const auto& [key, pair] : declared)
    if (!test::near_boxes({world[key.first], world[key.second]}, 25.5).size() && ++wrong < 40)
      ADD_FAILURE() << "declared but far apart: " << ship.model.object(pair->a).id << " "
                    << ship.model.object(pair->b).id;
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(found, declared.size());
}

TEST_P(TruthAgainstBruteForce, depth_is_what_the_construction_states) {
  const Ship ship = ship_of(GetParam());
  if (ship.options.objects > 2000) GTEST_SKIP() << "sampling is for the small ships";
  const std::vector<WorldObject> world = world_of(ship);
  std::size_t hits = 0;
  for (const TruthPair& pair : ship.truth.pairs) {
    if (pair.cls == Class::clearance_violation) continue;
    const WorldObject &a = world[model::index(pair.a)], &b = world[model::index(pair.b)];
    const std::string names = ship.model.object(pair.a).id + " " + ship.model.object(pair.b).id;
    if (pair.cls == Class::hit) {
      ++hits;
      const double depth = test::sampled_depth(a, b, 9);
      EXPECT_LE(depth, -pair.d_mm + 2e-3) << names;
      EXPECT_GE(depth, -pair.d_mm * 0.97) << names << " " << ship.truth.reasons[pair.why];
    } else {
      EXPECT_LE(test::sampled_depth(a, b, 4), std::max(0.0, -pair.d_mm) + 2e-3) << names;
    }
  }
  if (ship.options.objects >= 1000) {
    EXPECT_GT(hits, 2U);
  }
}

INSTANTIATE_TEST_SUITE_P(ships, TruthAgainstBruteForce,
                         testing::Values(Case{100, 1, false}, Case{1000, 1, false},
                                         Case{1000, 2, false}, Case{2000, 5, false},
                                         Case{200, 3, true}, Case{20000, 1, false},
                                         Case{20000, 8, false}),
                         [](const auto& test_case) {
                           return "of_" + std::to_string(test_case.param.objects) + "_seed_" +
                                  std::to_string(test_case.param.seed) +
                                  (test_case.param.turned ? "_turned" : "");
                         });

}  // namespace
}  // namespace strake::generate
