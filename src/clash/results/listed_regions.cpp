// SPDX-License-Identifier: Apache-2.0
#include "clash/results/listed_regions.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace strake::clash {

std::uint32_t listed_regions(const Pair& pair, const Options& options) {
  return pair.regions_listed(options) + pair.allowed_regions_listed(options);
}

void put_regions_in_order(Report& report) {
  std::vector<Region> ordered;
  ordered.reserve(report.regions.size());
  for (Pair& pair : report.pairs) {
    const std::uint32_t listed = listed_regions(pair, report.options);
    if (listed == 0) continue;
    const auto first = report.regions.begin() + static_cast<std::ptrdiff_t>(pair.first_region);
    pair.first_region = static_cast<std::uint32_t>(ordered.size());
    ordered.insert(ordered.end(), first, first + static_cast<std::ptrdiff_t>(listed));
  }
  report.regions = std::move(ordered);
}

}  // namespace strake::clash
