// SPDX-License-Identifier: Apache-2.0
#include "io/source/units_and_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace strake::io {

namespace {

/// Returns T·L·Tᵀ for a rotation T given as two functions: column k of L·Tᵀ is L applied to the
/// axis that T turns onto axis k. Only signs and places change.
template <class Turn, class TurnBack>
geometry::Mat3d conjugated(const geometry::Mat3d& linear, Turn turn, TurnBack turn_back) {
  geometry::Mat3d result;
  for (int k = 0; k < 3; ++k) {
    geometry::Vec3d axis;
    axis[k] = 1;
    const geometry::Vec3d column = turn(linear * turn_back(axis));
    for (int row = 0; row < 3; ++row)
      result.row[static_cast<std::size_t>(row)][k] = column[row] + 0.0;  // no negative zero
  }
  return result;
}

}  // namespace

geometry::Placement SourceFrame::placement(const geometry::Placement& file) const {
  return {conjugated(
              file.linear, [this](const geometry::Vec3d& v) { return turn(v); },
              [this](const geometry::Vec3d& v) { return turn_back(v); }),
          point(file.translation)};
}

geometry::Placement SourceFrame::placement_back(const geometry::Placement& model) const {
  const geometry::Vec3d moved = turn_back(model.translation);
  return {conjugated(
              model.linear, [this](const geometry::Vec3d& v) { return turn_back(v); },
              [this](const geometry::Vec3d& v) { return turn(v); }),
          {moved.x / unit_mm + 0.0, moved.y / unit_mm + 0.0, moved.z / unit_mm + 0.0}};
}

SourceFrame choose_frame(const ReadOptions& options, const FrameDefault& fallback) {
  return {options.unit_mm.value_or(fallback.unit_mm), options.up_axis.value_or(fallback.up)};
}

std::string unit_text(const ReadOptions& options, const FrameDefault& fallback) {
  constexpr std::array<std::pair<double, const char*>, 8> kNamed{{{1.0, "mm"},
                                                                  {10.0, "cm"},
                                                                  {100.0, "dm"},
                                                                  {1000.0, "m"},
                                                                  {1e6, "km"},
                                                                  {25.4, "in"},
                                                                  {304.8, "ft"},
                                                                  {0.001, "µm"}}};
  const double unit_mm = options.unit_mm.value_or(fallback.unit_mm);
  const char* how = options.unit_mm ? "given" : fallback.stated ? "stated" : "assumed";
  for (const auto& [length, name] : kNamed)
    if (length == unit_mm) return fmt::format("{} ({})", name, how);
  return fmt::format("{} mm ({})", unit_mm, how);
}

std::string up_axis_text(UpAxis axis) {
  return axis == UpAxis::x ? "x" : axis == UpAxis::y ? "y" : "z";
}

double float32_half_spacing(double magnitude) {
  constexpr int kDigits = std::numeric_limits<float>::digits;
  constexpr int kMin = std::numeric_limits<float>::min_exponent - kDigits;  // of subnormals
  const double size = std::fabs(magnitude);
  if (!std::isfinite(size)) return 0;
  int exponent = kMin;
  if (size > 0) std::frexp(size, &exponent);
  return std::ldexp(0.5, std::max(exponent - kDigits, kMin));
}

}  // namespace strake::io
