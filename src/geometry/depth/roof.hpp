// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/depth/cell_skin.hpp"

namespace strake::geometry {

/// A piece of skin over a simplex, as what lies outside it: the points above all of some planes.
struct Roof {
  /// At the corners of the simplex; the linear function through them is no less than the depth of
  /// any point of the simplex that is in the part.
  std::array<double, 4> depth{};
  /// That function is also no less than 0 wherever a point of the simplex is in the part.
  bool holds_all = false;
  /// The triangles whose planes it is made of.
  std::vector<std::uint32_t> triangles;
};

/// The roof of a simplex that has a triangle in it, if all of the shadow that the simplex casts on
/// it lies just outside the part. It is flat where the skin is, and where the skin caves in (in a
/// hole, along an inner edge) it has as many planes as triangles that the shadow reaches: what is
/// above all of them is convex, free of skin, and outside if one point is.
///
/// `outside`: which corners are known to be, as the points where that was found.
[[nodiscard]] std::optional<Roof> roof_over(const DepthField& field, const Simplex& s,
                                            const Skin& skin, std::uint32_t triangle,
                                            std::span<const Vec3d> outside, double slack,
                                            PairWork& work);

}  // namespace strake::geometry
