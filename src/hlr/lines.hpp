// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlr/crossings.hpp"
#include "hlr/section_planes.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A line that is no edge of a part: an intersection, or what a section draws.
struct Line {
  geometry::Vec3l a, b;                  ///< grid units, rounded
  std::uint32_t body_a = 0, body_b = 0;  ///< two of an intersection, of object a <= b; else one
  EdgeKind kind = EdgeKind::intersection;
  bool cut_away = false;  ///< by a section plane: neither hidden nor seen
};

struct Lines {
  std::vector<Line> all;           ///< by object of body_a
  std::vector<std::size_t> first;  ///< by object, one more at the end; empty where there are none
  /// Least contact distance between these lines and any part. A line's ends are rounded to the
  /// grid: along each axis that takes it away from the faces that it lies on by half a unit at
  /// most, which is less than 1, and each section plane rounds lines and faces once more.
  std::int64_t contact = 1;

  /// Those that are drawn with an object.
  [[nodiscard]] std::span<const Line> of(std::uint32_t object) const {
    if (first.empty()) return {};
    return std::span(all).subspan(first[object], first[object + 1] - first[object]);
  }
};

struct Job;

/// Crossings, cut by the planes, and the sections of the bodies of a job that is otherwise ready,
/// hatched. Errors: a hatch that makes no sense (usage), cancelled.
[[nodiscard]] Result<Lines> gather_lines(const Job& job, std::span<const Crossing> crossings,
                                         std::span<const SectionPlane> planes,
                                         const parallel::Context& context);

}  // namespace strake::hlr
