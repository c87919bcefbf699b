// SPDX-License-Identifier: Apache-2.0
// Specks: pieces shorter than the contact distance can tell, absorbed after the exact solution.
#pragma once

// Decision 0045 says why specks become like what is beside them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Defines specks: pieces no longer in the plane of the view than twice the contact distance of
/// their objects.
///
/// Skins that touch within the contact distance leave such pieces open along the edges that run
/// into them: √3 of it, as depths are measured in the normal's taxicab length, and what rounding to
/// the grid adds. The exact solvers do not know of this rule; it is applied to their results.
class SpeckRule {
 public:
  /// Errors: cancelled.
  [[nodiscard]] static Result<SpeckRule> of(const ViewJob& job, const parallel::Context& context);

  /// Returns the greatest length of a speck, grid units, on lines of an object or, at
  /// intersections, of two; 0: none.
  [[nodiscard]] std::int64_t longest(model::ObjectId object, model::ObjectId other) const;
  [[nodiscard]] std::int64_t longest(const EdgePiece& piece) const {
    return longest(piece.object, piece.other);
  }
  /// Returns whether two points of the model are no farther apart than `longest` in the plane of
  /// the view.
  [[nodiscard]] bool within(const geometry::Vec3l& a, const geometry::Vec3l& b,
                            std::int64_t longest) const;
  /// Returns the length in the plane of the view, or in perspective in a plane parallel to it.
  [[nodiscard]] double length(const geometry::Vec3l& a, const geometry::Vec3l& b) const;
  /// Returns whether hidden pieces stay in the drawing.
  [[nodiscard]] bool keeps_hidden() const { return keeps_hidden_; }

 private:
  explicit SpeckRule(const ViewJob& job);

  Viewer viewer_;
  geometry::Vec3l origin_;
  double direction_length_ = 1;
  bool keeps_hidden_ = true;
  std::vector<std::int64_t> longest_;  ///< by object
};

/// Gives the specks among the pieces of one edge, those from `first` on, the state of the longer
/// interval beside them, and joins equal neighbours: no gap is left. Visible or hidden is settled
/// first, whoever hides it, so that it is the same where hidden pieces are not kept; then by whom.
/// A run of specks that is longer than a speck takes the state of most of it. Clipped pieces stay
/// so, and an edge that is a speck as a whole has one state. Returns how many specks there were.
std::size_t absorb_specks(const SpeckRule& rule, std::size_t first, std::vector<EdgePiece>& pieces);

/// Pieces of an edge that the options do not request.
struct UnwantedPieces {
  bool hidden = false;        ///< there were hidden ones
  std::uint32_t clipped = 0;  ///< clipped ones
};

/// Removes the pieces of an edge, which begin at `first`, that the options do not request. Decision
/// 0125 says why clipped ones are counted.
UnwantedPieces leave_out_unwanted(const Options& options, std::size_t first,
                                  std::vector<EdgePiece>& pieces);

/// Returns whether any of the pieces from `first` on is a visible speck.
[[nodiscard]] bool has_visible_specks(const SpeckRule& rule, std::size_t first,
                                      std::span<const EdgePiece> pieces);

/// Makes visible specks that join nothing, of those that absorb_specks() left, points on paper:
/// specks of an object that hang together by their ends within the length of a speck, with no more
/// than one end on other visible lines. Counts them in drawing.counted. `specked`: by object,
/// whether it has visible specks, as the solver that made its pieces found. Errors: cancelled.
[[nodiscard]] Status dot_lone_specks(const ViewJob& job, const SpeckedObjects& specked,
                                     const parallel::Context& context, Drawing& drawing);

}  // namespace strake::hlr
