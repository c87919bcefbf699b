// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line along which the skins of two parts pass through each other.
struct IntersectionLine {
  geometry::Vec3l a, b;                  ///< grid units; off by half a unit at most along each axis
  std::uint32_t body_a = 0, body_b = 0;  ///< body_a's object comes before body_b's or is the same
};

struct IntersectionLines {
  std::vector<IntersectionLine> all;   ///< sorted by object of body_a
  std::uint64_t pairs = 0, tests = 0;  ///< as Counters::crossing_pairs and crossing_tests
  std::uint64_t met = 0;  ///< pairs of parts that were examined, each of equal ones counted
};

/// Which intersections are lines of a drawing.
struct IntersectionRule {
  Intersections which = Intersections::objects;
  double cos_sharp = 1;  ///< primitives of one object intersect where their skins turn by more
  /// By object: the lines that are drawn with it are wanted. Empty: those of all objects.
  std::vector<bool> to_solve = {};
  /// Returns whether lines in a box, grid units, are wanted; none are looked for of parts in other
  /// ones (decision 0127). Empty: all lines are wanted.
  std::function<bool(const geometry::Box3l& box)> shows = {};
};

/// Finds the intersection lines among the drawn objects. `contact`: by body, the distance within
/// which faces are meant to touch. Errors: cancelled, too many boxes that meet (input).
[[nodiscard]] Result<IntersectionLines> find_intersection_lines(
    const model::Scene& scene, const std::vector<bool>& drawn,
    const std::vector<std::int64_t>& contact, const IntersectionRule& rule,
    const parallel::Context& context);

}  // namespace strake::hlr
