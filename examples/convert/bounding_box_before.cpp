// SPDX-License-Identifier: Apache-2.0
#include "bounding_box.hpp"

namespace convert::before {
namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): what the conversion removes
std::vector<Box> box_cache;
std::vector<bool> in_cache;
Extent extent;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void add_part(const Model& model, std::uint32_t part) { extent.add(box_of(model, part), part); }

}  // namespace

const Box& box_of(const Model& model, std::uint32_t part) {
  if (in_cache.empty()) {
    box_cache.resize(model.size());
    in_cache.resize(model.size());
  }
  if (!in_cache[part]) {
    for (const Point& point : model[part].points) box_cache[part].add(point);
    in_cache[part] = true;
  }
  return box_cache[part];
}

void forget_boxes() {
  box_cache.clear();
  in_cache.clear();
}

Extent extent_of(const Model& model, std::span<const std::uint32_t> selected) {
  extent = {};
  for (const std::uint32_t part : selected) add_part(model, part);
  return extent;
}

}  // namespace convert::before
