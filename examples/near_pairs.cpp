// SPDX-License-Identifier: Apache-2.0
// Any number of results per item, in the order of the items, without a lock: the intervals that
// overlap. Two nested loops become one flat range of 64-bit indices.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/team.hpp"

namespace {

struct Interval {
  std::uint32_t lo, hi;
};
using Pair = std::pair<std::uint32_t, std::uint32_t>;

bool overlap(const Interval& a, const Interval& b) { return a.lo <= b.hi && b.lo <= a.hi; }

std::vector<Interval> make(std::uint32_t n, std::uint32_t step) {
  std::vector<Interval> all;
  for (std::uint32_t i = 0; i < n; ++i) all.push_back({i * step % 9973, i * step % 9973 + i % 7});
  return all;
}

}  // namespace

int main() {
  const std::vector<Interval> left = make(300, 31), right = make(500, 57);

  // Before.
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < left.size(); ++i)
    for (std::uint32_t j = 0; j < right.size(); ++j)
      if (overlap(left[i], right[j])) expected.emplace_back(i, j);

  // After.
  using namespace strake::parallel;
  const Shape2 shape{static_cast<std::uint32_t>(left.size()),
                     static_cast<std::uint32_t>(right.size())};
  Team team(default_workers());
  const auto pairs =
      collect<Pair>({.team = &team}, {.name = "overlaps", .n = shape.size(), .grain = 4096},
                    [&](std::size_t flat, std::vector<Pair>& out) {
                      const auto [i, j] = shape.index(flat);
                      if (overlap(left[i], right[j])) out.emplace_back(i, j);
                    });

  if (!pairs || *pairs != expected) return 1;
  std::printf("%zu overlaps of %zu pairs\n", pairs->size(), static_cast<std::size_t>(shape.size()));
  return 0;
}
