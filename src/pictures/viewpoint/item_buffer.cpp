// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/item_buffer.hpp"

#include <algorithm>

namespace strake::pictures {
namespace {

/// Puts a face where it is nearer than what is there.
void keep_nearest(ItemBuffer::Item& item, const ItemBuffer::Item& found, bool preferred) {
  constexpr auto kSame = static_cast<float>(kSameDepthMm);
  if (found.depth > item.depth + (preferred ? -kSame : kSame)) item = found;
}

}  // namespace

ItemBuffer::ItemBuffer(const Window& window, std::uint32_t first_row, std::uint32_t end_row)
    : window_(window),
      first_row_(first_row),
      end_row_(end_row),
      items_(std::size_t{end_row - first_row} * window.columns) {
  if (window.closes_cuts) own_.resize(items_.size());
}

void ItemBuffer::add(std::span<const ProjectedTriangle> triangles,
                     std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) add(triangles[number], number);
  if (!own_.empty()) close_cuts(triangles);
}

void ItemBuffer::close_cuts(std::span<const ProjectedTriangle> triangles) {
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (const Item& own = own_[i];
        own.triangle != kNothing && triangles[own.triangle].back && triangles[own.triangle].solid)
      items_[i] = own;
}

void ItemBuffer::add(const ProjectedTriangle& triangle, std::uint32_t number) {
  Item found{0, number & kNothing, triangle.own ? 1U : 0U};
  const std::uint32_t end = std::min(triangle.end, end_row_);
  for (std::uint32_t row = std::max(triangle.first, first_row_); row < end; ++row) {
    const TriangleRow in_row(window_, triangle, row);
    const std::size_t at = place(0, row);
    for (std::uint32_t column = in_row.first(); column < in_row.end(); ++column) {
      found.depth = static_cast<float>(in_row.depth(column));
      Item& item = items_[at + column];
      keep_nearest(item, found, triangle.own && item.own == 0);
      if (triangle.own && !own_.empty()) keep_nearest(own_[at + column], found, false);
    }
  }
}

}  // namespace strake::pictures
