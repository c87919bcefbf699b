// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

namespace strake::io {

/// A body's geometry as triangles or polylines, and its placement.
struct TessellatedShape {
  const geometry::TriangleMesh* mesh = nullptr;  ///< one of these two, or neither
  const geometry::Polylines* lines = nullptr;
  geometry::Placement placement;
};

/// Gives bodies as triangles and polylines to writers that know no analytic primitives: a primitive
/// is tessellated once per linear part of its placements.
class TessellationCache {
 public:
  TessellationCache(const model::Model& model, double sag_mm) : model_(&model), sag_mm_(sag_mm) {}

  [[nodiscard]] TessellatedShape place(const model::Body& body);

  /// Hands over the triangles made here; pointers given out stay valid.
  void release(std::deque<geometry::TriangleMesh>& meshes, std::deque<geometry::Polylines>& lines);

 private:
  using Key = std::pair<std::uint32_t, std::array<std::uint64_t, 9>>;
  struct Made {
    const geometry::TriangleMesh* mesh = nullptr;
    const geometry::Polylines* lines = nullptr;
  };

  const model::Model* model_;
  double sag_mm_;
  std::map<Key, Made> made_;
  std::deque<geometry::TriangleMesh> meshes_;
  std::deque<geometry::Polylines> lines_;
};

}  // namespace strake::io
