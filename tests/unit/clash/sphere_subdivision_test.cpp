// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "strake/clash/clash.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"

namespace strake::clash {
namespace {

using test::ClashModel;

/// Pairs of small bodies at any gap and depth, side by side.
ClashModel pairs_of_bodies(int count) {
  ClashModel m;
  std::mt19937_64 random(11);
  const auto draw = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random() % 1000) / 1000;
  };
  for (int i = 0; i < count; ++i) {
    const double x = 1000.0 * i, high = draw(5, 20), up = high + draw(-6, 8);
    const std::string number = std::to_string(100 + i);
    m.box("a" + number, {x, 0, 0}, {x + draw(10, 20), draw(10, 20), high});
    if (i % 2 == 0)
      m.box("b" + number, {x + 3, 3, up}, {x + draw(8, 25), draw(8, 25), up + draw(5, 15)});
    else
      m.object("b" + number)
          .body(test::cylinder_mesh(draw(3, 9), draw(5, 15), 1, 12),
                {{}, {x + draw(0, 12), draw(0, 12), up}});
  }
  return m;
}

TEST(SphereSubdivision, AgreesWithTheExactNarrowPhaseWhereItIsSure) {
  const ClashModel m = pairs_of_bodies(60);
  const Options exact{.tolerances = {.clearance_mm = 5}};
  Options spheres = exact;
  spheres.engine.narrow_phase = NarrowPhase::sphere_subdivision;
  const Report e = m.detect(exact), s = m.detect(spheres);
  std::map<std::pair<model::ObjectId, model::ObjectId>, Pair> found;
  for (const Pair& p : s.pairs) found[{p.a, p.b}] = p;
  int sure = 0;
  for (const Pair& p : e.pairs) {
    const auto at = found.find({p.a, p.b});
    ASSERT_NE(at, found.end()) << "lost a " << name(p.cls);
    const Pair other = at->second;
    found.erase(at);
    EXPECT_LE(other.d_lower_mm, p.d_upper_mm + 1e-6);
    EXPECT_GE(other.d_upper_mm, p.d_lower_mm - 1e-6);
    if ((other.flags & (kUncertain | kBorderline)) != 0) continue;
    ++sure;
    EXPECT_EQ(other.cls, p.cls);
  }
  EXPECT_GT(sure, 30);
  for (const auto& [key, p] : found)
    EXPECT_NE(p.flags & (kUncertain | kBorderline), 0) << "sure of a pair that is none";
}

TEST(SphereSubdivision, GivesUpWithAFlagAndNeverInSilence) {
  // Two plates of 10 m, 2 mm apart: what it cannot do, and says so.
  ClashModel m;
  m.box("a", {0, 0, 0}, {10'000, 10'000, 10}).box("b", {0, 0, 12}, {10'000, 10'000, 22});
  Options options;
  options.engine.narrow_phase = NarrowPhase::sphere_subdivision;
  options.engine.max_spheres = 5'000;
  options.tolerances.clearance_mm = 3;
  const Report report = m.detect(options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_NE(report.pairs[0].flags & kUncertain, 0);
  EXPECT_EQ(report.pairs[0].severest, Class::hit) << "it has not looked into them";
  EXPECT_LE(report.pairs[0].d_lower_mm, 2);
  EXPECT_GE(report.pairs[0].d_upper_mm, 2);
  EXPECT_EQ(m.detect({.tolerances = {.clearance_mm = 3}}).pairs.at(0).d_mm, 2);
}

}  // namespace
}  // namespace strake::clash
