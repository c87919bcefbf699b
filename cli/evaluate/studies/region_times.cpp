// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/region_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace strake::cli {

parallel::RegionReport merged_report(std::span<const parallel::RegionReport> regions) {
  parallel::RegionReport whole;
  whole.name = "all";
  for (const parallel::RegionReport& region : regions) {
    if (region.runs == 0) continue;
    whole.runs += region.runs;
    whole.items += region.items;
    whole.wall_s += region.wall_s;
    whole.share_s += region.share_s;
    whole.least_s += region.least_s;
    whole.longest_s = std::max(whole.longest_s, region.longest_s);
    whole.busy_s.resize(std::max(whole.busy_s.size(), region.busy_s.size()));
    for (std::size_t w = 0; w < region.busy_s.size(); ++w) whole.busy_s[w] += region.busy_s[w];
  }
  return whole;
}

parallel::RegionReport merged_report(std::span<const parallel::RegionReport> regions,
                                     std::span<const std::string_view> names) {
  std::vector<parallel::RegionReport> some;
  for (const parallel::RegionReport& region : regions)
    if (std::ranges::find(names, region.name) != names.end()) some.push_back(region);
  return merged_report(some);
}

parallel::RegionReport longest_of(std::span<const parallel::RegionReport> regions) {
  const auto longest = std::ranges::max_element(
      regions, {}, [](const auto& region) { return region.runs == 0 ? 0 : region.total_busy_s(); });
  return longest == regions.end() ? parallel::RegionReport() : *longest;
}

parallel::RegionReport region_named(std::span<const parallel::RegionReport> regions,
                                    std::string_view name) {
  const auto found = std::ranges::find(regions, name, &parallel::RegionReport::name);
  return found == regions.end() ? parallel::RegionReport() : *found;
}

std::vector<std::string> region_columns() {
  return {"Least s", "Greatest s", "Balance", "Bound", "Longest block s"};
}

std::vector<std::string> cells_of(const parallel::RegionReport& region) {
  if (region.busy_s.empty()) return std::vector<std::string>(region_columns().size(), "-");
  const auto [least, largest] = std::ranges::minmax(region.busy_s);
  return {fmt::format("{:.3f}", least), fmt::format("{:.3f}", largest),
          fmt::format("{:.2f}", region.load_balance()), fmt::format("{:.2f}", region.bound()),
          fmt::format("{:.4f}", region.longest_s)};
}

}  // namespace strake::cli
