// SPDX-License-Identifier: Apache-2.0
// Where things lie on the paper of a view, known well enough to say what can hide what.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/view/perspective_map.hpp"
#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A view whose boxes and segments are compared. Coordinates are grid units of the model.
class BoundsProjection {
 public:
  /// `drawn`: the box of all that is drawn.
  BoundsProjection(const View& view, const geometry::Box3l& drawn);

  /// Returns whether a box is so near to what is drawn that its place on paper can be known.
  [[nodiscard]] bool reaches(const geometry::Box3l& box) const;

  /// Returns the box on paper of what may hide in a box of the model; empty where nothing can, as
  /// outside the limits.
  [[nodiscard]] ViewBox box_of(const geometry::Box3l& box) const;

  /// Returns a query for what may hide an edge; nothing where none of it is drawn.
  [[nodiscard]] std::optional<SegmentQuery> edge(const geometry::Vec3l& a,
                                                 const geometry::Vec3l& b) const;

 private:
  [[nodiscard]] SegmentQuery orthographic(const ViewPoint& a, const ViewPoint& b) const;

  ViewProjection projection_;
  geometry::Vec3l origin_;
  std::int64_t largest_ = 1;  ///< of the direction's components
  std::optional<geometry::Box3l> limits_;
  std::vector<HalfSpace> window_;
  std::optional<PerspectiveMap> map_;
};

/// Queries by what may be hidden: the tree of boxes turned round.
class OccludeeTree {
 public:
  explicit OccludeeTree(std::vector<SegmentQuery> queries);

  /// Returns whether what lies in a box on paper may hide any of it.
  [[nodiscard]] bool may_be_hidden_by(const ViewBox& box) const;

 private:
  std::vector<SegmentQuery> queries_;
  ViewBvh tree_;  ///< by depth away from the viewer
};

}  // namespace strake::hlr
