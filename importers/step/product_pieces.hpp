// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>
#include <XCAFPrs_IndexedDataMapOfShapeStyle.hxx>
#include <cstddef>
#include <optional>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::import_step {

/// A solid of a product, or surfaces that hang together.
struct Piece {
  TopoDS_Shape shape;
  bool is_solid = false;
  std::optional<model::Color> color;  ///< that of most of its area
};

struct Pieces {
  std::vector<Piece> pieces;
  std::size_t curves = 0;  ///< edges that bound no face, and are left out
};

/// Takes a product apart: its solids first, then its other faces, sewn together where they meet.
[[nodiscard]] Pieces pieces_of(const TopoDS_Shape& product,
                               const XCAFPrs_IndexedDataMapOfShapeStyle& styles);

/// Returns a colour as models have it: sRGB in bytes.
[[nodiscard]] model::Color color_of(const Quantity_ColorRGBA& color);

}  // namespace strake::import_step
