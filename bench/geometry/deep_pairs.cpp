// SPDX-License-Identifier: Apache-2.0
// What the depth of a hard pair costs: CPU milliseconds of solid_depth() on the kinds of pairs
// whose depth is hard to find, straight and turned, mean and greatest, with the share of brackets
// that are no wider than 0.05 mm or 1 %. A pair whose closed form lies outside its bracket reports
// an error.
#include "support/deep_pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clocks.hpp"
#include "strake/geometry/depth.hpp"

namespace {

using namespace strake;
using geometry::Depth;

constexpr std::uint64_t kSeeds = 20;
constexpr int kRepeats = 3;
constexpr double kGridPerMm = 1000;

struct Timed {
  Depth depth;
  double milliseconds = 0;  ///< median of the repeats
};

/// Of a pair that meets.
Timed timed(const test::DeepPairTest& pair) {
  Timed t;
  std::vector<double> laps;
  for (int i = 0; i < kRepeats; ++i) {
    bench::CpuLap lap;
    t.depth = pair.depth();
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
  return depth.upper - depth.lower <= test::tolerance(depth.value);
}

void report(test::DeepKind kind) {
  int pairs = 0, narrow_ones = 0, wrong = 0;
  double sum = 0, greatest = 0;
  std::size_t triangles = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::DeepPair straight = test::draw_deep_pair(kind, seed);
    for (const test::DeepPair& pair : {straight, test::turned_together(straight, seed)}) {
      const test::DeepPairTest subject(pair);
      if (!subject.meets()) continue;
      const Timed t = timed(subject);
      ++pairs;
      sum += t.milliseconds;
      greatest = std::max(greatest, t.milliseconds);
      triangles = std::max(triangles, pair.a.triangles.size() + pair.b.triangles.size());
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
