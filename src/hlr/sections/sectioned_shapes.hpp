// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/plane_section/plane_section.hpp"
#include "hlr/edges/feature_edges.hpp"
#include "hlr/sections/section_planes.hpp"
#include "strake/core/result.hpp"
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
struct SectionedShape {
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

struct SectionedShapes {
  std::vector<SectionedShape> all;
  std::vector<std::uint32_t> of;  ///< by body of the scene
};

/// The drawn bodies' shapes, cut. Errors: cancelled.
[[nodiscard]] Result<SectionedShapes> make_sectioned_shapes(const model::Scene& scene,
                                                            const std::vector<bool>& drawn,
                                                            std::span<const SectionPlane> planes,
                                                            const parallel::Context& context);

/// The feature edges of the source, in two or three where planes cut them: their kind does not
/// change with a cut. Errors: cancelled.
[[nodiscard]] Result<std::vector<FeatureEdge>> sectioned_edges(const SectionedShape& seen,
                                                               const FeatureOptions& options,
                                                               const parallel::Context& context);

}  // namespace strake::hlr
