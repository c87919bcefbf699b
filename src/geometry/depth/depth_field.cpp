// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/depth_field.hpp"

#include <cstddef>
#include <utility>

#include "geometry/aligned_parts.hpp"

namespace strake::geometry {

void DepthField::prepare() {
  constexpr std::size_t kMost = 16384;
  const std::size_t n = part().triangles.size();
  if (n > kMost || !prepared_.empty()) return;
  prepared_.reserve(n);
  for (std::uint32_t t = 0; t < n; ++t) prepared_.emplace_back(corners_of(part(), t));
  const PartView own(*part_, {});
  const auto axes = needle_axes(own);
  if (!axes) return;
  if (auto turned = turned_part(own, *axes, {}))
    frame_ = std::make_shared<const TurnedFrame>(TurnedFrame{*axes, std::move(*turned)});
}

}  // namespace strake::geometry
