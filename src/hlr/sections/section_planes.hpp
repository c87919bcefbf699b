// SPDX-License-Identifier: Apache-2.0
// Section planes in world coordinates, and the space that limits, sections and frustum leave.
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

/// A section plane of a view, normal·p = offset in world coordinates; the normal is in lowest
/// terms.
struct SectionPlane {
  geometry::Vec3l normal;
  geometry::Int128 offset = 0;

  /// Returns the plane in the coordinates of a body at `origin`. An offset beyond the reach of any
  /// body is cut down, which changes no result.
  [[nodiscard]] geometry::CutPlane at(const geometry::Vec3l& origin) const;
  [[nodiscard]] geometry::Int128 height(const geometry::Vec3l& p) const;
  /// Return the least and the greatest height over the plane of a box that is not empty. What is
  /// not below zero is cut away.
  [[nodiscard]] geometry::Int128 least(const geometry::Box3l& box) const;
  [[nodiscard]] geometry::Int128 greatest(const geometry::Box3l& box) const;

  friend auto operator<=>(const SectionPlane&, const SectionPlane&) = default;
};

/// Returns the planes, sorted and each once. Errors: a normal that is zero or too long, a point out
/// of reach, too many planes.
[[nodiscard]] Result<std::vector<SectionPlane>> section_planes(std::span<const Section> sections);

/// The space within the limits and the frustum of a view that no section cuts away. The view must
/// be one that draw() takes.
class ViewVolume {
 public:
  ViewVolume(const View& view, std::span<const SectionPlane> sections);

  /// Returns whether a box that is not empty, in grid units, meets the space. A box that only comes
  /// near to a corner of the space may count as well.
  [[nodiscard]] bool meets(const geometry::Box3l& box) const;
  /// Returns whether there is anything that it does not meet.
  [[nodiscard]] bool is_bounded() const { return limits_ || !planes_.empty(); }

 private:
  std::optional<geometry::Box3l> limits_;
  std::vector<SectionPlane> planes_;  ///< section planes, and the sides of the frustum
};

}  // namespace strake::hlr
