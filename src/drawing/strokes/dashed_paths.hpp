// SPDX-License-Identifier: Apache-2.0
// Dashed strokes that share a pattern, written as one path.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace strake::drawing {

/// Collects the commands of paths by their patterns, in the order in which these come first.
class DashedPaths {
 public:
  explicit DashedPaths(std::span<const double> dash_mm) : dash_mm_(dash_mm) {}

  /// Returns the commands of the path whose pattern is stretched so; 0: continuous.
  std::string& of(double stretch) {
    auto path = std::ranges::find(paths_, stretch, &Path::stretch);
    if (path == paths_.end()) path = paths_.insert(path, {stretch, {}});
    return path->commands;
  }

  /// Returns the pattern stretched so, mm; empty: continuous.
  [[nodiscard]] std::vector<double> pattern(double stretch) const {
    std::vector<double> lengths;
    for (const double dash : dash_mm_)
      if (stretch != 0) lengths.push_back(rounded(dash * stretch));
    return lengths;
  }

  /// Calls `f` with the pattern of each path and its commands.
  template <class F>
  void for_each(F&& f) const {
    for (const Path& path : paths_) {
      const std::vector<double> lengths = pattern(path.stretch);
      f(std::span<const double>(lengths), path.commands);
    }
  }

 private:
  struct Path {
    double stretch;
    std::string commands;
  };

  /// Tenths of a micrometre add up to no visible length on the longest lines.
  static double rounded(double mm) { return std::round(mm * 1e4) / 1e4; }

  std::span<const double> dash_mm_;
  std::vector<Path> paths_;
};

}  // namespace strake::drawing
