// SPDX-License-Identifier: Apache-2.0
// Taxicab lengths, in which contact distances are measured exactly.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "geometry/predicates/exact_normal.hpp"
#include "geometry/predicates/feature_distance.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::hlr {

using geometry::feature::magnitude;

/// Return the sum of the magnitudes of the components, |v|₁.
[[nodiscard]] constexpr geometry::Int128 taxicab(const geometry::ExactNormal& v) {
  return magnitude(v[0]) + magnitude(v[1]) + magnitude(v[2]);
}
[[nodiscard]] inline std::int64_t taxicab(const geometry::Vec3l& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}  // namespace strake::hlr
