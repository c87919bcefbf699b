// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/narrow_part.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::clash {

/// A closed form, its point relative to the origin of the part that was called a.
struct ClosedForm {
  geometry::AnalyticSeparation separation;
  geometry::Vec3d point;
  /// Nearer to a touch than the form can tell: which side of it is for the triangles to say.
  bool tie = false;
};

/// That of two primitives whose triangles are not their true surfaces, if there is one; `enough` as
/// in geometry::analytic_separation().
[[nodiscard]] std::optional<ClosedForm> closed_form(const NarrowPart& a, const NarrowPart& b,
                                                    double enough);

/// The relation that it shows; `band` is δ in grid units.
[[nodiscard]] Relation relation_of(const geometry::AnalyticSeparation& s, double band);

}  // namespace strake::clash
