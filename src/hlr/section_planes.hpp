// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/plane_cut.hpp"
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

}  // namespace strake::hlr
