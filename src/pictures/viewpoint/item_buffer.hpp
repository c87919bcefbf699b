// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pictures/scenery/surroundings.hpp"
#include "pictures/viewpoint/camera.hpp"

namespace strake::pictures {

/// What an item buffer shows: a window about the point that triangles are reckoned from.
struct Window {
  Axes axes;
  double half_width_mm = 1, half_height_mm = 1;
  std::uint32_t columns = 1, rows = 1;
  double eye_mm = 1e300;  ///< what lies nearer to the viewer than this is behind the eye
  /// What lies outside is not there.
  std::optional<geometry::Box3d> box = std::nullopt;
  std::vector<ClippingPlane> planes = {};  ///< mm from the same point
};

/// Item buffer: which triangle each point of a view shows (Weghorst, Hooper and Greenberg 1984), by
/// depth; of equals the clash's own, then the first. What a plane cuts open is closed: there a face
/// of the clash that is seen from within covers all that lies before it.
class ItemBuffer {
 public:
  static constexpr std::uint32_t kNothing = 0xffffffffU;
  struct Item {
    std::uint32_t triangle = kNothing;
    bool back = false;      ///< its back is seen
    bool own = false;       ///< it is of the clash
    double depth = -1e300;  ///< mm towards the viewer
  };

  ItemBuffer(const Window& window, std::span<const NearTriangle> triangles);

  /// Rows from above.
  [[nodiscard]] const Item& at(std::uint32_t column, std::uint32_t row) const {
    return items_[std::size_t{row} * columns_ + column];
  }

 private:
  void add(const Window& window, std::uint32_t number, const NearTriangle& triangle);

  void close_cuts(std::span<const NearTriangle> triangles);

  std::uint32_t columns_;
  std::vector<Item> items_;
  std::vector<Item> own_;  ///< the same of the clash's own triangles, where planes cut
};

}  // namespace strake::pictures
