// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"

namespace strake::clash {
namespace {

/// A ship with planted clashes, copies of objects and sheets in place of some solids.
class UnlistedContacts : public testing::Test {
 protected:
  void SetUp() override {
    auto ship = generate::generate_ship({1000, 5, true}, {});
    ASSERT_TRUE(ship.has_value());
    model_ = std::move(ship->model);
    auto scene = model::make_scene(model_, {}, {});
    ASSERT_TRUE(scene.has_value());
    scene_ = std::move(*scene);
  }

  [[nodiscard]] Report detect(Contacts contacts, unsigned workers, double clearance_mm = 25) const {
    parallel::Team team(workers);
    Options options{.tolerances = {.clearance_mm = clearance_mm}};
    options.engine.contacts = contacts;
    auto report =
        clash::detect(scene_, one_set(scene_), options, {.team = workers > 1 ? &team : nullptr});
    EXPECT_TRUE(report.has_value());
    return std::move(*report);
  }

  static bool same_pair(const Pair& x, const Pair& y) {
    return x.a == y.a && x.b == y.b && x.cls == y.cls && x.relation == y.relation &&
           x.d_mm == y.d_mm && x.flags == y.flags && x.regions == y.regions;
  }

  model::Model model_;
  model::Scene scene_;
};

TEST_F(UnlistedContacts, WhatIsListedIsAllButContactsThatLieSideBySide) {
  const Report all = detect(Contacts::list, 1);
  std::vector<Pair> expected;
  std::uint64_t left_out = 0;
  for (const Pair& pair : all.pairs) {
    const bool plain =
        pair.cls == Class::contact && (pair.flags & kUncertain) == 0 &&
        pair.severest == Class::contact &&
        (pair.relation == Relation::abut_outside || pair.relation == Relation::separate);
    if (plain)
      ++left_out;
    else
      expected.push_back(pair);
  }
  ASSERT_GT(left_out, 500U);
  ASSERT_GT(expected.size(), 5U);
  for (const unsigned workers : {1U, 3U}) {
    const Report counted = detect(Contacts::count, workers);
    EXPECT_EQ(counted.unlisted.contacts, left_out);
    EXPECT_EQ(counted.unlisted.allowed, 0U);
    EXPECT_TRUE(std::ranges::equal(counted.pairs, expected, same_pair));
    EXPECT_EQ(counted.hash, all.hash) << "what was found is the same";
    EXPECT_EQ(counted.count_contact, all.count_contact);
    EXPECT_EQ(counted.count_hit, all.count_hit);
    EXPECT_EQ(counted.count_clearance, all.count_clearance);
  }
}

TEST_F(UnlistedContacts, RegionsAreStillThoseOfTheirPairs) {
  const Report all = detect(Contacts::list, 1, 100), counted = detect(Contacts::count, 1, 100);
  std::size_t with_regions = 0;
  for (const Pair& pair : counted.pairs) {
    const auto same = std::ranges::find_if(
        all.pairs, [&](const Pair& p) { return p.a == pair.a && p.b == pair.b; });
    ASSERT_NE(same, all.pairs.end());
    const std::uint32_t listed = pair.regions_listed(counted.options);
    ASSERT_EQ(listed, same->regions_listed(all.options));
    for (std::uint32_t r = 0; r < listed; ++r)
      EXPECT_EQ(counted.regions[pair.first_region + r].point_mm,
                all.regions[same->first_region + r].point_mm);
    with_regions += listed > 0 ? 1U : 0U;
  }
  EXPECT_GT(with_regions, 0U);
}

TEST_F(UnlistedContacts, NothingIsCountedWhereAllAreListed) {
  const Report all = detect(Contacts::list, 1);
  EXPECT_EQ(all.unlisted.contacts + all.unlisted.allowed, 0U);
}

}  // namespace
}  // namespace strake::clash
