// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line along which the skins of two parts pass through each other.
struct Crossing {
  geometry::Vec3l a, b;                  ///< grid units; off by half a unit at most, see below
  std::uint32_t body_a = 0, body_b = 0;  ///< of object a <= b
};

/// A crossing's ends are rounded to the grid. Along each axis that takes it away from the faces
/// that it lies on by half a unit at most, which is less than this contact distance.
inline constexpr std::int64_t kCrossingContact = 1;

struct Crossings {
  std::vector<Crossing> all;       ///< by object of body_a
  std::vector<std::size_t> first;  ///< by object, one more at the end; empty where none are asked

  /// Those that are drawn with an object.
  [[nodiscard]] std::span<const Crossing> of(std::uint32_t object) const {
    if (first.empty()) return {};
    return std::span(all).subspan(first[object], first[object + 1] - first[object]);
  }
};

/// The crossings among the drawn objects; `contact`: distances by body, within which faces are
/// meant to touch. Errors: cancelled, too many boxes that meet (input).
[[nodiscard]] Result<Crossings> find_crossings(const model::Scene& scene,
                                               const std::vector<bool>& drawn,
                                               const std::vector<std::int64_t>& contact,
                                               Intersections intersections,
                                               const parallel::Context& context);

}  // namespace strake::hlr
