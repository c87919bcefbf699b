// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/near_walk.hpp"

namespace strake::geometry {

/// All pairs of triangles no farther apart than `reach` grid units, by (a, b), with certain bounds
/// on their distances; nothing where there are more than `most`. Parts without trees, which should
/// be small, are walked triangle by triangle.
[[nodiscard]] std::optional<std::vector<NearTriangles>> near_triangles(
    const PartView& a, const PartView& b, double reach, std::uint64_t most, PairWork& work);

}  // namespace strake::geometry
