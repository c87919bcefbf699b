// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

/// The pieces of a drawing as blocks of columns, which are read at the same time.
namespace strake::project {

/// Objects of a model, from one to before another.
struct ObjectRange {
  std::size_t first = 0, last = 0;
  [[nodiscard]] std::size_t size() const { return last - first; }
};

void write_pieces(BlobWriter& out, std::span<const hlr::EdgePiece> pieces);

/// The pieces of a range of objects as they lie in a reader, which must stay.
struct PieceBlocks {
  ObjectRange objects;
  std::uint64_t count = 0;                            ///< of pieces
  std::vector<std::span<const std::uint8_t>> blocks;  ///< long enough for as many
};

/// Takes the blocks that write_pieces() appended, without a look into them.
[[nodiscard]] PieceBlocks take_pieces(BlobReader& in, ObjectRange objects);

/// Reads the pieces of all ranges of a drawing of so many objects. They are in order, of objects of
/// their ranges, and on the grid; otherwise the reader has a fault, and there are none. Errors:
/// cancelled, out of memory.
[[nodiscard]] Result<std::vector<hlr::EdgePiece>> read_pieces(std::span<const PieceBlocks> ranges,
                                                              std::size_t objects, BlobReader& in,
                                                              const parallel::Context& context);

}  // namespace strake::project
