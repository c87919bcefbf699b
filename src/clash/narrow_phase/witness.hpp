// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/pairs/pair_result.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::clash {

/// Returns the witness of parts that share a point.
[[nodiscard]] Witness witness_of_touch(const geometry::Vec3d& point);

/// Returns the witness of parts that overlap by -d <= 0 across a slab with this normal, from b to
/// a, and meet at a point.
[[nodiscard]] Witness witness_of_slab(const geometry::Vec3d& point, const geometry::Vec3d& normal,
                                      double d);

/// Returns the closest points of two parts that are apart.
[[nodiscard]] Witness witness_of_gap(const geometry::ClosestPair& closest);

/// Returns the witness of a closed form; `point` is its point relative to a's origin.
[[nodiscard]] Witness witness_of(const geometry::PrimitiveSeparation& s,
                                 const geometry::Vec3d& point);

/// Returns the deepest point of two parts whose interiors meet, and where it comes out.
[[nodiscard]] Witness witness_of_depth(const geometry::PartWithBvh& a,
                                       const geometry::PartWithBvh& b,
                                       const geometry::Vec3d& deepest);

/// Turns a witness about (b, a) into one about (a, b); `shift` = b's origin minus a's.
[[nodiscard]] Witness mirrored(const Witness& w, const geometry::Vec3d& shift);

}  // namespace strake::clash
