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

/// A shape cut by section planes: its parts, the lines of the cuts and the rims of the caps.
struct ShapeCut {
  model::GridShape shape;  ///< its parts keep the numbers that they have in the source
  std::vector<geometry::SectionLine> lines;
  std::vector<std::vector<geometry::Segment>> rims;  ///< the caps' oriented rims, by plane
  std::uint32_t open_ends = 0, not_filled = 0;
};

/// A shape as a view sees it, shared by all bodies that the planes cut alike.
struct SectionedShape {
  const model::GridShape* source = nullptr;  ///< the shape whose edges are drawn
  std::vector<std::uint32_t> numbers;        ///< numbers of the section planes that cut it
  std::vector<geometry::CutPlane> planes;    ///< the same planes in its coordinates
  bool away = false;                         ///< wholly cut away
  std::unique_ptr<ShapeCut> cut;             ///< null: equal to the source
  /// Contact distance within a part: zero unless planes rounded its vertices.
  std::int64_t within = 0;

  /// The shape that hides.
  [[nodiscard]] const model::GridShape& shape() const { return cut ? cut->shape : *source; }
};

struct SectionedShapes {
  std::vector<SectionedShape> all;
  std::vector<std::uint32_t> of;  ///< index into `all`, by body of the scene
};

/// Cuts the shapes of the drawn bodies, those of the objects in `uncut` (empty: none) aside.
/// Errors: cancelled.
[[nodiscard]] Result<SectionedShapes> make_sectioned_shapes(const model::Scene& scene,
                                                            const std::vector<bool>& drawn,
                                                            const std::vector<bool>& uncut,
                                                            std::span<const SectionPlane> planes,
                                                            const parallel::Context& context);

/// Returns the feature edges of the source, in two or three pieces where planes cut them: their
/// kind does not change with a cut. Errors: cancelled.
[[nodiscard]] Result<std::vector<FeatureEdge>> sectioned_edges(const SectionedShape& sectioned,
                                                               const FeatureOptions& options,
                                                               const parallel::Context& context);

}  // namespace strake::hlr
