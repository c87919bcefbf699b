// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/heavy.hpp"

#include <algorithm>
#include <functional>

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

}  // namespace strake::parallel
