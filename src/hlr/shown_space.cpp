// SPDX-License-Identifier: Apache-2.0
#include "hlr/shown_space.hpp"

#include <algorithm>

namespace strake::hlr {

ShownSpace::ShownSpace(const View& view, std::span<const SectionPlane> sections)
    : limits_(view.limits), planes_(sections.begin(), sections.end()) {
  for (const HalfSpace& side : window(view)) {
    // Kept is what is at least so high over the plane through the eye.
    const geometry::Int128 of_eye = SectionPlane{side.normal}.height(view.perspective->eye);
    planes_.push_back({-side.normal, -of_eye - side.least});
  }
}

bool ShownSpace::meets(const geometry::Box3l& box) const {
  return (!limits_ || box.meets(*limits_)) &&
         std::ranges::all_of(planes_,
                             [&](const SectionPlane& plane) { return plane.least(box) < 0; });
}

}  // namespace strake::hlr
