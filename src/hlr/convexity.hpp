// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hlr/feature_edges.hpp"
#include "strake/geometry/part.hpp"

namespace strake::hlr {

/// The normal of a triangle, and its product with the direction of a view.
struct TrianglePlane {
  std::array<std::int64_t, 3> n{};
  Int128 facing = 0;
  bool edge_on = false;  ///< see may_be_edge_on(); where it is asked for
};

/// Whether a locally convex closed surface of one shell bounds a convex body: it does when some
/// point lies strictly inside all its planes and a ray from there meets it once (Mehlhorn et al.,
/// Checking geometric programs, 1996). False where there is doubt.
[[nodiscard]] bool bounds_convex_body(const geometry::Part& part,
                                      std::span<const TrianglePlane> planes);

}  // namespace strake::hlr
