// SPDX-License-Identifier: Apache-2.0
// Boxes of objects that hold however a view tessellates them, and of all that is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "model/scene/view_tessellation.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Returns whether views tessellate a shape anew, as its true surface is curved.
[[nodiscard]] bool is_made_for_views(const model::GridShape& shape);

/// Where a shape lies, in the coordinates of the bodies that place it.
struct ShapeExtent {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();  ///< as the scene has it
  std::int64_t margin = 0;  ///< no tessellation for a view reaches farther beyond the box

  [[nodiscard]] geometry::Box3l outer() const { return box.empty() ? box : box.inflated(margin); }
};

/// Returns the extents by shape. Errors: cancelled.
[[nodiscard]] Result<std::vector<ShapeExtent>> shape_extents(const model::Scene& scene,
                                                             const parallel::Context& context);

/// Returns the outer boxes of the objects that are drawn (`drawn` empty: all) and of the lines that
/// a view adds to them; empty for the others. Errors: cancelled.
[[nodiscard]] Result<std::vector<geometry::Box3l>> object_extents(
    const model::Scene& scene, const std::vector<bool>& drawn, const View& view,
    std::span<const ShapeExtent> shapes, const parallel::Context& context);

/// The box of all that is drawn, as the view tessellates it, and the longest side of a body.
struct DrawnExtent {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();
  std::int64_t longest_side = 0;
  std::int64_t contact = 0;  ///< the largest contact distance
};

/// Returns the extent of what is drawn, exactly, without the meshes of the view: of these only
/// those that may reach farthest are made. Errors: cancelled.
[[nodiscard]] Result<DrawnExtent> drawn_extent(
    const model::Scene& scene, const std::vector<bool>& drawn, std::span<const ShapeExtent> shapes,
    const model::ViewTessellationOptions& tessellation_options, const model::ViewTessellation& plan,
    const Options& options, const parallel::Context& context);

/// What the parts of a view have to know of all that is drawn.
struct WholeExtent {
  DrawnExtent drawn;
  std::vector<geometry::Box3l> boxes;    ///< by object, as object_extents() has them
  model::ViewTessellation tessellation;  ///< by shape of the scene
  double sag_mm = 0;                     ///< as Drawing::sag_mm

  /// Returns what a part takes of it; its tessellation is by its own shapes, and is to be filled.
  [[nodiscard]] WholeView view_of(std::span<const Hatch> hatches) const;
};

/// Finds it without the meshes of the view. Errors: usage for sections that make no sense;
/// cancelled.
[[nodiscard]] Result<WholeExtent> whole_extent(const model::Scene& scene,
                                               const std::vector<bool>& drawn, const View& view,
                                               const Options& options,
                                               const parallel::Context& context);

}  // namespace strake::hlr
