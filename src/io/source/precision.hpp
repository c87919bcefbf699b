// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0014 says why precision belongs to a body and not to a file.

#include <span>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/io/reader.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io {

/// Returns the precision as a body has it; what is no finite length, or more than any model
/// measures, becomes the largest value.
[[nodiscard]] float precision_um(double half_spacing_mm);

/// Returns the largest absolute coordinate, 0 where there is no point.
[[nodiscard]] double largest_coordinate(std::span<const geometry::Vec3d> points);

/// Whether doubles are values of float32: a writer kept positions in single precision. Decimals of
/// up to nine digits are not, even if float32 has them exactly.
[[nodiscard]] bool came_through_float32(const geometry::Vec3d& numbers);

/// Returns how many times larger a step along a local axis may be in the world.
[[nodiscard]] double scale_of(const geometry::Mat3d& linear);

/// Gives the model's only file the worst precision of its bodies, and warns once where that makes
/// objects count as touching that are more than a millimetre apart. Errors: cancelled, out of
/// memory.
[[nodiscard]] Status settle_precision(const FileBytes& file, model::Model& model,
                                      const parallel::Context& context);

}  // namespace strake::io
