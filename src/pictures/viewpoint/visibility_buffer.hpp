// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pictures/viewpoint/window.hpp"

namespace strake::pictures {

// Decision 0105 says what is looked at, and what it costs.

/// What a window shows of the two.
struct VisibleShares {
  double a = 0, b = 0;  ///< shares of the disc within the window
  double at_point = 0;  ///< the share of the two of what lies round the middle
};

/// Which of the two objects of a clash each point of a window shows: an item buffer that knows
/// nothing of all others but what of the two they hide.
class VisibilityBuffer {
 public:
  /// Nothing is seen.
  VisibilityBuffer() = default;
  /// The two alone. The window has no box and no planes, and as many rows as columns.
  VisibilityBuffer(const Window& window, const NearTriangles& triangles);

  /// Takes away what others hide.
  void cover(const Window& window, const NearTriangles& triangles);

  [[nodiscard]] VisibleShares shares() const;

 private:
  struct Point {
    double depth = -1e300;
    Role role = Role::other;
    bool closed = false;  ///< cut open: nothing lies before it
  };
  void add(const Window& window, const ProjectedTriangle& triangle, Role role);
  void cover(const Window& window, const ProjectedTriangle& triangle);
  void bound();
  [[nodiscard]] bool may_hide(const WindowRange& range) const;

  std::uint32_t points_ = 0;  ///< each way
  std::vector<Point> at_;
  WindowRange own_;  ///< what of the window the two are in; nearest is where the last of it is
};

}  // namespace strake::pictures
