// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// What became of the objects of an earlier drawing.
struct Comparison {
  /// By object now, its number in the earlier drawing; model::kNoObject where it is new or another.
  std::vector<std::uint32_t> before;
  std::vector<geometry::Box3l> left;  ///< where objects were that are gone or others now
  bool same_numbers = true;           ///< each object that stayed has the number that it had
  std::size_t changed = 0;            ///< objects now that are new or others

  /// Returns whether all is as it was.
  [[nodiscard]] bool nothing() const { return left.empty() && changed == 0; }
};

/// Counts objects that stayed as changed where they have another hatch. `boxes` are those of the
/// earlier drawing. Where one of the two has no hatches at all, all are changed.
void mark_changed_hatches(std::span<const Hatch> earlier, std::span<const Hatch> now,
                          std::span<const geometry::Box3l> boxes, Comparison& comparison);

/// Compares by a mapping and the boxes of earlier objects, see EarlierDrawing. Lines of an object
/// are numbered in the order of the objects that it meets: of objects that changed places in the
/// order as few as possible count as others. Errors: usage for a mapping that does not fit.
[[nodiscard]] Result<Comparison> compare_objects(std::span<const std::uint32_t> now,
                                                 std::span<const geometry::Box3l> boxes,
                                                 std::size_t objects);

}  // namespace strake::hlr
