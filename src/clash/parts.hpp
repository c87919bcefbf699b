// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/geometry/bvh.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::clash {

/// A placed part of the scene: what the broad phase pairs.
struct PartRef {
  geometry::PlacedPart placed;
  std::uint32_t object = 0;
  std::uint32_t number = 0;  ///< within its object
  std::uint32_t unique = 0;  ///< number of the part's geometry, shared by all bodies that place it
  std::uint32_t body = 0;    ///< index into Model::bodies
  float snap = 0;            ///< grid units: how far its skin may lie from the source's
  float step = 0;            ///< grid units: of the source's numbers where they are coarse, else 0
};

/// Solids and sheets of the objects in either set, and lines where asked for, by object and number.
struct PartList {
  std::vector<PartRef> parts;
  std::vector<const geometry::Part*> unique;
};

/// Errors: cancelled.
[[nodiscard]] Result<PartList> list_parts(const model::Scene& scene, const Sets& sets,
                                          Curves curves, const parallel::Context& context);

/// Grid units: what lies so much beyond a tolerance is for the narrow phase to see, since the snap
/// may have moved it there.
inline constexpr double kSnapReach = 4;

/// What boxes are inflated by for a tolerance, both in grid units.
[[nodiscard]] constexpr double search_reach(double tolerance) { return tolerance + kSnapReach + 1; }

/// The part's box, so much larger that the boxes of two parts meet where their true surfaces, which
/// may stand out of the tessellation by the sag, come within `reach` grid units, or as near as the
/// coarser one's numbers can tell.
[[nodiscard]] geometry::Box3l inflated_box(const PartRef& ref, double reach);

/// What the inflated boxes of two parts have in common, mm.
[[nodiscard]] geometry::Box3d common_box_mm(const PartRef& a, const PartRef& b, double reach);

/// Pairs of parts of different objects whose boxes come within `reach` grid units, as indices into
/// the list, by (objects, parts). Where these are very many, only those of which boxes along the
/// parts' own faces do, too.
[[nodiscard]] Result<std::vector<geometry::IndexPair>> near_pairs(const PartList& list,
                                                                  const Sets& sets, double reach,
                                                                  const Options& options,
                                                                  const parallel::Context& context);

}  // namespace strake::clash
