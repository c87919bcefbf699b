// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/evaluate/chart.hpp"

namespace strake::cli {

/// Returns the chart as an SVG element, which may stand in an HTML page or be a file.
[[nodiscard]] std::string bar_chart_svg(const BarChart& chart);

}  // namespace strake::cli
