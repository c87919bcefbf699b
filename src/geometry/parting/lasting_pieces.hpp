// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/crossing_pieces.hpp"

namespace strake::geometry {

/// The crossing pieces of two sheets but for those that small moves undo: moves of the corners of
/// one of the sheets, none longer than `within` grid units, after which no triangle with a corner
/// that was moved crosses the other sheet. (The other way round for what is left then.) Such moves
/// are looked for by area that one sheet has within that distance of the other, to either side of
/// it. Whether they part the sheets is decided exactly, so that what crosses by more than `within`
/// is always kept; of what does not, some may be.
///
/// `pieces` are crossing_pieces(a, b, most). The cost is that of some walks over the contacts where
/// there are areas of which no piece certainly lasts, nothing worth mentioning where there are
/// none.
[[nodiscard]] CrossingPieces lasting_pieces(const TreedPart& a, const TreedPart& b,
                                            CrossingPieces pieces, double within, std::size_t most,
                                            PairWork& work);

}  // namespace strake::geometry
