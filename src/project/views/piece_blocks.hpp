// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

/// The pieces of a drawing as blocks of columns, which are read at the same time.
namespace strake::project {

void write_pieces(BlobWriter& out, std::span<const hlr::EdgePiece> pieces);

/// Reads the pieces of a drawing of so many objects. They are in order, of objects that there are,
/// and on the grid; otherwise the reader has a fault, and there are none. Errors: cancelled, out of
/// memory.
[[nodiscard]] Result<std::vector<hlr::EdgePiece>> read_pieces(BlobReader& in, std::size_t objects,
                                                              const parallel::Context& context);

}  // namespace strake::project
