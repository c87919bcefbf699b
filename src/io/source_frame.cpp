// SPDX-License-Identifier: Apache-2.0
#include "io/source_frame.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace strake::io {

geometry::Placement SourceFrame::placement(const geometry::Placement& file) const {
  using geometry::Vec3d;
  // Turn the columns, then the rows: T·L·Tᵀ. Column k of L·Tᵀ is L applied to the file axis that
  // becomes axis k.
  const std::array<Vec3d, 3> axes =
      up == UpAxis::y   ? std::array{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}
      : up == UpAxis::x ? std::array{Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}}
                        : std::array{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  geometry::Placement result;
  for (int k = 0; k < 3; ++k) {
    const Vec3d column = turn(file.linear * axes[static_cast<std::size_t>(k)]);
    for (int row = 0; row < 3; ++row)
      result.linear.row[static_cast<std::size_t>(row)][k] = column[row] + 0.0;  // no negative zero
  }
  result.translation = point(file.translation);
  return result;
}

SourceFrame choose_frame(const ReadOptions& options, const FrameDefault& fallback) {
  return {options.unit_mm.value_or(fallback.unit_mm), options.up_axis.value_or(fallback.up)};
}

std::string unit_text(const ReadOptions& options, const FrameDefault& fallback) {
  constexpr std::array<std::pair<double, const char*>, 6> kNamed{
      {{1.0, "mm"}, {10.0, "cm"}, {1000.0, "m"}, {25.4, "in"}, {304.8, "ft"}, {0.001, "µm"}}};
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
  const double size = std::fabs(magnitude);
  if (!(size <= static_cast<double>(std::numeric_limits<float>::max()))) return 0;
  const auto here = static_cast<float>(size);
  const float next = std::nextafter(here, std::numeric_limits<float>::infinity());
  return (static_cast<double>(next) - static_cast<double>(here)) / 2;
}

}  // namespace strake::io
