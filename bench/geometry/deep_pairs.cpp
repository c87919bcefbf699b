// SPDX-License-Identifier: Apache-2.0
// What the depth of a hard pair costs: CPU milliseconds of solid_depth() on the kinds of pairs
// whose depth is hard to find, straight and turned, mean and greatest, with the share of brackets
// that are no wider than 0.05 mm or 1 %. A pair whose closed form lies outside its bracket reports
// an error.
#include "support/deep_pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "clocks.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/part_pair.hpp"
#include "support/part_builder.hpp"

namespace {

using namespace strake;
using geometry::Depth;
using geometry::Meeting;

constexpr std::uint64_t kSeeds = 20;
constexpr int kRepeats = 3;
constexpr double kGridPerMm = 1000;

struct Timed {
  Depth depth;
  double milliseconds = 0;  ///< median of the repeats
  std::size_t triangles = 0;
  bool met = false;
};

Timed timed(const test::DeepPair& pair) {
  const testing::Subject a(test::snapped(pair.a)), b(test::snapped(pair.b));
  const geometry::SupportPlanes of_a = make_support_planes(a.part);
  const geometry::SupportPlanes of_b = make_support_planes(b.part);
  const geometry::DepthPart x{a.treed(), &of_a}, y{b.treed(), &of_b};
  geometry::PairWork work;
  const geometry::MeetingResult meeting = meet(a.treed(), b.treed(), work);
  Timed t;
  if (meeting.meeting == Meeting::apart || meeting.meeting == Meeting::touching) return t;
  t.met = true;
  t.triangles = pair.a.triangles.size() + pair.b.triangles.size();
  geometry::DepthGoal goal{.threshold = kGridPerMm};
  goal.known_upper = -gap_bound(x, y);
  goal.triangle_a = meeting.triangle_a;
  goal.triangle_b = meeting.triangle_b;
  goal.meeting_point = meeting.point;
  std::vector<double> laps;
  for (int i = 0; i < kRepeats; ++i) {
    bench::CpuLap lap;
    t.depth = solid_depth(x, y, goal, work);
    laps.push_back(lap() * 1e3);
  }
  std::nth_element(laps.begin(), laps.begin() + kRepeats / 2, laps.end());
  t.milliseconds = laps[kRepeats / 2];
  return t;
}

bool right(const test::DeepPair& pair, const Depth& depth) {
  constexpr double kSnap = 3;
  return depth.lower <= depth.value && depth.value <= depth.upper &&
         (!pair.depth || *pair.depth * kGridPerMm <= depth.upper + kSnap);
}

bool narrow(const Depth& depth) {
  return depth.upper - depth.lower <= std::max(0.05 * kGridPerMm, 0.01 * depth.value);
}

void report(test::DeepKind kind) {
  int pairs = 0, narrow_ones = 0, wrong = 0;
  double sum = 0, greatest = 0;
  std::size_t triangles = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::DeepPair straight = test::draw_deep_pair(kind, seed);
    for (const test::DeepPair& pair : {straight, test::turned_together(straight, seed)}) {
      const Timed t = timed(pair);
      if (!t.met) continue;
      ++pairs;
      sum += t.milliseconds;
      greatest = std::max(greatest, t.milliseconds);
      triangles = std::max(triangles, t.triangles);
      if (narrow(t.depth)) ++narrow_ones;
      if (!right(pair, t.depth)) ++wrong;
    }
  }
  if (pairs == 0 || wrong > 0) {
    fmt::print("{:<14} ERROR: {} of {} pairs wrong\n", name(kind), wrong, pairs);
    return;
  }
  fmt::print(
      "{:<14}{:>4} pairs of up to {:>6} triangles: mean {:7.2f} ms, greatest {:7.2f} ms, {:5.1f} % "
      "narrow\n",
      name(kind), pairs, triangles, sum / pairs, greatest, 100.0 * narrow_ones / pairs);
}

}  // namespace

int main() {
  for (int kind = 0; kind < test::kDeepKinds; ++kind) report(static_cast<test::DeepKind>(kind));
}
