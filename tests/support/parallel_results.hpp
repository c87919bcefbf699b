// SPDX-License-Identifier: Apache-2.0
// What every pattern makes of one region, to be compared between those who may work on it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/nested.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::test {

using parallel::Context;
using parallel::Region;

inline constexpr std::size_t kResultItems = 4229;  // prime: no grain or team divides it

/// A value per item, over forty binary orders of magnitude, so that a sum shows its order.
inline double value(std::size_t i) {
  const std::uint64_t h = (i + 1) * 0x9e3779b97f4a7c15ULL;
  const double mantissa = static_cast<double>(h >> 12U) * 0x1p-52 - 0.5;
  return std::ldexp(mantissa, static_cast<int>(h % 41U) - 20);
}

/// What the patterns make that run over the items of a region as it is given.
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

/// What the patterns make that set the number of items or their order themselves.
struct OwnResults {
  std::vector<double> nested;
  std::vector<std::uint64_t> by_weight;
  std::vector<std::uint32_t> kinds;
  std::vector<double> precomputed;
  std::vector<std::uint32_t> owners;  ///< of places that items reserved
  std::vector<double> by_piece;
  std::vector<double> piped;
  friend bool operator==(const OwnResults&, const OwnResults&) = default;
};

namespace own {

/// Now and then lets another thread go first.
inline void dawdle(std::size_t i, unsigned seed) {
  if (seed != 0 && (i + 1) * 0x9e3779b97f4a7c15ULL * seed >> 58U == 0) std::this_thread::yield();
}

inline std::vector<double> nested(const Context& context, const Region& region, unsigned seed) {
  constexpr std::size_t kRows = 60;
  std::vector<double> out(kRows * (kRows - 1) / 2, 0);
  const Status status = parallel::for_each_nested(
      context, region, kRows, [](std::size_t row) { return row; },
      [&](std::size_t row, std::size_t column) {
        dawdle(row + column, seed);
        out[row * (row - 1) / 2 + column] = value(row) * value(column);
      });
  return status ? out : std::vector<double>();
}

/// Sums by regions of their own, which have the team or not.
inline std::vector<std::uint64_t> by_weight(const Context& context, Region region, unsigned seed) {
  std::vector<std::uint64_t> out(200, 0);
  region.n = out.size();
  const Status status = parallel::for_each_by_weight(
      context, region, 50, [](std::size_t i) { return i % 100 == 99 ? 1000.0 : 1.0; },
      [&](std::size_t i) -> Status {
        dawdle(i, seed);
        const auto sum = parallel::reduce(
            context, {.name = "inside", .n = 3 * i, .grain = 8}, 0.0,
            [](double& partial, std::size_t k) { partial += value(k); },
            [](double& into, const double& partial) { into += partial; });
        if (!sum) return sum.error();
        out[i] = std::bit_cast<std::uint64_t>(*sum);
        return {};
      });
  return status ? out : std::vector<std::uint64_t>();
}

inline std::vector<std::uint32_t> kinds(const Context& context, const Region& region) {
  const auto found = parallel::distinct(
      context, region.name, kResultItems,
      [](std::size_t i) { return parallel::mixed(0, i * i % 97); },
      [](std::size_t i, std::size_t j) { return i * i % 97 == j * j % 97; });
  return found ? found->of : std::vector<std::uint32_t>();
}

inline std::vector<double> precomputed(const Context& context, const Region& region,
                                       unsigned seed) {
  parallel::Precomputed<double> table(kResultItems);
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t i = 0; i < 300; ++i) wanted.push_back(i * i % kResultItems);
  std::vector<double> out;
  if (!table.fill(context, region, wanted, [&](std::size_t key) {
        dawdle(key, seed);
        return value(key);
      }))
    return out;
  for (std::size_t key = 0; key < table.size(); ++key)
    if (const double* const made = table.find(key)) out.push_back(*made);
  return out;
}

inline std::vector<std::uint32_t> owners(const Context& context, const Region& region,
                                         unsigned seed) {
  constexpr std::size_t kPlaces = 500;
  std::vector<std::uint32_t> out(kPlaces, 0);
  const auto places = [](std::size_t i) {
    return std::array{i * 7919 % kPlaces, (i * i + 3) % kPlaces};
  };
  const auto run = parallel::for_each_reserved(
      context, region, kPlaces,
      [&](std::size_t i, parallel::Claims& claims) {
        for (const std::size_t place : places(i)) claims(place);
      },
      [&](std::size_t i) {
        dawdle(i, seed);
        for (const std::size_t place : places(i))
          out[place] = 31 * out[place] + static_cast<std::uint32_t>(i);
      });
  return run ? out : std::vector<std::uint32_t>();
}

inline std::vector<double> by_piece(const Context& context, Region region) {
  const auto work =
      parallel::pieces(100, [](std::size_t i) { return i == 50 ? std::size_t{900} : i % 5; }, 16);
  if (!work) return {};
  region.n = work->size();
  const auto sums = parallel::transform(context, region, [&](std::size_t k) {
    const parallel::Piece& piece = (*work)[k];
    double sum = 0;
    for (std::size_t e = piece.first; e < piece.last; ++e) sum += value(100 * piece.item + e);
    return sum;
  });
  return sums ? *sums : std::vector<double>();
}

inline std::vector<double> piped(const Context& context, const Region& region, unsigned seed) {
  std::vector<double> out;
  std::size_t next = 0;
  const Status status = parallel::pipeline(
      context, {.name = region.name, .in_flight = region.grain},
      [&] { return next < 100 ? std::optional(next++) : std::nullopt; },
      [&](std::size_t i) {
        dawdle(i, seed);
        return value(i);
      },
      [&](double made) { out.push_back(made); });
  return status ? out : std::vector<double>();
}

}  // namespace own

/// Of a failed pattern nothing. The region has no order.
inline OwnResults own_results(const Context& context, const Region& region, unsigned delay_seed) {
  return {.nested = own::nested(context, region, delay_seed),
          .by_weight = own::by_weight(context, region, delay_seed),
          .kinds = own::kinds(context, region),
          .precomputed = own::precomputed(context, region, delay_seed),
          .owners = own::owners(context, region, delay_seed),
          .by_piece = own::by_piece(context, region),
          .piped = own::piped(context, region, delay_seed)};
}

}  // namespace strake::test
