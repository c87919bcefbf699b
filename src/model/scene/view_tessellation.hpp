// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0027 says why every view tessellates round primitives along their contours, and
// decision 0109 how an eye sees them.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

/// How the primitives that a view shows are tessellated.
struct ViewTessellationOptions {
  /// The direction to the viewer, in lowest terms: contours of round primitives are edges
  /// (geometry::tessellate()). Absent: no direction.
  std::optional<geometry::Vec3l> towards = {};
  double sag_mm = 0;  ///< the largest sag of curved primitives; 0: that of the scene
  /// Whether anything of a body in that box, grid units, may be seen; bodies that cannot be seen
  /// keep the sag of the scene. Empty: all may be seen.
  std::function<bool(const geometry::Box3l&)> shows = {};
  /// The eye of a view in perspective, grid units: contours of round primitives from there are
  /// edges (geometry::tessellate_from()). Absent: the view is none in perspective.
  std::optional<geometry::Vec3l> eye = {};
};

/// What a view tessellates anew of a scene.
struct ViewTessellation {
  /// By shape: as fine as the view requests, since a body of it may be seen. Empty: none.
  std::vector<bool> finer;
  bool any = false;  ///< something changes: the view has meshes of its own

  [[nodiscard]] bool is_finer(std::uint32_t shape) const { return !finer.empty() && finer[shape]; }
};

/// Returns what tessellate_for_view() makes anew. `shows` is called by all workers. Errors:
/// cancelled, out of memory.
[[nodiscard]] Result<ViewTessellation> plan_view_tessellation(
    const Scene& scene, const std::vector<bool>& drawn,
    const ViewTessellationOptions& tessellation_options, const parallel::Context& context);

/// Returns a scene as a view sees it: its primitives are tessellated anew where that changes them,
/// once per shape and rotation as in `scene`; for an eye once per shape and place, of bodies that
/// may be seen, behind the shapes of `scene`. All else stays, with bodies in their order. `drawn`
/// says which objects are requested (empty: all); shapes that none of them uses are left empty. It
/// returns nothing where nothing changes: where no object that is drawn has a curved primitive that
/// is not fine enough or a round one with contours, or the scene was not made by make_scene().
///
/// Applied twice it changes nothing more. The model must outlive the result. Errors: cancelled.
[[nodiscard]] Result<std::optional<Scene>> tessellate_for_view(
    const Scene& scene, const std::vector<bool>& drawn,
    const ViewTessellationOptions& tessellation_options, const parallel::Context& context);

/// Does the same as a plan says, which may be that of more than is drawn here: what is finer then
/// is not asked of `shows`.
[[nodiscard]] Result<std::optional<Scene>> tessellate_for_view(
    const Scene& scene, const std::vector<bool>& drawn,
    const ViewTessellationOptions& tessellation_options, const ViewTessellation& plan,
    const parallel::Context& context);

}  // namespace strake::model
