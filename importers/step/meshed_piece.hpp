// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "product_pieces.hpp"
#include "progress.hpp"
#include "strake/model/model.hpp"

namespace strake::import_step {

struct MeshOptions {
  static constexpr double kSag = 0.1, kAngle = 0.5;

  /// The largest distance of a triangle from its surface; without it kSag, and less for small
  /// pieces, so that they look as they are where a drawing shows them large.
  std::optional<double> sag_mm;
  unsigned threads = 1;
  /// A piece that takes longer is given up.
  double limit_s = 60;
};

/// The triangles of a piece, or why there are none.
struct MeshedPiece {
  geometry::TriangleMesh mesh;
  std::size_t faces_without = 0;
  bool is_closed = false;
  /// Its sag, mm, where that is more than was requested.
  std::optional<double> coarser_sag_mm;
  std::string fault;
};

/// Makes triangles of a piece.
[[nodiscard]] MeshedPiece mesh_piece(const Piece& piece, const MeshOptions& options,
                                     const Handle(ReportProgress) & progress);

}  // namespace strake::import_step
