// SPDX-License-Identifier: Apache-2.0
// The bare question against a generated ship: the same pairs as the exact test of every pair of
// parts whose boxes meet, for any team and either broad phase.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/overlaps.hpp"
#include "strake/generate/ship.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::clash {
namespace {

struct Body {
  std::uint32_t object = 0;
  geometry::PlacedPart placed;
  geometry::TriangleBvh tree;
  geometry::Box3l box;
};

class OverlapsOfAShip : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    Result<generate::Ship> made = generate::generate_ship({900, 3, GetParam()}, {});
    ASSERT_TRUE(made.has_value());
    ship_ = std::move(*made);
    Result<model::Scene> scene = model::make_scene(ship_.model, {}, {});
    ASSERT_TRUE(scene.has_value());
    scene_ = std::move(*scene);
  }

  /// Without any filter but boxes.
  [[nodiscard]] std::vector<ObjectPair> expected() const {
    std::vector<Body> bodies;
    for (std::uint32_t o = 0; o < ship_.model.objects.size(); ++o)
      for (const model::GridBody& body : scene_.bodies_of(model::ObjectId{o}))
        for (const geometry::Part& part : scene_.shapes[body.grid_shape].parts) {
          if (part.triangles.empty()) continue;
          const geometry::Box3l box{part.box.lo.as<std::int64_t>() + body.origin,
                                    part.box.hi.as<std::int64_t>() + body.origin};
          bodies.push_back({o, {&part, body.origin}, geometry::TriangleBvh(part), box});
        }
    std::vector<ObjectPair> pairs;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        const Body &x = bodies[i], &y = bodies[j];
        if (x.object == y.object || !x.box.meets(y.box)) continue;
        const ObjectPair pair{model::ObjectId{x.object}, model::ObjectId{y.object}};
        geometry::QueryContext work;
        const auto met = geometry::meet({x.placed, &x.tree}, {y.placed, &y.tree}, work);
        if (met.meeting != geometry::Meeting::apart) pairs.push_back(pair);
      }
    std::sort(pairs.begin(), pairs.end(), [](const ObjectPair& p, const ObjectPair& q) {
      return std::pair{p.a, p.b} < std::pair{q.a, q.b};
    });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  generate::Ship ship_;
  model::Scene scene_;
};

TEST_P(OverlapsOfAShip, AreThoseOfTheExactTest) {
  const std::vector<ObjectPair> expected = this->expected();
  ASSERT_GT(expected.size(), 300U);
  for (const unsigned threads : {1U, 2U, 8U})
    for (const BroadPhase broad : {BroadPhase::tree, BroadPhase::all_pairs}) {
      SCOPED_TRACE(threads);
      parallel::Team team(threads);
      const parallel::Context context{.team = &team, .stop = {}};
      const Options options{.engine = {.broad_phase = broad}};
      const auto found = overlapping_pairs(scene_, one_set(scene_), options, context);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(*found, expected);
    }
}

TEST_P(OverlapsOfAShip, SetsAreHeld) {
  Sets sets = one_set(scene_);
  for (std::size_t i = 0; i < sets.in_a.size(); ++i) {
    sets.in_a[i] = i % 3 == 0;
    sets.in_b[i] = i % 3 == 1;
  }
  std::vector<ObjectPair> expected;
  for (const ObjectPair& p : this->expected()) {
    const std::uint32_t a = model::index(p.a) % 3, b = model::index(p.b) % 3;
    if ((a == 0 && b == 1) || (a == 1 && b == 0)) expected.push_back(p);
  }
  const auto found = overlapping_pairs(scene_, sets, {}, {});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(*found, expected);
}

TEST_P(OverlapsOfAShip, SetsOfTheWrongSizeAreRefused) {
  EXPECT_FALSE(overlapping_pairs(scene_, {}, {}, {}));
}

TEST_P(OverlapsOfAShip, Cancelled) {
  const std::stop_source stop;
  stop.request_stop();
  const auto found = overlapping_pairs(scene_, one_set(scene_), {}, {.stop = stop.get_token()});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Ways, OverlapsOfAShip, testing::Bool(), [](const auto& way) {
  return std::string(way.param ? "turned" : "straight");
});

}  // namespace
}  // namespace strake::clash
