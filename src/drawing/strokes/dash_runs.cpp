// SPDX-License-Identifier: Apache-2.0
#include "drawing/strokes/dash_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/strokes/strokes.hpp"

namespace strake::drawing {

namespace {

/// Lines that turn by more make a corner. Meshes stand for circles with as few as ten sides.
constexpr double kCosineOfCorner = 0.8;

class ChainCutter {
 public:
  ChainCutter(const JoinedLines& chain, const PaperCurves& curves, std::span<const double> dash_mm)
      : chain_(chain),
        dash_mm_(dash_mm),
        least_(shortest_dashed(dash_mm)),
        closed_(chain.points.size() > 3 && chain.points.front() == chain.points.back()) {
    for (std::size_t i = 0; i < chain.lines.size(); ++i) {
      curve_.push_back(curves.of(*chain.lines[i]));
      length_.push_back(length_along(curve_[i], chain.points[i], chain.points[i + 1]));
    }
  }

  std::vector<DashRun> cut() {
    if (closed_) begin_at_corner();
    if (closed_ && (!corner(length_.size() - 1, 0) || has_short_sides_only()))
      return {run(0, length_.size(), true)};
    std::vector<std::size_t> cuts{0};
    double along = 0;
    for (std::size_t i = 0; i < length_.size(); ++i) {
      along += length_[i];
      if (i + 1 < length_.size() && (along < least_ || !corner(i, i + 1))) continue;
      // What is too short at the end goes with the part before.
      if (along < least_ && cuts.size() > 1) cuts.pop_back();
      cuts.push_back(i + 1);
      along = 0;
    }
    std::vector<DashRun> runs;
    for (std::size_t k = 1; k < cuts.size(); ++k) runs.push_back(run(cuts[k - 1], cuts[k], false));
    return runs;
  }

 private:
  [[nodiscard]] bool corner(std::size_t i, std::size_t k) const {
    if (curve_[i] != nullptr && curve_[i] == curve_[k]) return false;
    const PaperPoint &a = chain_.points[i], &b = chain_.points[i + 1], &c = chain_.points[k],
                     &d = chain_.points[k + 1];
    const double dot = (b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y);
    return dot < kCosineOfCorner * distance(a, b) * distance(c, d);
  }

  void begin_at_corner() {
    std::size_t at = 0;
    while (at < length_.size() && !corner((at + length_.size() - 1) % length_.size(), at)) ++at;
    if (at == 0 || at == length_.size()) return;
    const auto turn = [&](auto& list) {
      std::ranges::rotate(list, list.begin() + static_cast<std::ptrdiff_t>(at));
    };
    chain_.points.pop_back();
    turn(chain_.points);
    chain_.points.push_back(chain_.points.front());
    turn(chain_.lines);
    turn(curve_);
    turn(length_);
  }

  [[nodiscard]] bool has_short_sides_only() const {
    double along = 0;
    for (std::size_t i = 0; i < length_.size(); ++i) {
      along += length_[i];
      if (along >= least_) return false;
      if (i + 1 < length_.size() && corner(i, i + 1)) along = 0;
    }
    return true;
  }

  [[nodiscard]] double length_of_run(std::size_t from, std::size_t to) const {
    return std::accumulate(length_.begin() + static_cast<std::ptrdiff_t>(from),
                           length_.begin() + static_cast<std::ptrdiff_t>(to), 0.0);
  }

  [[nodiscard]] DashRun run(std::size_t from, std::size_t to, bool round) const {
    const auto first = static_cast<std::ptrdiff_t>(from), last = static_cast<std::ptrdiff_t>(to);
    return {{{chain_.points.begin() + first, chain_.points.begin() + last + 1},
             {chain_.lines.begin() + first, chain_.lines.begin() + last}},
            fitted_stretch(length_of_run(from, to), round ? DashEnds::closed : DashEnds::open,
                           dash_mm_)};
  }

  JoinedLines chain_;
  std::span<const double> dash_mm_;
  double least_;
  bool closed_;
  std::vector<const PaperCurve*> curve_;
  std::vector<double> length_;
};

}  // namespace

std::vector<DashRun> dash_runs(const JoinedLines& chain, const PaperCurves& curves,
                               std::span<const double> dash_mm) {
  return ChainCutter(chain, curves, dash_mm).cut();
}

double stretch_of(const CentreLine& line, std::span<const double> dash_mm) {
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    length += distance(line.points[i - 1], line.points[i]);
  return fitted_stretch(length, line.cross ? DashEnds::centred : DashEnds::open, dash_mm);
}

}  // namespace strake::drawing
