// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>

#include "strake/geometry/primitive.hpp"

namespace strake::geometry {

/// The members of a primitive as an array: each of them is a double.
template <class Kind>
using Lengths = std::array<double, sizeof(Kind) / sizeof(double)>;

/// Returns the members of a primitive in the order in which its struct has them.
template <class Kind>
[[nodiscard]] constexpr Lengths<Kind> lengths_of(const Kind& primitive) {
  static_assert(std::is_aggregate_v<Kind> && alignof(Kind) == alignof(double));
  return std::bit_cast<Lengths<Kind>>(primitive);
}

/// Returns the primitive that has these members: the inverse of lengths_of().
template <class Kind>
[[nodiscard]] constexpr Kind from_lengths(const Lengths<Kind>& lengths) {
  return std::bit_cast<Kind>(lengths);
}

}  // namespace strake::geometry
