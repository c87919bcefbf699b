// SPDX-License-Identifier: Apache-2.0
// What a change can reach: whose lines are found anew, and what is needed for that.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/incremental/bounds_projection.hpp"
#include "hlr/incremental/comparison.hpp"
#include "hlr/prepare/view_job.hpp"
#include "model/scene/view_tessellation.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A scene in a view, with what is known of all of it.
struct ChangedView {
  const model::Scene& scene;
  const std::vector<bool>& drawn;
  const View& view;
  const Options& options;
  std::span<const geometry::Box3l> boxes;  ///< by object, see object_extents()
  const Comparison& comparison;
  const model::ViewTessellation& tessellation;
  WholeView whole;
  std::optional<WholeSections> sections;  ///< of views with sections

  [[nodiscard]] bool draws(std::size_t object) const { return drawn.empty() || drawn[object]; }
};

/// The part of a scene that is solved anew, by object.
struct ChangeReach {
  std::vector<bool> to_solve;  ///< its lines are found anew
  std::vector<bool> needed;    ///< it is asked, or may hide or cross what is
  bool reaches_most = false;   ///< it is most of what there is
};

/// Finds what changes can reach: objects that changed; those that the boxes of these meet, as their
/// intersections may be others; and those with an edge or line that what changed may have hidden,
/// or may hide now. Errors: as those of prepare_view().
[[nodiscard]] Result<ChangeReach> find_reach(const ChangedView& changed,
                                             const parallel::Context& context);

}  // namespace strake::hlr
