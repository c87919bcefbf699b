// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0032 says why meshes that are each other moved share a shape.

#include <cstdint>
#include <span>

#include "model/scene/grid_shape.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/distinct.hpp"

namespace strake::model {

/// Finds shapes that differ by a translation of grid steps only, with all that belongs to them
/// equal: most exporters write the mesh of a part anew for every place where it is. Shapes of
/// primitives, and those that have a fault, equal only themselves. Errors: cancelled.
[[nodiscard]] Result<parallel::Distinct> find_equal_shapes(std::span<const GridShapeResult> shapes,
                                                           const parallel::Context& context);

/// Returns a hash of a shape that has parts with vertices: the same for equal ones, and hardly ever
/// for those that differ in vertices, triangles or sag, so that few are compared.
[[nodiscard]] std::uint64_t translation_invariant_hash(const GridShape& shape);

/// Returns how far equal shapes are moved: from one vertex of `from` to the same one of `to`.
[[nodiscard]] geometry::Vec3l translation_between(const GridShape& from, const GridShape& to);

}  // namespace strake::model
