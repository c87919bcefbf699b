// SPDX-License-Identifier: Apache-2.0
#include "geometry/sheet_curve.hpp"

#include <utility>

#include "geometry/pair_view.hpp"
#include "geometry/parting/lasting_pieces.hpp"

namespace strake::geometry {

CrossingCurve crossing_curve(const TreedPart& a, const TreedPart& b, double within,
                             std::size_t most, PairWork& work) {
  const PartView view_a(a, {}), view_b(b, b.placed.origin - a.placed.origin);
  const CrossingPieces pieces =
      lasting_pieces(a, b, crossing_pieces(a, b, most, work), within, most, work);
  CrossingCurve curve{
      .segments = {}, .pieces = {}, .crosses = !pieces.all.empty(), .truncated = pieces.truncated};
  for (const CrossingPiece& piece : pieces.all) {
    const auto segment = segment_of(view_a, view_b, piece);
    if (!segment) continue;
    curve.segments.push_back(*segment);
    curve.pieces.push_back(piece);
  }
  return curve;
}

}  // namespace strake::geometry
