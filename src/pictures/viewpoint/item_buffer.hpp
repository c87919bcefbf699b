// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pictures/viewpoint/window.hpp"

namespace strake::pictures {

/// Item buffer: which triangle each point of a view shows (Weghorst, Hooper and Greenberg 1984), by
/// depth; of equals the clash's own, then the first. It has some rows of a window, so that it stays
/// small however fine the window is.
class ItemBuffer {
 public:
  static constexpr std::uint32_t kNothing = 0x7fffffffU;
  struct Item {
    float depth = -1e30F;  ///< mm towards the viewer
    std::uint32_t triangle : 31 = kNothing;
    std::uint32_t own : 1 = 0;  ///< it is of the clash
  };

  /// The window must outlast it.
  ItemBuffer(const Window& window, std::uint32_t first_row, std::uint32_t end_row);

  /// Adds triangles of project_triangles() by their numbers there, in their order.
  void add(std::span<const ProjectedTriangle> triangles, std::span<const std::uint32_t> numbers);

  /// The row is that of the window, from above.
  [[nodiscard]] const Item& at(std::uint32_t column, std::uint32_t row) const {
    return items_[place(column, row)];
  }

 private:
  [[nodiscard]] std::size_t place(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row - first_row_} * window_.columns + column;
  }
  void add(const ProjectedTriangle& triangle, std::uint32_t number);
  void close_cuts(std::span<const ProjectedTriangle> triangles);

  const Window& window_;
  std::uint32_t first_row_, end_row_;
  std::vector<Item> items_;
  std::vector<Item> own_;  ///< the same of the clash's own triangles, where cuts are closed
};

}  // namespace strake::pictures
