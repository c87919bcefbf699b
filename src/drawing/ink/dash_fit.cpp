// SPDX-License-Identifier: Apache-2.0
#include "drawing/ink/dash_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strake::drawing {

namespace {

/// A closed stroke has so many dashes where they are not too short for it: a small circle with two
/// of them would look like two hooks.
constexpr double kDashesOfCircle = 4;

double period_of(std::span<const double> dash_mm) {
  return std::accumulate(dash_mm.begin(), dash_mm.end(), 0.0);
}

/// Rounds to a multiple of the largest power of two that is no more than twice `error`.
double rounded_within(double stretch, double error) {
  int exponent = 0;
  std::frexp(2 * error, &exponent);
  const double step = std::ldexp(1.0, exponent - 1);
  return std::max(std::round(stretch / step), 1.0) * step;
}

}  // namespace

std::vector<double> pen_dashes(std::span<const double> widths, double pen_mm) {
  std::vector<double> lengths;
  for (const double width : widths)
    lengths.push_back(std::max(std::round(width * pen_mm * 100) / 100, 0.01));
  return lengths;
}

double shortest_dashed(std::span<const double> dash_mm) {
  return dash_mm.empty() ? 0 : kMinStretch * (period_of(dash_mm) + dash_mm.front());
}

double fitted_stretch(double length_mm, DashEnds ends, std::span<const double> dash_mm) {
  if (dash_mm.empty()) return 0;
  const bool closed = ends == DashEnds::closed;
  // With an even number of periods a first dash lies in the middle.
  const double step = ends == DashEnds::centred ? 2 : 1;
  const double first = dash_mm.front(), period = period_of(dash_mm);
  const double end = closed ? 0 : first;
  const double largest = step * std::floor((length_mm / kMinStretch - end) / (step * period));
  if (!(largest >= (closed ? 2 : step))) return 0;
  const double least = std::min(closed ? kDashesOfCircle : step, largest);
  const double periods =
      std::clamp(step * std::round((length_mm - end) / (step * period)), least, largest);
  const double stretch = length_mm / (periods * period + end);
  return rounded_within(stretch, 0.1 * first * stretch / (periods * period + end));
}

}  // namespace strake::drawing
