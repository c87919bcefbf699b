// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// Hidden-line removal that follows what changed since an earlier drawing.
namespace strake::hlr {

/// Hashes of all that draw() sees.
struct Signatures {
  Hash128 view;                  ///< of the view, and of the options that can change the drawing
  std::vector<Hash128> objects;  ///< of each object: its bodies on the grid, colours, whether drawn
};

/// Returns the signatures of one view. The numbers of objects do not show in them. Errors:
/// cancelled.
[[nodiscard]] Result<Signatures> signatures(const model::Scene& scene,
                                            const std::vector<bool>& drawn, const View& view,
                                            const Options& options,
                                            const parallel::Context& context);

/// An object that is gone, or has another signature now.
inline constexpr std::uint32_t kChanged = 0xffffffffU;

/// An earlier drawing whose view had the same signature.
struct EarlierDrawing {
  const Drawing* drawing = nullptr;
  /// For each object of that drawing, its number now; kChanged where there is none with the same
  /// identity and signature.
  std::span<const std::uint32_t> now;
  /// The box of each of its objects, grid units; empty where it has no bodies.
  std::span<const geometry::Box3l> boxes;
};

/// How a drawing came about.
struct Redrawn {
  Drawing drawing;
  std::uint64_t edges_solved = 0;   ///< edges whose visibility was found anew
  std::uint64_t objects_solved = 0; ///< objects with such edges
  bool in_full = false;             ///< everything was found anew, as `why` says
  std::string_view why = {};        ///< a literal
};

/// Returns the drawing that draw() returns, but finds anew only the visibility of edges that what
/// changed can reach on paper. Errors: those of draw(); usage for a mapping that does not fit.
[[nodiscard]] Result<Redrawn> draw_changes(const model::Scene& scene,
                                           const std::vector<bool>& drawn, const View& view,
                                           const Options& options, const EarlierDrawing& earlier,
                                           const parallel::Context& context);

}  // namespace strake::hlr
