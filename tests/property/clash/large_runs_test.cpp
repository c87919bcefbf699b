// SPDX-License-Identifier: Apache-2.0
// Clash runs of more objects than a worker takes at once find the same for any team, in all that
// they count, too.
#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::clash {
namespace {

constexpr std::uint64_t kObjects = 20'000;

auto fields(const Counters& work) {
  return std::tie(work.candidate_pairs, work.part_pairs, work.triangle_pairs, work.exact_fallbacks,
                  work.depth_cells);
}

auto fields(const Pair& pair) {
  return std::tie(pair.a, pair.b, pair.cls, pair.relation, pair.flags, pair.d_mm, pair.d_lower_mm,
                  pair.d_upper_mm, pair.point_mm, pair.regions, pair.first_region);
}

void expect_equal(const Report& found, const Report& expected) {
  EXPECT_EQ(found.hash, expected.hash);
  EXPECT_EQ(fields(found.counters), fields(expected.counters));
  EXPECT_EQ(found.sheets, expected.sheets);
  EXPECT_EQ(found.unlisted.contacts, expected.unlisted.contacts);
  EXPECT_EQ(found.contact_distance_mm, expected.contact_distance_mm);
  ASSERT_EQ(found.pairs.size(), expected.pairs.size());
  for (std::size_t i = 0; i < expected.pairs.size(); ++i)
    ASSERT_EQ(fields(found.pairs[i]), fields(expected.pairs[i])) << "pair " << i;
}

TEST(LargeRuns, FindTheSameForAnyTeam) {
  const auto ship = generate::generate_ship({.objects = kObjects}, {});
  ASSERT_TRUE(ship.has_value()) << ship.error().text();
  Options options{.tolerances = {.clearance_mm = generate::Truth::kClearanceMm}};
  const auto scene = model::make_scene(ship->model, scene_options(options), {});
  ASSERT_TRUE(scene.has_value()) << scene.error().text();
  for (const bool whole : {true, false}) {
    SCOPED_TRACE(whole ? "with regions" : "contacts counted, no regions");
    if (!whole) {
      options.engine.max_regions = 0;
      options.engine.contacts = Contacts::count;
    }
    const auto expected = detect(*scene, one_set(*scene), options, {});
    ASSERT_TRUE(expected.has_value()) << expected.error().text();
    ASSERT_GT(expected->counters.part_pairs, 2 * 16'384U) << "of several blocks";
    for (const unsigned workers : {2U, 3U, 8U}) {
      parallel::Team team(workers);
      const auto found = detect(*scene, one_set(*scene), options, {.team = &team});
      ASSERT_TRUE(found.has_value()) << found.error().text();
      expect_equal(*found, *expected);
    }
  }
}

}  // namespace
}  // namespace strake::clash
