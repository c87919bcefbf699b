// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/geometry/vec.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {

/// Converts the numbers of a file to millimetres with z up by a length unit and a rotation that is
/// a signed permutation of the axes, so that no coordinate is rounded by it.
struct SourceFrame {
  double unit_mm = 1;
  UpAxis up = UpAxis::z;

  /// Returns a direction or position in the file's axes, rotated so that its up axis is z.
  [[nodiscard]] constexpr geometry::Vec3d turn(const geometry::Vec3d& v) const {
    if (up == UpAxis::y) return {v.x, -v.z, v.y};
    if (up == UpAxis::x) return {v.y, v.z, v.x};
    return v;
  }
  /// Reverses turn().
  [[nodiscard]] constexpr geometry::Vec3d turn_back(const geometry::Vec3d& v) const {
    if (up == UpAxis::y) return {v.x, v.z, -v.y};
    if (up == UpAxis::x) return {v.z, v.x, v.y};
    return v;
  }
  [[nodiscard]] constexpr geometry::Vec3d point(const geometry::Vec3d& v) const {
    return turn(v) * unit_mm;
  }
  /// Returns a matrix of the file's axes and unit as one of millimetres with z up.
  [[nodiscard]] geometry::Placement placement(const geometry::Placement& file) const;
  /// Reverses placement().
  [[nodiscard]] geometry::Placement placement_back(const geometry::Placement& model) const;
};

/// What a format states where the user says nothing.
struct FrameDefault {
  double unit_mm = 1;
  UpAxis up = UpAxis::z;
  bool stated = false;  ///< stated by the format itself; otherwise it is assumed
};

[[nodiscard]] SourceFrame choose_frame(const ReadOptions& options, const FrameDefault& fallback);

/// Returns "mm (assumed)", "m (stated)", "in (given)", "0.7 mm (given)".
[[nodiscard]] std::string unit_text(const ReadOptions& options, const FrameDefault& fallback);
[[nodiscard]] std::string up_axis_text(UpAxis axis);

/// Returns half the distance between a float32 of this magnitude and the next, in the same unit.
[[nodiscard]] double float32_half_spacing(double magnitude);

}  // namespace strake::io
