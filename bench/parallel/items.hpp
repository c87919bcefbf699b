// SPDX-License-Identifier: Apache-2.0
// Items of known cost, with the results that they must have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "clocks.hpp"

namespace strake::bench {

/// An item: `rounds` of an integer mixer, about a nanosecond each.
inline std::uint64_t work(std::uint64_t seed, std::uint32_t rounds) {
  std::uint64_t x = seed + 0x9e3779b97f4a7c15ULL;
  for (std::uint32_t r = 0; r < rounds; ++r) {
    x ^= x >> 27U;
    x *= 0x94d049bb133111ebULL;
  }
  return x;
}

/// Microseconds that a round of work() takes here.
inline double measured_round_us() {
  constexpr std::uint32_t kRounds = 20'000'000;
  Lap lap;
  const volatile std::uint64_t kept = work(1, kRounds);  // or it would not be worked out at all
  static_cast<void>(kept);
  return lap() * 1e6 / kRounds;
}

struct Case {
  std::vector<std::uint32_t> rounds;
  std::vector<std::uint64_t> expected;
};

inline Case make_case(std::vector<std::uint32_t> rounds) {
  Case one{std::move(rounds), {}};
  for (std::size_t i = 0; i < one.rounds.size(); ++i)
    one.expected.push_back(work(i, one.rounds[i]));
  return one;
}

/// Heavy-tailed costs (Pareto, exponent 1.1), as objects of plant models have them.
inline std::vector<std::uint32_t> heavy_tailed(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> rounds(n);
  for (std::uint32_t& r : rounds) {
    const double u = (static_cast<double>(random()) + 1) / 4294967297.0;
    r = static_cast<std::uint32_t>(std::min(500.0 / std::pow(u, 1 / 1.1), 4e6));
  }
  return rounds;
}

}  // namespace strake::bench
