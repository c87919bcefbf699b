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

/// Solids and sheets of the objects in either set, by object and number.
struct PartList {
  std::vector<PartRef> parts;
  std::vector<const geometry::Part*> unique;
};

[[nodiscard]] PartList list_parts(const model::Scene& scene, const Sets& sets);

/// Pairs of parts of different objects whose boxes come within `reach` grid units, as indices into
/// the list, by (objects, parts).
[[nodiscard]] Result<std::vector<geometry::IndexPair>> near_pairs(const PartList& list,
                                                                  const Sets& sets, double reach,
                                                                  const Options& options,
                                                                  const parallel::Context& context);

}  // namespace strake::clash
