// SPDX-License-Identifier: Apache-2.0
// One result, to the last bit: for any team, either broad phase, either order of the sets, any
// order of the objects, and (the hashes below are part of the sources) for GCC and Clang, optimised
// or not. A change of results on purpose changes these hashes, and says so in CHANGELOG.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::clash {
namespace {

struct Golden {
  bool turned = false;
  const char* hash = "";
  const char* without_regions = "";
};

class GoldenClash : public testing::TestWithParam<Golden> {
 protected:
  static model::Model ship() {
    constexpr std::uint64_t kObjects = 600, kSeed = 7;
    auto made = generate::generate_ship({kObjects, kSeed, GetParam().turned}, {});
    EXPECT_TRUE(made.has_value());
    return std::move(made->model);
  }

  static Options options() { return {.tolerances = {.clearance_mm = 25}}; }

  static model::Scene scene_of(const model::Model& model) {
    return model::make_scene(model, scene_options(options()), {}).value();
  }
};

TEST_P(GoldenClash, IsThisOnEveryCompiler) {
  const model::Model model = ship();
  const model::Scene scene = scene_of(model);
  const Report report = detect(scene, one_set(scene), options(), {}).value();
  EXPECT_GT(report.count_hit, 0U);
  EXPECT_GT(report.count_contact, 100U);
  EXPECT_EQ(report.hash, GetParam().hash);
  EXPECT_GT(report.regions.size(), 10U);
  Options without = options();
  without.engine.max_regions = 0;
  EXPECT_EQ(detect(scene, one_set(scene), without, {})->hash, GetParam().without_regions);
}

TEST_P(GoldenClash, IsTheSameForAnyTeamAndBroadPhase) {
  const model::Model model = ship();
  const model::Scene scene = scene_of(model);
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(workers);
    parallel::Context context;
    context.team = &team;
    const model::Scene same = model::make_scene(model, scene_options(options()), context).value();
    EXPECT_EQ(detect(same, one_set(same), options(), context)->hash, GetParam().hash) << workers;
  }
  Options all_pairs = options();
  all_pairs.engine.broad_phase = BroadPhase::all_pairs;
  EXPECT_EQ(detect(scene, one_set(scene), all_pairs, {})->hash, GetParam().hash);
}

TEST_P(GoldenClash, IsTheSameWithTheSetsExchanged) {
  const model::Model model = ship();
  const model::Scene scene = scene_of(model);
  Sets sets = one_set(scene);
  for (std::size_t i = 0; i < sets.in_a.size(); ++i) {
    sets.in_a[i] = i % 3 != 0;
    sets.in_b[i] = i % 2 == 0;
  }
  const Report report = detect(scene, sets, options(), {}).value();
  std::swap(sets.in_a, sets.in_b);
  EXPECT_EQ(detect(scene, sets, options(), {})->hash, report.hash);
}

/// Sources list objects in any order: the model puts them in that of their ids.
TEST_P(GoldenClash, IsTheSameForObjectsInAnyOrder) {
  model::Model model = ship();
  std::reverse(model.objects.begin(), model.objects.end());
  std::rotate(model.objects.begin(), model.objects.begin() + 17, model.objects.end());
  model::finish(model);
  const model::Scene scene = scene_of(model);
  EXPECT_EQ(detect(scene, one_set(scene), options(), {})->hash, GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Ships, GoldenClash,
                         testing::Values(Golden{false, "79aeb0066faf07c4651a51e6c0591115",
                                                "87a7a703bd59363ac910d3801d075dcf"},
                                         Golden{true, "43135fc4b6028273a2d89c435026b6cf",
                                                "85863805290c0c6ac2b5a4da4890b4ee"}),
                         [](const auto& given) {
                           return given.param.turned ? "turned" : "straight";
                         });

}  // namespace
}  // namespace strake::clash
