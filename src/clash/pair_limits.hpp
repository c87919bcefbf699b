// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// t_o' of the pair: docs/clash.md, "Classes".
[[nodiscard]] Thresholds thresholds(const geometry::Part& a, const geometry::Part& b,
                                    const NarrowOptions& options);

/// How far the corners of two parts may move for what such moves part to be touching, grid units:
/// the contact distance, of two sheets no more than may overlap, or it would decide their class.
[[nodiscard]] double apart_within(const geometry::Part& a, const geometry::Part& b,
                                  const NarrowOptions& options);

/// The flags of a pair that come from its parts.
[[nodiscard]] std::uint16_t part_flags(const geometry::Part& a, const geometry::Part& b);

/// How far apart is too far for any class, grid units.
[[nodiscard]] double reach_of(const NarrowOptions& options);

/// The same for triangles: true surfaces may stand out of them by the sag of both.
[[nodiscard]] double parting_gap(const geometry::Part& a, const geometry::Part& b,
                                 const NarrowOptions& options);

}  // namespace strake::clash
