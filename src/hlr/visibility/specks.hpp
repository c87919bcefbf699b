// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0045 says why specks become like what is beside them.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Tells what of a drawing is a speck: no longer in the plane of the view than twice the contact
/// distance of its objects.
///
/// Skins that touch within the contact distance leave such pieces open along the edges that run
/// into them: √3 of it, as depths are measured in the normal's taxicab length, and what rounding to
/// the grid adds. The states of the exact solvers do not know of this rule, only what is made of
/// them does.
class SpeckRule {
 public:
  explicit SpeckRule(const ViewJob& job);

  /// In grid units, for the lines of an object or, at intersections, of two; 0: nothing is one.
  [[nodiscard]] std::int64_t longest(model::ObjectId object, model::ObjectId other) const;
  [[nodiscard]] std::int64_t longest(const EdgePiece& piece) const {
    return longest(piece.object, piece.other);
  }
  /// Whether the way between two points of the model is no longer in the plane of the view.
  [[nodiscard]] bool within(const geometry::Vec3l& a, const geometry::Vec3l& b,
                            std::int64_t longest) const;
  /// In the plane of the view, or in perspective in one parallel to it.
  [[nodiscard]] double length(const geometry::Vec3l& a, const geometry::Vec3l& b) const;

 private:
  Viewer viewer_;
  geometry::Vec3l origin_;
  double direction_length_ = 1;
  std::vector<std::int64_t> longest_;  ///< by object
};

/// Makes the specks among the pieces of one edge, those from `first` on, like the longer stretch
/// beside them, and one of equal neighbours: no gap is left. First what is seen and what is hidden,
/// whoever hides it, so that it is the same where hidden pieces are not asked for; then by whom. A
/// run of specks that is longer than one is what most of it is. What is clipped stays so, and an
/// edge that is a speck as a whole is of one kind. Returns how many specks there were.
std::size_t absorb_specks(const SpeckRule& rule, std::size_t first, std::vector<EdgePiece>& pieces);

/// Takes out the pieces from `first` on that the options do not ask for; true when there are any.
bool leave_out_unasked(const Options& options, std::size_t first, std::vector<EdgePiece>& pieces);

/// Visible specks that join nothing, of what absorb_specks() left, become points on paper: those
/// of an object that hang together by their ends within the length of a speck, and with no more
/// than one end on what is visible otherwise. Counts them in drawing.counters. Errors: cancelled.
[[nodiscard]] Status dot_lone_specks(const ViewJob& job, const parallel::Context& context,
                                     Drawing& drawing);

}  // namespace strake::hlr
