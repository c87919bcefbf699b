// SPDX-License-Identifier: Apache-2.0
#include "clash/pairs/classify.hpp"

#include <gtest/gtest.h>

namespace strake::clash {
namespace {

constexpr Thresholds kDefault{.overlap = 1000, .gap = 1000, .clearance = 25000};

Classification at(double lower, double d, double upper, double sag = 0, bool meet = false) {
  return classify({.d = d, .lower = lower, .upper = upper, .sag = sag, .interiors_meet = meet},
                  kDefault);
}

TEST(Classify, Thresholds) {
  EXPECT_EQ(at(-1001, -1001, -1001).cls, Class::hit);
  EXPECT_EQ(at(-1000, -1000, -1000).cls, Class::contact);
  EXPECT_EQ(at(0, 0, 0).cls, Class::contact);
  EXPECT_EQ(at(1000, 1000, 1000).cls, Class::contact);
  EXPECT_EQ(at(1001, 1001, 1001).cls, Class::clearance_violation);
  EXPECT_EQ(at(25000, 25000, 25000).cls, Class::no_hit);
  EXPECT_EQ(at(0, 0, 0).flags, 0);
}

TEST(Classify, NarrowBracketAboutAThresholdIsBorderlineAndSevere) {
  const Classification j = at(-1000.4, -1000, -999.9);
  EXPECT_EQ(j.cls, Class::hit);
  EXPECT_EQ(j.flags, kBorderline);
}

TEST(Classify, WhatTheSnapMovedCountsAtAThresholdButNotAtZero) {
  const SignedSeparation near{.d = 1001, .lower = 1001, .upper = 1001, .moved = 1.7};
  EXPECT_EQ(classify(near, kDefault).cls, Class::contact);
  EXPECT_EQ(classify(near, kDefault).flags, kBorderline);
  const SignedSeparation touch{.d = 0.5, .lower = 0.5, .upper = 0.5, .moved = 1.7};
  EXPECT_EQ(classify(touch, {}).cls, Class::no_hit);
  EXPECT_EQ(classify(touch, {}).flags, 0);
}

/// A separation of two of which one was welded.
Classification welded(double d, double weld, Thresholds t = kDefault) {
  t.weld = weld;
  return classify({.d = d, .lower = d, .upper = d, .sag = weld, .interiors_meet = d < 0}, t);
}

TEST(Classify, WhatAWeldMovedIsNotLost) {
  EXPECT_EQ(welded(25400, 500).cls, Class::clearance_violation);
  EXPECT_EQ(welded(25400, 500).flags, kUncertain);
  EXPECT_EQ(welded(25600, 500).cls, Class::no_hit);
  EXPECT_EQ(welded(1400, 500, {.overlap = 1000, .gap = 1000}).cls, Class::contact);
  EXPECT_EQ(welded(-700, 500).cls, Class::contact);
  EXPECT_EQ(welded(-700, 500).flags, kUncertain);
  EXPECT_EQ(welded(-700, 500).severest, Class::hit);
  EXPECT_EQ(welded(-1600, 500).cls, Class::hit);
  EXPECT_EQ(welded(-1600, 500).flags, 0);
}

TEST(Classify, AWeldBeyondTheSnapCountsAtZero) {
  EXPECT_EQ(welded(1.5, 2, {}).cls, Class::no_hit);
  EXPECT_EQ(welded(0, 2, {}).flags, 0);
  EXPECT_EQ(welded(1001, 2).cls, Class::contact);
  EXPECT_EQ(welded(1001, 2).flags, kBorderline);
  EXPECT_EQ(welded(400, 500, {}).cls, Class::contact);
  EXPECT_EQ(welded(400, 500, {}).severest, Class::hit);
  EXPECT_EQ(welded(600, 500, {}).cls, Class::no_hit);
}

// A lid that lay on a block before it was drawn down to its walls: rounding apart, its whole way.
TEST(Classify, WhatTheSnapMovedCountsAtZeroBesideAWeld) {
  const SignedSeparation lid{.d = 501, .lower = 501, .upper = 501, .sag = 500, .moved = 1.7};
  EXPECT_EQ(classify(lid, {.weld = 500}).cls, Class::contact);
  EXPECT_EQ(classify(lid, {.weld = 500}).severest, Class::hit);
  const SignedSeparation apart{.d = 502, .lower = 502, .upper = 502, .sag = 500, .moved = 1.7};
  EXPECT_EQ(classify(apart, {.weld = 500}).cls, Class::no_hit);
}

TEST(Classify, CoarseStepsLeaveATouchOpen) {
  Thresholds coarse = kDefault;
  coarse.step = 4000;
  const auto at_step = [&](double d) {
    return classify({.d = d, .lower = d, .upper = d, .moved = 4000, .interiors_meet = d < 0},
                    coarse);
  };
  for (const double d : {-4000.0, -2000.0, 4000.0}) {
    EXPECT_EQ(at_step(d).cls, Class::contact) << d;
    EXPECT_EQ(at_step(d).flags, kUncertain) << d;
  }
  EXPECT_EQ(at_step(-4000).severest, Class::hit);
  EXPECT_EQ(at_step(-6000).cls, Class::hit);
  EXPECT_EQ(at_step(-6000).flags, 0);
}

TEST(Classify, WideBracketKeepsTheClassOfD) {
  const Classification j = at(-5000, -400, -400);
  EXPECT_EQ(j.cls, Class::contact);
  EXPECT_EQ(j.flags, kUncertain);
  EXPECT_EQ(j.severest, Class::hit);
}

TEST(Classify, SagMakesUncertain) {
  EXPECT_EQ(at(0, 0, 0, 500).flags, 0);
  EXPECT_EQ(at(800, 800, 800, 500).flags, kUncertain);
  EXPECT_EQ(at(800, 800, 800, 500).cls, Class::contact);
  EXPECT_EQ(at(-800, -800, -800, 500, true).flags, kUncertain);
}

TEST(Classify, AnyDepthIsAHitWhenNoOverlapIsAllowed) {
  const Thresholds strict{.overlap = 0, .gap = 0, .clearance = 0};
  const SignedSeparation s{.d = -1e-6, .lower = -2, .upper = 0, .sag = 0, .interiors_meet = true};
  EXPECT_EQ(classify(s, strict).cls, Class::hit);
  EXPECT_EQ(classify(s, strict).flags, 0);
  EXPECT_EQ(classify({}, strict).cls, Class::contact);
}

}  // namespace
}  // namespace strake::clash
