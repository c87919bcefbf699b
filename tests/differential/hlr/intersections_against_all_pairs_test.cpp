// SPDX-License-Identifier: Apache-2.0
// Intersections of whole scenes against those of all pairs of parts, by all pairs of triangles: no
// boxes, no parting planes, no sharing of equal pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/intersect/intersection_lines.hpp"
#include "hlr/edges/intersection_lines.hpp"
#include "strake/generate/ship.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/lattice_scene.hpp"
#include "support/rotations.hpp"
#include "support/rounds.hpp"

namespace strake::hlr {
namespace {

struct Skin {
  geometry::PlacedPart placed;
  std::uint32_t body = 0, object = 0;
};

std::vector<IntersectionLine> of_all_pairs(const model::Scene& scene,
                                           const std::vector<std::int64_t>& contact,
                                           bool of_parts) {
  std::vector<Skin> skins;
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const model::GridBody& body = scene.bodies[b];
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
      if (!part.triangles.empty())
        skins.push_back({{&part, body.origin}, b, model::index(body.object)});
  }
  std::vector<IntersectionLine> all;
  for (std::size_t i = 0; i < skins.size(); ++i)
    for (std::size_t j = i + 1; j < skins.size(); ++j) {
      const Skin &x = skins[i], &y = skins[j];
      if (x.object == y.object && !of_parts) continue;
      geometry::QueryContext work;
      for (const geometry::Segment& line : geometry::part_intersection_lines_brute_force(
               x.placed, y.placed, std::max(contact[x.body], contact[y.body]), work))
        all.push_back({line[0] + x.placed.origin, line[1] + x.placed.origin, x.body, y.body});
    }
  return all;
}

bool same(const IntersectionLine& x, const IntersectionLine& y) {
  return x.a == y.a && x.b == y.b && x.body_a == y.body_a && x.body_b == y.body_b;
}

/// How many there are, and how many pairs were searched.
struct Observation {
  std::size_t lines = 0;
  std::uint64_t pairs = 0;
};

Observation observe(const model::Scene& scene, Intersections which,
                    const parallel::Context& context = {}) {
  const std::vector<bool> drawn(scene.model->objects.size(), true);
  std::vector<std::int64_t> contact(scene.bodies.size());
  for (std::size_t b = 0; b < contact.size(); ++b) contact[b] = static_cast<std::int64_t>(b % 4);
  const auto found = find_intersection_lines(scene, drawn, contact, {which}, context);
  if (!found) {
    ADD_FAILURE() << found.error().text();
    return {};
  }
  const std::vector<IntersectionLine> expected =
      of_all_pairs(scene, contact, which == Intersections::parts);
  EXPECT_TRUE(std::ranges::equal(found->all, expected, same))
      << found->all.size() << " lines for " << expected.size();
  return {expected.size(), found->pairs};
}

TEST(IntersectionsAgainstAllPairs, LatticeScenesStraightAndAskew) {
  constexpr std::uint64_t kScenes = test::rounds<std::uint64_t>(150);
  Observation all;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed)
    for (const bool askew : {false, true}) {
      SCOPED_TRACE(seed);
      test::LatticeOptions options{.unit = 1000};
      if (askew)
        options.edit = [](test::HandPart& part) {
          for (geometry::Vec3i& v : part.vertices) {
            const geometry::Vec3d p = test::kTurn * v.as<double>();
            for (int k = 0; k < 3; ++k) v[k] = static_cast<std::int32_t>(std::lround(p[k]));
          }
        };
      const test::SceneBuilder scene = test::lattice_scene(seed, options);
      for (const Intersections which : {Intersections::objects, Intersections::parts}) {
        const Observation observed = observe(scene.scene(), which);
        all.lines += observed.lines;
        all.pairs += observed.pairs;
      }
    }
  EXPECT_GT(all.lines, kScenes);
  EXPECT_GT(all.pairs, kScenes);
}

/// So many objects of two boxes at one place, which pass through each other where `crossing`, a
/// few of them elsewhere, and a bar through all.
test::SceneBuilder stacked(int copies, bool crossing, bool one_part) {
  test::SceneBuilder scene;
  test::HandPart box = test::hand_box({0, 0, 0}, {900, 800, 700});
  test::HandPart second = test::hand_box({crossing ? 400 : 2000, 300, 200}, {3000, 500, 900});
  if (one_part) {
    for (const geometry::Triangle& t : second.triangles)
      box.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    box.vertices.insert(box.vertices.end(), second.vertices.begin(), second.vertices.end());
    box.faces.clear();
    scene.object({{.parts = {box}, .origin = {}}});
  } else {
    scene.object({{.parts = {box, second}, .origin = {}}});
  }
  for (int i = 1; i < copies; ++i) scene.instance(0, {i % 7 == 3 ? 50 : 0, 0, 0});
  scene.object({{.parts = {test::hand_box({-500, 100, 100}, {5000, 350, 300})}, .origin = {}}});
  return scene;
}

TEST(IntersectionsAgainstAllPairs, ManyEqualObjectsAtOnePlace) {
  std::size_t lines = 0;
  for (const int copies : {2, 9, 40})
    for (const bool crossing : {false, true})
      for (const bool one_part : {false, true})
        for (const Intersections which : {Intersections::objects, Intersections::parts}) {
          SCOPED_TRACE(::testing::Message() << copies << crossing << one_part);
          lines += observe(stacked(copies, crossing, one_part).scene(), which).lines;
        }
  EXPECT_GT(lines, 1000U);
}

TEST(IntersectionsAgainstAllPairs, EqualObjectsAtOnePlaceAreNoPairs) {
  const auto met = [](int copies) {
    test::SceneBuilder scene;
    scene.object({{.parts = {test::hand_box({0, 0, 0}, {900, 800, 700})}, .origin = {}}});
    for (int i = 1; i < copies; ++i) scene.instance(0, {0, 0, 0});
    scene.object({{.parts = {test::hand_box({-500, 100, 100}, {5000, 350, 300})}, .origin = {}}});
    const std::vector<std::int64_t> contact(scene.scene().bodies.size(), 3);
    const std::vector<bool> drawn(scene.scene().model->objects.size(), true);
    return find_intersection_lines(scene.scene(), drawn, contact, {Intersections::primitives}, {})
        ->met;
  };
  EXPECT_GT(met(100), 0U);
  EXPECT_LE(met(10'000), 101 * met(100));
}

TEST(IntersectionsAgainstAllPairs, ShipStraightAndAskew) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team};
  Observation all;
  for (const bool turned : {false, true}) {
    const auto ship = generate::generate_ship({100, 1, turned}, context);
    ASSERT_TRUE(ship);
    const auto scene = model::make_scene(ship->model, {}, context);
    ASSERT_TRUE(scene);
    const Observation observed = observe(*scene, Intersections::objects, context);
    // Of some thousand pairs; flush ones are reported by planes, whether the ship stands askew or
    // not.
    EXPECT_LT(observed.pairs, 4 * ship->model.objects.size());
    all.lines += observed.lines;
    all.pairs += observed.pairs;
  }
  EXPECT_GT(all.lines, 0U);
  EXPECT_GT(all.pairs, 0U);
}

}  // namespace
}  // namespace strake::hlr
