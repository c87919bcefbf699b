// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hlr/feature_edges.hpp"
#include "hlr/section_planes.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/plane_cut.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// What section planes did to a shape: parts, and by part what was drawn and closed.
struct ShapeCut {
  model::GridShape shape;  ///< parts with the numbers that they have in the source
  std::vector<geometry::SectionLine> lines;
  std::vector<std::vector<geometry::Segment>> rims;  ///< by plane: the caps' oriented rims
  std::uint32_t open_ends = 0, not_filled = 0;
};

/// A shape as a view sees it, shared by all bodies that planes cut alike.
struct SeenShape {
  const model::GridShape* source = nullptr;  ///< whose edges are drawn
  std::vector<std::uint32_t> numbers;        ///< of the section planes that cut it
  std::vector<geometry::CutPlane> planes;    ///< these, in its coordinates
  bool away = false;                         ///< cut away wholly
  std::unique_ptr<ShapeCut> cut;             ///< null: as the source is
  /// Contact distance within a part: zero, but for what the planes rounded.
  std::int64_t within = 0;

  /// What hides.
  [[nodiscard]] const model::GridShape& shape() const { return cut ? cut->shape : *source; }
};

struct SeenShapes {
  std::vector<SeenShape> all;
  std::vector<std::uint32_t> of;  ///< by body of the scene
};

/// The drawn bodies' shapes, cut. Errors: cancelled.
[[nodiscard]] Result<SeenShapes> seen_shapes(const model::Scene& scene,
                                             const std::vector<bool>& drawn,
                                             std::span<const SectionPlane> planes,
                                             const parallel::Context& context);

/// The feature edges of the source, in two or three where planes cut them: their kind does not
/// change with a cut. Errors: cancelled.
[[nodiscard]] Result<std::vector<FeatureEdge>> edges_of(const SeenShape& seen,
                                                        const FeatureOptions& options,
                                                        const parallel::Context& context);

}  // namespace strake::hlr
