// SPDX-License-Identifier: Apache-2.0
// What every pattern makes of one region, to be compared between those who may work on it.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::test {

using parallel::Context;
using parallel::Region;

inline constexpr std::size_t kResultItems = 1013;  // prime: no grain or team divides it

/// A value per item, over forty binary orders of magnitude, so that a sum shows its order.
inline double value(std::size_t i) {
  const std::uint64_t h = (i + 1) * 0x9e3779b97f4a7c15ULL;
  const double mantissa = static_cast<double>(h >> 12U) * 0x1p-52 - 0.5;
  return std::ldexp(mantissa, static_cast<int>(h % 41U) - 20);
}

/// Every result that this library can build, for one region's settings.
struct Results {
  std::vector<double> transformed;
  std::vector<std::uint32_t> collected;
  std::vector<std::uint32_t> packed;
  std::vector<std::size_t> offsets;
  std::uint64_t sum_bits = 0;
  std::size_t found = 0;
  std::vector<double> until;
  std::uint64_t item_runs = 0;
  friend bool operator==(const Results&, const Results&) = default;
};

inline Results results(const Context& context, const Region& region, unsigned delay_seed) {
  Results r;
  std::vector<std::uint8_t> runs(kResultItems, 0);
  r.transformed = *parallel::transform_with(
      context, region, [&] { return std::minstd_rand(delay_seed); },
      [&](std::minstd_rand& random, std::size_t i) {
        if (delay_seed != 0 && random() % 64 == 0) std::this_thread::yield();
        ++runs[i];
        return value(i);
      });
  for (const std::uint8_t count : runs) r.item_runs += count == 1 ? 1U : 1000U;
  r.collected = *parallel::collect<std::uint32_t>(
      context, region, [](std::size_t i, std::vector<std::uint32_t>& out) {
        for (std::size_t k = 0; k < i % 4; ++k)
          out.push_back(static_cast<std::uint32_t>(10 * i + k));
      });
  auto packed = parallel::count_fill<std::uint32_t>(
      context, region, [](std::size_t i) { return i % 3; },
      [](std::size_t i, std::span<std::uint32_t> out) {
        std::fill(out.begin(), out.end(), static_cast<std::uint32_t>(i));
      });
  r.offsets = packed->offsets;
  r.packed = packed->values;
  const auto sum = parallel::reduce(
      context, region, 0.0, [](double& partial, std::size_t i) { partial += value(i); },
      [](double& into, const double& partial) { into += partial; });
  r.sum_bits = std::bit_cast<std::uint64_t>(*sum);
  r.found = parallel::find_first(context, region, [](std::size_t i) {
              return i >= kResultItems / 2 && value(i) > 0;
            })->value();
  r.until = *parallel::transform_until(context, region, value, [](double v) { return v > 0x1p15; });
  return r;
}

}  // namespace strake::test
