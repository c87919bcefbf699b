// SPDX-License-Identifier: Apache-2.0
// The signed separation of two convex primitives by a method that the engine knows nothing of: the
// ellipsoid method (Shor 1977; Bland, Goldfarb and Todd 1981) on supports and depths written from
// docs/formats/primitives.md with the C library's trigonometry.
#pragma once

#include <optional>

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

/// A primitive under a rotation, maybe mirrored.
struct OracleBody {
  const geometry::Primitive* primitive = nullptr;
  geometry::Placement at;
};

/// lower <= d <= upper but for the rounding of doubles, mm.
struct OracleSeparation {
  double lower = 0, upper = 0;
};

/// Of what is further apart than it overlaps a convex program for the distance, else one for each
/// depth. Nothing for kinds that are not convex.
[[nodiscard]] std::optional<OracleSeparation> oracle_separation(const OracleBody& a,
                                                                const OracleBody& b);

}  // namespace strake::test
