// SPDX-License-Identifier: Apache-2.0
// Depths of the pairs that plants are made of, beside closed forms and many points moved uphill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "strake/geometry/depth.hpp"
#include "support/deep_pairs.hpp"
#include "support/rounds.hpp"

namespace strake::test {
namespace {

using geometry::Depth;

/// Nothing where the two have no interior in common.
std::optional<Depth> depth_of(const DeepPair& pair) {
  const DeepPairTest subject(pair);
  return subject.meets() ? std::optional(subject.depth()) : std::nullopt;
}

class DeepPairs : public ::testing::TestWithParam<DeepKind> {
 protected:
  template <class Law>
  static void over_pairs(const Law& law) {
    int met = 0;
    for (std::uint64_t seed = 1; seed <= rounds<std::uint64_t>(5, 400); ++seed) {
      const DeepPair pair = draw_deep_pair(GetParam(), seed);
      SCOPED_TRACE(pair.recipe);
      const auto depth = depth_of(pair);
      if (!depth) continue;
      ++met;
      law(pair, *depth, seed);
    }
    EXPECT_GT(met, 0);
  }
};

TEST_P(DeepPairs, NoPointThatIsFoundOtherwiseIsDeeper) {
  over_pairs([](const DeepPair& pair, const Depth& depth, std::uint64_t seed) {
    const double found = sampled_depth(snapped(pair.a), snapped(pair.b), seed, 40);
    EXPECT_LE(depth.lower, depth.value);
    EXPECT_LE(depth.value, depth.upper);
    EXPECT_LE(found, depth.upper + 1e-3);
    EXPECT_LE(found, depth.value + tolerance(found));
  });
}

/// None is so hard that the work limit ends the search.
TEST_P(DeepPairs, BracketsAreNarrow) {
  over_pairs([](const DeepPair&, const Depth& depth, std::uint64_t) {
    EXPECT_LE(depth.upper - depth.lower, tolerance(depth.value));
  });
}

TEST_P(DeepPairs, ClosedForms) {
  // What the snap of corners, and of a turn, moves.
  constexpr double kSnap = 3;
  over_pairs([](const DeepPair& pair, const Depth& depth, std::uint64_t) {
    if (!pair.depth) return;
    const double known = *pair.depth * 1000;
    EXPECT_LE(known, depth.upper + kSnap);
    EXPECT_LE(known, depth.value + tolerance(known));
  });
}

TEST_P(DeepPairs, TheSameHoweverTheTwoAreTurned) {
  over_pairs([](const DeepPair& pair, const Depth& depth, std::uint64_t seed) {
    const auto turned = depth_of(turned_together(pair, seed));
    ASSERT_TRUE(turned);
    EXPECT_NEAR(depth.value, turned->value, std::max(3.0, 1e-3 * depth.value));
  });
}

INSTANTIATE_TEST_SUITE_P(Kinds, DeepPairs,
                         ::testing::Values(DeepKind::insulation, DeepKind::sections,
                                           DeepKind::in_line, DeepKind::round_convex,
                                           DeepKind::springs, DeepKind::slivers),
                         [](const auto& kind) { return std::string(name(kind.param)); });

}  // namespace
}  // namespace strake::test
