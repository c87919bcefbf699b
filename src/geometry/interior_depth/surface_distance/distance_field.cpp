// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

#include <cstddef>
#include <utility>

#include "geometry/obb/rotated_part.hpp"

namespace strake::geometry {

void DistanceField::prepare() {
  constexpr std::size_t kMax = 16384;
  const std::size_t n = part().triangles.size();
  if (n > kMax || !prepared_.empty()) return;
  prepared_.reserve(n);
  for (std::uint32_t t = 0; t < n; ++t) prepared_.emplace_back(corners_of(part(), t));
  const PairLocalPart own(*part_, {});
  const auto axes = sliver_axes(own);
  if (!axes) return;
  if (auto turned = rotate_part(own, *axes, {}))
    frame_ = std::make_shared<const RotatedFrame>(RotatedFrame{*axes, std::move(*turned)});
}

}  // namespace strake::geometry
