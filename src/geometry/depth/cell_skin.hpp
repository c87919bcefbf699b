// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/corners.hpp"
#include "geometry/depth/simplex.hpp"

namespace strake::geometry {

/// How far, in grid units, the snap may lift a coplanar neighbour out of a triangle's plane.
inline constexpr double kSnapLift = 8;

/// n·x <= offset, relative to the common origin.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// The plane of a triangle, outward; none for one without area.
[[nodiscard]] std::optional<HalfSpace> plane_of(const DepthField& field, std::uint32_t triangle);

/// All points lie on one side of a plane, farther than `by` from it.
[[nodiscard]] bool on_one_side(std::span<const Vec3d> points, const HalfSpace& plane, double by);

/// The triangles in a box, unless there are too many to look at.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_in(const DepthField& field,
                                                                     const Box3d& box);

/// What one part's skin looks like within one simplex.
class Skin {
 public:
  Skin(const DepthField& field, const Simplex& s, double slack);

  /// No skin comes near the simplex.
  [[nodiscard]] bool absent() const { return complete_ && near_.empty(); }
  /// Whether a triangle certainly does not come near it.
  [[nodiscard]] bool apart(std::uint32_t triangle) const;

  /// Planes above which all of the simplex is outside the part. `outside`: which of its corners
  /// are known to be, as the points where that was found.
  [[nodiscard]] std::vector<HalfSpace> cuts(std::span<const Vec3d> outside) const;

 private:
  [[nodiscard]] bool apart(std::uint32_t triangle, const Corners& corners) const;
  [[nodiscard]] std::optional<HalfSpace> cut(std::uint32_t triangle,
                                             std::span<const Vec3d> outside) const;

  const DepthField& field_;
  double slack_;
  std::array<Vec3d, 4> corners_;
  std::vector<HalfSpace> faces_;
  struct Near {
    std::uint32_t triangle = 0;
    Corners corners;  ///< placed
  };
  std::vector<Near> near_;
  bool complete_ = false;
};

}  // namespace strake::geometry
