// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hlr/section_planes.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// What a view has within its limits and its window, and no section cuts away. For a view that
/// draw() takes.
class ShownSpace {
 public:
  ShownSpace(const View& view, std::span<const SectionPlane> sections);

  /// Whether a box that is not empty, grid units, has anything of it; a box that only comes near to
  /// a corner of the space may count as well.
  [[nodiscard]] bool meets(const geometry::Box3l& box) const;

 private:
  std::optional<geometry::Box3l> limits_;
  std::vector<SectionPlane> planes_;  ///< of sections, and the sides of the window
};

}  // namespace strake::hlr
