// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// Whether the plane of a triangle has the parts on opposite closed sides, `below` on the negative
/// one; for a sheet a point off the plane is asked for as well. Exact; early out at the first
/// vertex on the wrong side. Then neither part has a point in the other's interior, and neither
/// holds the other.
[[nodiscard]] bool separates(const ExactTriangle& triangle, const PartView& below,
                             const PartView& above);

/// Whether the plane keeps the parts apart: `above` strictly on its positive side, `below` on the
/// closed negative one.
[[nodiscard]] bool parts_strictly(const ExactTriangle& triangle, const PartView& below,
                                  const PartView& above);

}  // namespace strake::geometry
