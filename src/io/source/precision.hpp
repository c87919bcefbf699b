// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0014 says why precision belongs to a body and not to a file.

#include <span>

#include "strake/geometry/vec.hpp"
#include "strake/io/reader.hpp"

namespace strake::io {

/// As a body has it; what is no finite length, or more than any model measures, becomes the most.
[[nodiscard]] float precision_um(double half_spacing_mm);

/// The largest absolute coordinate, 0 where there is no point.
[[nodiscard]] double largest_coordinate(std::span<const geometry::Vec3d> points);

/// Whether doubles are what float32 had of them: a writer that keeps places in single precision.
/// Decimals of up to nine digits are not, even if float32 has them exactly.
[[nodiscard]] bool came_through_float32(const geometry::Vec3d& numbers);

/// How many times larger a step along a local axis may be in the world.
[[nodiscard]] double scale_of(const geometry::Mat3d& linear);

/// Gives the model's only file the worst precision of its bodies, and warns once where that makes
/// objects count as touching that are more than a millimetre apart.
void settle_precision(const FileBytes& file, model::Model& model);

}  // namespace strake::io
