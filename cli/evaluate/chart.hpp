// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace strake::cli {

/// Bars over names, in groups of one bar per series.
struct BarChart {
  std::string title, unit;
  std::vector<std::string> names;
  struct Series {
    std::string name;
    std::vector<double> values;  ///< one per name
  };
  std::vector<Series> series;
  /// Horizontal lines with a label.
  struct Level {
    std::string label;
    double value = 0;
  };
  std::vector<Level> levels = {};
};

}  // namespace strake::cli
