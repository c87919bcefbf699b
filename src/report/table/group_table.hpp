// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

/// Returns the first groups as a table of class, least d, number of results, size, middle and name,
/// and how many more there are.
[[nodiscard]] std::string group_table(const clash::Grouping& grouping, const TableOptions& options);

}  // namespace strake::report
