// SPDX-License-Identifier: Apache-2.0
#include "support/line_sets.hpp"

#include <array>
#include <cmath>
#include <random>

namespace strake::test {

namespace {

using drawing::OverlapRank;
using drawing::PlaneSegment;

class Maker {
 public:
  Maker(std::uint64_t seed, const LineSetOptions& options) : engine_(seed), options_(options) {}

  std::vector<PlaneSegment> run() {
    std::vector<PlaneSegment> lines;
    while (lines.size() < options_.count) switch (options_.set) {
        case LineSet::any:
          lines.push_back(any());
          break;
        case LineSet::lattice:
          lines.push_back(lattice());
          break;
        case LineSet::parallel:
          lines.push_back(parallel());
          break;
        case LineSet::chains:
          add_chain(lines);
          break;
      }
    lines.resize(options_.count);
    return lines;
  }

 private:
  double real(double from, double to) {
    return from + (to - from) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  std::uint64_t below(std::uint64_t n) { return engine_() % n; }

  PlaneSegment line(double ax, double ay, double bx, double by) {
    const double o = options_.offset;
    return {.ax = ax + o,
            .ay = ay - o,
            .bx = bx + o,
            .by = by - o,
            .depth = static_cast<double>(below(4)),
            .reach = below(4) == 0 ? options_.reach / 2 : options_.reach,
            .rank = std::array{OverlapRank::visible, OverlapRank::hidden, OverlapRank::hidden,
                               OverlapRank::none}[below(below(8) == 0 ? 4 : 3)]};
  }
  PlaneSegment any() {
    const double length = std::pow(10.0, real(-2, 4)), x = real(0, 1000), y = real(0, 1000);
    const double dx = real(-1, 1), dy = real(-1, 1);
    return line(x, y, x + dx * length, y + dy * length);
  }
  PlaneSegment lattice() {
    const auto at = [&] { return static_cast<double>(below(5)) * 10; };
    const double jitter = options_.reach * static_cast<double>(below(3)) / 2;
    return line(at() + jitter, at(), at(), at() + jitter);
  }
  /// An axis through all, whose direction is that of the first number drawn.
  PlaneSegment parallel() {
    if (axis_ < 0) axis_ = real(0, 2);
    const double x = std::fabs(axis_ - 1), y = axis_ < 1 ? 1 - x : x - 1;
    const double size = std::sqrt(x * x + y * y), ux = x / size, uy = y / size;
    const double length = std::pow(10.0, real(-1, 4)), from = real(0, 5000);
    const double a = real(-2, 2) * options_.reach;
    const double b = below(3) == 0 ? a : real(-2, 2) * options_.reach;
    const double turn = below(8) == 0 ? real(-0.05, 0.05) * length : 0;
    return line(ux * from - uy * a, uy * from + ux * a, ux * (from + length) - uy * (b + turn),
                uy * (from + length) + ux * (b + turn));
  }
  void add_chain(std::vector<PlaneSegment>& lines) {
    const PlaneSegment whole = any();
    lines.push_back(whole);
    const std::uint64_t parts = 2 + below(6), split = 1 + below(6);
    const auto at = [&](std::uint64_t k, std::uint64_t n) {
      const double t = static_cast<double>(k) / static_cast<double>(n);
      return std::array{whole.ax + (whole.bx - whole.ax) * t - options_.offset,
                        whole.ay + (whole.by - whole.ay) * t + options_.offset};
    };
    for (const std::uint64_t n : {parts, parts * split, parts * split * split})
      for (std::uint64_t k = 0; k < n; ++k) {
        const auto a = at(k, n), b = at(k + 1, n);
        lines.push_back(below(2) == 0 ? line(a[0], a[1], b[0], b[1])
                                      : line(b[0], b[1], a[0], a[1]));
      }
  }

  std::mt19937_64 engine_;
  LineSetOptions options_;
  double axis_ = -1;
};

}  // namespace

std::vector<PlaneSegment> make_lines(std::uint64_t seed, const LineSetOptions& options) {
  return Maker(seed, options).run();
}

drawing::LineIntervals cut_by_all_pairs(std::span<const PlaneSegment> lines,
                                        const drawing::OverlapRule& rule) {
  drawing::LineIntervals out;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (!drawing::can_be_covered(lines[i], rule) || !(lines[i].length() > 0)) continue;
    std::vector<drawing::ParamInterval> covers;
    for (std::uint32_t j = 0; j < lines.size(); ++j) {
      if (j == i || !drawing::has_precedence(lines, j, i) || !drawing::can_cover(lines[j], rule))
        continue;
      if (!(lines[j].length() > 0)) continue;
      if (const auto interval = drawing::covered(lines[i], lines[j], rule))
        covers.push_back(*interval);
    }
    if (!covers.empty())
      drawing::append_intervals(out, i, covers, rule.shortest / lines[i].length());
  }
  return out;
}

}  // namespace strake::test
