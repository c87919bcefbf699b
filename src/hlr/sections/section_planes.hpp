// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "geometry/plane_section/plane_section.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A section plane of a view, normal·p = offset in world coordinates; the normal in lowest terms.
struct SectionPlane {
  geometry::Vec3l normal;
  geometry::Int128 offset = 0;

  /// The same for a body at `origin`. Beyond what a body can reach the offset is cut down: there
  /// it decides nothing.
  [[nodiscard]] geometry::CutPlane at(const geometry::Vec3l& origin) const;
  [[nodiscard]] geometry::Int128 height(const geometry::Vec3l& p) const;
  /// The least and the greatest height of a box that is not empty over the plane: what is not
  /// below zero is cut away.
  [[nodiscard]] geometry::Int128 least(const geometry::Box3l& box) const;
  [[nodiscard]] geometry::Int128 greatest(const geometry::Box3l& box) const;

  friend auto operator<=>(const SectionPlane&, const SectionPlane&) = default;
};

/// The planes, each once and in an order of their own. Errors: a normal that is zero or too long,
/// a point out of reach, too many planes.
[[nodiscard]] Result<std::vector<SectionPlane>> section_planes(std::span<const Section> sections);

/// What a view has within its limits and its window, and no section cuts away. For a view that
/// draw() takes.
class ViewVolume {
 public:
  ViewVolume(const View& view, std::span<const SectionPlane> sections);

  /// Whether a box that is not empty, grid units, has anything of it; a box that only comes near to
  /// a corner of the space may count as well.
  [[nodiscard]] bool meets(const geometry::Box3l& box) const;

 private:
  std::optional<geometry::Box3l> limits_;
  std::vector<SectionPlane> planes_;  ///< of sections, and the sides of the window
};

}  // namespace strake::hlr
