// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "clash/narrow_part.hpp"
#include "clash/telling.hpp"

namespace strake::clash {

/// One of the places where two parts meet or are too near each other.
struct PartPlace {
  PartAnswer answer;
  geometry::Box3d extent;  ///< holds the place; grid units relative to a's origin
  bool is_whole = false;   ///< the answer is that of the parts as a whole, to the bit
};

/// The places of two parts whose answer as a whole is known and not NO_HIT: those within the touch
/// gap where they touch or meet, those within the clearance otherwise, or too where all are asked
/// for. One of them has the answer as a whole. Where there is only one, an empty list unless it is
/// to be described. Nothing where there are too many triangles near each other to tell. Parts have
/// trees unless they only touch and are small.
[[nodiscard]] std::optional<std::vector<PartPlace>> places_of(const NarrowPart& a,
                                                              const NarrowPart& b,
                                                              const PartAnswer& whole,
                                                              const NarrowOptions& options,
                                                              Telling telling, NarrowWork& work);

/// How near counts as meeting in a place, for two parts with this answer, grid units.
[[nodiscard]] double place_reach(const NarrowPart& a, const NarrowPart& b, const PartAnswer& whole,
                                 const NarrowOptions& options);

}  // namespace strake::clash
