// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hlr/shape_view.hpp"

namespace strake::hlr {

/// A body as the gathering sees it.
struct Placed {
  const ShapeView* view = nullptr;  ///< null: not drawn
  geometry::Vec3l offset;
  ViewPoint at;
  std::uint32_t object = 0;
  std::int64_t contact = 0;
  std::int64_t within = 0;         ///< the same among what is one part
  bool opaque = false;             ///< and, where there are limits, not wholly outside them
  bool cut = false;                ///< by the limits
  bool forgives_rounding = false;  ///< see Job::forgives_rounding()
  bool shares_own_hits = false;    ///< with the other bodies of its shape
  bool repeated = false;           ///< others that are equal, at its place, hide what it hides
};

}  // namespace strake::hlr
