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
};

/// Solids and sheets of the objects in either set, and lines where asked for, by object and number.
struct PartList {
  std::vector<PartRef> parts;
  std::vector<const geometry::Part*> unique;
};

/// Errors: cancelled.
[[nodiscard]] Result<PartList> list_parts(const model::Scene& scene, const Sets& sets,
                                          Curves curves, const parallel::Context& context);

/// What is added to the largest tolerance, both in grid units, before boxes are inflated by it:
/// what lies exactly at a threshold is for the narrow phase to see.
[[nodiscard]] constexpr double search_reach(double tolerance) { return tolerance + 2; }

/// The part's box, so much larger that the boxes of two parts meet where their true surfaces, which
/// may stand out of the tessellation by the sag, come within `reach` grid units.
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
