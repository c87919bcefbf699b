// SPDX-License-Identifier: Apache-2.0
// Pairs heavy enough to have a team to themselves: the truth, and the same bytes for any team.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using namespace strake::test;

struct Scene {
  std::string title;
  TriangleMesh a, b;
  Vec3d shift;
  Options options;
  Class cls = Class::no_hit;
  Relation relation = Relation::separate;
  double d_mm = 0, slack_mm = 0;
  std::string shared_region;  ///< what the team must have helped with
};

/// All that a report says of its pairs and of what they cost, bit by bit.
std::vector<std::uint64_t> bits_of(const Report& report) {
  std::vector<std::uint64_t> bits;
  const auto add = [&](double x) { bits.push_back(std::bit_cast<std::uint64_t>(x)); };
  for (const Pair& pair : report.pairs) {
    bits.push_back(static_cast<std::uint64_t>(pair.cls));
    bits.push_back(static_cast<std::uint64_t>(pair.relation));
    bits.push_back(pair.flags);
    add(pair.d_mm);
    add(pair.d_lower_mm);
    add(pair.d_upper_mm);
    for (const Vec3d& p : {pair.point_mm, pair.on_a_mm, pair.on_b_mm})
      for (int k = 0; k < 3; ++k) add(p[k]);
  }
  for (const LoggedPair& pair : report.log)
    bits.insert(bits.end(), {pair.node_pairs, pair.triangle_pairs, pair.exact_fallbacks,
                             pair.depth_cells, static_cast<std::uint64_t>(pair.cls)});
  return bits;
}

void expect_truth(const Scene& scene, const Report& report) {
  ASSERT_EQ(report.pairs.size(), 1U);
  const Pair& pair = report.pairs.front();
  EXPECT_EQ(pair.cls, scene.cls);
  EXPECT_EQ(pair.relation, scene.relation);
  EXPECT_LE(pair.d_lower_mm, scene.d_mm + scene.slack_mm);
  EXPECT_GE(pair.d_upper_mm, scene.d_mm - scene.slack_mm);
}

void check(Scene scene) {
  SCOPED_TRACE(scene.title);
  ClashModel m;
  m.object("a").body(std::move(scene.a));
  m.object("b").body(std::move(scene.b), {{}, scene.shift});
  scene.options.engine.log_pairs = true;
  const Report alone = m.detect(scene.options);
  expect_truth(scene, alone);
  const std::vector<std::uint64_t> expected = bits_of(alone);
  constexpr std::array kThreads{2U, 64U, 3U, 8U};
  for (const unsigned threads : std::span(kThreads).first(test::kSanitized ? 2 : 4)) {
    parallel::Team team(threads);
    parallel::RunReport costs;
    const Report report = m.detect(scene.options, {.team = &team, .report = &costs});
    EXPECT_EQ(report.hash, alone.hash) << threads << " threads";
    EXPECT_EQ(bits_of(report), expected) << threads << " threads";
    std::uint64_t shared = 0;
    for (const parallel::RegionReport& region : costs.regions())
      if (region.name == scene.shared_region) shared = region.runs;
    EXPECT_GT(shared, 0U) << scene.shared_region << ", " << threads << " threads";
  }
}

constexpr std::uint32_t kRings = 190;  // 140,000 triangles, 72,000 vertices

TEST(HeavyPairs, nested_spheres) {
  check({.title = "0.2 mm apart",
         .a = sphere_mesh(1000, kRings),
         .b = sphere_mesh(999.8, 100),
         .shift = {},
         .options = {},
         .cls = Class::hit,
         .relation = Relation::b_in_a,
         .d_mm = -1000,
         .slack_mm = 1,
         .shared_region = "pieces of a pair"});
}

TEST(HeavyPairs, the_same_body_three_micrometres_aside) {
  const TriangleMesh hills = bumpy_mesh(1000, 60, 12, kRings);
  check({.title = "3 um aside",
         .a = hills,
         .b = hills,
         .shift = {0.003, 0, 0},
         .options = {.contact_distance_mm = 0.01},
         .cls = Class::hit,
         .relation = Relation::duplicate,
         .d_mm = -950,
         .slack_mm = 60,
         .shared_region = "pieces of a skin"});
}

TEST(HeavyPairs, beside_each_other_within_the_clearance) {
  check({.title = "2 mm apart",
         .a = cylinder_mesh(500, 2000, 2, 600),
         .b = cylinder_mesh(510, 2000, 190, 380),
         .shift = {1012, 0, 0},
         .options = {.tolerances = {.clearance_mm = 25}},
         .cls = Class::clearance_violation,
         .relation = Relation::separate,
         .d_mm = 2,
         .slack_mm = 0.1,
         .shared_region = "tree levels"});
}

TEST(HeavyPairs, fans_of_needles_aside_of_each_other) {
  const auto stand = [](TriangleMesh m, const Vec3d& at) {
    for (Vec3d& v : m.vertices) {
      v = v + at;
      v = {0.6 * v.x + 0.8 * v.z, v.y, 0.6 * v.z - 0.8 * v.x};
    }
    return m;
  };
  for (const double gap : {0.0, 3.0})
    check({.title = "discs",
           .a = stand(cylinder_mesh(500, 10, 1, 25000), {}),
           .b = stand(cylinder_mesh(400, 10, 1, 6000), {100, 170, 10 + gap}),
           .shift = {},
           .options = {.tolerances = {.clearance_mm = 25}},
           .cls = gap > 0 ? Class::clearance_violation : Class::contact,
           .relation = gap > 0 ? Relation::separate : Relation::abut_outside,
           .d_mm = gap,
           .slack_mm = 0.004,
           .shared_region = "tree pieces"});
}

TEST(HeavyPairs, one_that_meets_a_small_body) {
  check({.title = "a ball on a box",
         .a = sphere_mesh(1000, kRings),
         .b = box_mesh({-100, -100, -100}, {100, 100, 100}),
         .shift = {0, 0, 1050},
         .options = {},
         .cls = Class::hit,
         .relation = Relation::interfere,
         .d_mm = -50,
         .slack_mm = 1,
         .shared_region = "tree pieces"});
}

}  // namespace
}  // namespace strake::clash
