// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0071 says what of a drawing follows a change, and why.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// Hidden-line removal that follows what changed since an earlier drawing.
namespace strake::hlr {

/// Hashes of all that draw() sees. Options that change the work and never the answer (solver,
/// culling, bucketing) are not seen; nor are names, but where reports on sections or the eye tell
/// them: other diagnostics are made anew by draw_changes().
struct Signatures {
  Hash128 view;                  ///< of the view, and of the options that can change the drawing
  std::vector<Hash128> objects;  ///< of each object: its bodies on the grid, whether it is drawn …
  /// The box of each object that is drawn, however a view tessellates it, in grid units; empty for
  /// the others, and where there are no bodies. Drawings to come request those of this one.
  std::vector<geometry::Box3l> boxes;
};

/// Returns the signatures of one view. The numbers of objects do not show in them. The view must be
/// one that draw() takes. Errors: usage for a selection of the wrong size and for sections that
/// make no sense; cancelled.
[[nodiscard]] Result<Signatures> signatures(const model::Scene& scene,
                                            const std::vector<bool>& drawn, const View& view,
                                            const Options& options,
                                            const parallel::Context& context);

/// An earlier drawing whose view had the same signature.
struct EarlierDrawing {
  /// As draw() or draw_changes() returned it; what stays of it is moved. Where the capacity of its
  /// pieces is a little larger than their number, they stay where they are.
  Drawing drawing;
  /// For each object of that drawing, its number now; model::kNoObject where there is none with the
  /// same identity and signature.
  std::span<const std::uint32_t> now;
  std::span<const geometry::Box3l> boxes;  ///< Signatures::boxes of that drawing
};

/// How a drawing came about.
struct Redrawn {
  Drawing drawing;
  std::uint64_t edges_solved = 0;    ///< edges whose visibility was found anew
  std::uint64_t objects_solved = 0;  ///< objects with such edges
  bool in_full = false;              ///< everything was found anew, as `why` says
  std::string_view why = {};         ///< a literal; empty unless `in_full`
  /// Of each object, whether what the drawing says of it may differ from what the earlier drawing
  /// says of the object of that number; empty: it may of any.
  std::vector<bool> touched = {};
};

/// Returns the drawing that draw() returns, but finds anew only the lines of objects that changed
/// or that a change can reach on paper. All is equal but Counters of the work: of these the edges,
/// specks and what was left out are equal, and the others tell of the work that was done. Errors:
/// those of draw(); usage for a mapping that does not fit.
[[nodiscard]] Result<Redrawn> draw_changes(const model::Scene& scene,
                                           const std::vector<bool>& drawn, const View& view,
                                           const Options& options, EarlierDrawing earlier,
                                           const parallel::Context& context);

}  // namespace strake::hlr
