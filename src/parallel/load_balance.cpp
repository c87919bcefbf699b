// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "strake/parallel/heavy.hpp"
#include "strake/parallel/order.hpp"

namespace strake::parallel {

namespace {

/// Returns a number that falls as the cost grows. The bits of floats that are not negative are in
/// order; what is no cost at all, NaN among it, counts as 0.
std::uint32_t rank_of(double cost) {
  const double largest = std::numeric_limits<float>::max();
  return ~std::bit_cast<std::uint32_t>(cost > 0 ? static_cast<float>(std::min(cost, largest))
                                                : 0.0F);
}

struct Ranked {
  std::uint32_t rank, item;
};

/// Sorts by counting, digit by digit from the lowest: equal items stay in their order. It takes a
/// third of the time of comparing, of which regions of many small items would feel the rest.
void sort_by_rank(std::vector<Ranked>& all) {
  constexpr unsigned kBits = 11, kDigits = 3;
  constexpr std::uint32_t kMask = (1U << kBits) - 1;
  std::vector<Ranked> other(all.size());
  for (unsigned digit = 0; digit < kDigits; ++digit) {
    const auto of = [&](const Ranked& r) { return r.rank >> digit * kBits & kMask; };
    std::array<std::size_t, kMask + 2> next{};
    for (const Ranked& r : all) ++next[of(r) + 1];
    for (std::size_t d = 0; d <= kMask; ++d) next[d + 1] += next[d];
    for (const Ranked& r : all) other[next[of(r)]++] = r;
    std::swap(all, other);
  }
}

}  // namespace

std::vector<std::uint32_t> longest_first(std::span<const double> costs) {
  constexpr std::size_t kMany = 1024;
  std::vector<Ranked> all(costs.size());
  for (std::uint32_t i = 0; i < costs.size(); ++i) all[i] = {rank_of(costs[i]), i};
  if (all.size() < kMany)
    std::ranges::sort(all, [](const Ranked& a, const Ranked& b) {
      return a.rank != b.rank ? a.rank < b.rank : a.item < b.item;
    });
  else
    sort_by_rank(all);
  std::vector<std::uint32_t> order(all.size());
  std::ranges::transform(all, order.begin(), &Ranked::item);
  return order;
}

namespace {

/// How many times longer than a fair share the busiest worker may take.
constexpr double kUneven = 1.125;

/// Returns the load of the busiest worker where the items, heaviest first, each go to whoever has
/// least.
double busiest(std::span<const double> costs, unsigned workers) {
  std::vector<double> loads(workers, 0);  // a heap with the least on top
  for (const double cost : costs) {
    std::ranges::pop_heap(loads, std::greater{});
    loads.back() += cost;
    std::ranges::push_heap(loads, std::greater{});
  }
  return *std::ranges::max_element(loads);
}

}  // namespace

std::vector<std::uint32_t> heavy_items(std::span<const double> costs, double least,
                                       unsigned workers) {
  std::vector<std::uint32_t> heavy;
  if (workers < 2) return heavy;
  double all = 0;
  for (const double cost : costs)
    if (cost > 0) all += cost;
  for (std::uint32_t i = 0; i < costs.size(); ++i)
    if (costs[i] >= least && costs[i] * 2 * workers > all) heavy.push_back(i);
  std::ranges::sort(heavy, [&](std::uint32_t a, std::uint32_t b) {
    return costs[a] != costs[b] ? costs[a] > costs[b] : a < b;
  });
  std::vector<double> loads;
  for (const std::uint32_t i : heavy) loads.push_back(costs[i]);
  // What is lighter fills the gaps between them.
  std::size_t apart = 0;
  while (apart < heavy.size() &&
         busiest(std::span(loads).subspan(apart), workers) * workers > kUneven * all)
    all -= loads[apart++];
  heavy.resize(apart);
  std::ranges::sort(heavy);
  return heavy;
}

namespace detail {

void HeavySplit::drop_from(std::uint32_t item) {
  rest.erase(std::ranges::lower_bound(rest, item), rest.end());
}

Result<std::vector<std::uint32_t>> HeavySplit::longest_first(std::span<const double> costs,
                                                             const Region& others) const try {
  return parallel::longest_first(others.blocks(), [&](std::size_t block) {
    const std::size_t first = block * others.block_size();
    double sum = 0;
    for (std::size_t k = first; k < block_end(first, others.block_size(), rest.size()); ++k)
      sum += costs[rest[k]];
    return sum;
  });
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

Result<HeavySplit> split_off_heavy(std::span<const double> costs, double least, unsigned workers,
                                   const Region& region) try {
  if (costs.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{
        ErrorCode::internal, "more items than 32 bits number", std::string(region.name), {}};
  HeavySplit apart{heavy_items(costs, least, workers), {}};
  apart.rest.reserve(costs.size() - apart.heavy.size());
  for (std::uint32_t i = 0, k = 0; i < costs.size(); ++i) {
    if (k < apart.heavy.size() && apart.heavy[k] == i)
      ++k;
    else
      apart.rest.push_back(i);
  }
  return apart;
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

}  // namespace detail
}  // namespace strake::parallel
