// SPDX-License-Identifier: Apache-2.0
// A sum of doubles that has the same bits for any number of workers.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>

#include "strake/parallel/reduce.hpp"
#include "strake/parallel/team.hpp"

namespace {

/// Over forty binary orders of magnitude, so that the order of additions shows.
double area(std::size_t i) {
  const std::uint64_t h = (i + 1) * 0x9e3779b97f4a7c15ULL;
  return std::ldexp(static_cast<double>(h >> 12U), static_cast<int>(h % 41U) - 60);
}

}  // namespace

int main() {
  using namespace strake::parallel;
  constexpr std::size_t kFaces = 100'000;
  std::set<std::uint64_t> sums;
  for (const unsigned workers : {1U, 2U, 3U, 5U, 8U, 13U}) {
    Team team(workers);
    const auto total = reduce(
        {.team = &team}, {.name = "area", .n = kFaces, .grain = 1024}, 0.0,
        [](double& partial, std::size_t i) { partial += area(i); },
        [](double& into, const double& partial) { into += partial; });
    if (!total) return 1;
    sums.insert(std::bit_cast<std::uint64_t>(*total));
  }
  std::printf("%zu distinct sum\n", sums.size());
  return sums.size() == 1 ? 0 : 1;
}
