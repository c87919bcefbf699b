// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/heavy.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <new>
#include <string>

#include "strake/parallel/order.hpp"

namespace strake::parallel {
namespace {

/// How much longer than a fair share the busiest worker may take.
constexpr double kUneven = 1.125;

/// The load of the busiest worker where the items, heaviest first, each go to whoever has least.
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

void Apart::drop_from(std::uint32_t item) {
  rest.erase(std::ranges::lower_bound(rest, item), rest.end());
}

Result<std::vector<std::uint32_t>> Apart::longest_first(std::span<const double> costs,
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

Result<Apart> set_apart(std::span<const double> costs, double least, unsigned workers,
                        const Region& region) try {
  if (costs.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{
        ErrorCode::internal, "more items than 32 bits number", std::string(region.name), {}};
  Apart apart{heavy_items(costs, least, workers), {}};
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
