// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "project/codec/blob.hpp"
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

/// Returns whether two drawings have the same lines, curves, fates and reports, and were asked for
/// in the same way; how much work they were does not matter. Errors: out of memory.
[[nodiscard]] Result<bool> are_equal(const hlr::Drawing& x, const hlr::Drawing& y);

}  // namespace strake::project
