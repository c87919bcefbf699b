// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Unit vectors of a view: to the right and up on paper, and towards the viewer.
struct ViewAxes {
  geometry::Vec3d right, up, toward;
};

/// Where the upward direction does not show on paper another one is up.
[[nodiscard]] ViewAxes axes_of(const View& view);

/// A direction without common factors.
[[nodiscard]] geometry::Vec3l in_lowest_terms(const geometry::Vec3l& d);

}  // namespace strake::hlr
