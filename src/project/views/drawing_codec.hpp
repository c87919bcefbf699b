// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "project/codec/blob.hpp"
#include "project/views/piece_blocks.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

/// Drawings in a row of the database.
namespace strake::project {

/// Appends all of a drawing. The same drawing gives the same bytes.
void write(BlobWriter& out, const hlr::Drawing& drawing);

/// Reads a drawing. Whatever the bytes are, what it returns can be laid out: objects and curves
/// that lines name are there, lines are in order, and numbers are such as the grid has. A fault is
/// the reader's. Errors: cancelled, out of memory.
[[nodiscard]] Result<hlr::Drawing> read_drawing(BlobReader& in, const parallel::Context& context);

/// Returns in how many parts the lines of so many objects are stored, at least one, and which
/// objects one of them has.
[[nodiscard]] std::size_t count_drawing_parts(std::size_t objects);
[[nodiscard]] ObjectRange objects_of_drawing_part(std::size_t part, std::size_t objects);

/// Appends what a drawing has besides its lines.
void write_head(BlobWriter& out, const hlr::Drawing& drawing);

/// Appends the lines of a range of objects. What is appended of them depends on no other objects
/// but by the numbers of those that they meet. Errors: internal for curves that are not in the
/// order of objects.
[[nodiscard]] Status write_lines(BlobWriter& out, const hlr::Drawing& drawing, ObjectRange objects);

/// Reads a drawing of a head and of the blobs that its parts are, as read_drawing() does; `what`
/// names them. A fault of the head is its reader's. Errors: input for parts that cannot be those of
/// the head, cancelled, out of memory.
[[nodiscard]] Result<hlr::Drawing> read_parts_of_drawing(
    BlobReader& head, std::span<const std::span<const std::byte>> parts, const std::string& what,
    const parallel::Context& context);

/// Returns whether two drawings have the same lines, curves, fates and reports, and were requested
/// in the same way; how much work they were does not matter. Errors: out of memory.
[[nodiscard]] Result<bool> are_equal(const hlr::Drawing& x, const hlr::Drawing& y);

}  // namespace strake::project
