// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/parallel/report.hpp"

namespace strake::cli {

/// The workers that the thesis's example of a distribution has. Busy time is CPU time, so that they
/// show how work is shared on a machine of fewer cores as well.
inline constexpr unsigned kWorkersOfExample = 7;

/// Returns all regions of a team as one, with the longest block of any.
[[nodiscard]] parallel::RegionReport merged_report(std::span<const parallel::RegionReport> regions);
/// Returns those of some names as one.
[[nodiscard]] parallel::RegionReport merged_report(std::span<const parallel::RegionReport> regions,
                                                   std::span<const std::string_view> names);

/// Returns the region of a team that took most; one without a name where there is none.
[[nodiscard]] parallel::RegionReport longest_of(std::span<const parallel::RegionReport> regions);

/// Returns the region of that name; one without a name where it did not run.
[[nodiscard]] parallel::RegionReport region_named(std::span<const parallel::RegionReport> regions,
                                                  std::string_view name);

/// Returns cells that say how a region was shared out: the busy seconds of the worker that had
/// least and of the one that had most, their balance, the greatest balance that its longest block
/// allows, and the seconds of that block. "-" for one without workers.
[[nodiscard]] std::vector<std::string> cells_of(const parallel::RegionReport& region);
/// Their columns.
[[nodiscard]] std::vector<std::string> region_columns();

}  // namespace strake::cli
