// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hlr/frame.hpp"
#include "hlr/param.hpp"
#include "hlr/world.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A feature edge of a body, or a line that is no edge of one, in the coordinates of the job.
struct AskedEdge {
  std::uint32_t body = 0;
  const Placed* own = nullptr;
  const Placed* other = nullptr;      ///< of an intersection the second body, otherwise `own`
  const EdgeView* feature = nullptr;  ///< null: a line that is no edge
  EdgeKind kind = EdgeKind::sharp;
  bool projecting = false;
  bool cut_away = false;
  std::int64_t contact = 0;
  geometry::Vec3l a, b;
  ViewPoint va, vb;  ///< orthographic

  AskedEdge() = default;
  AskedEdge(const World& world, std::uint32_t body_index, const EdgeView& e);
  AskedEdge(const World& world, const Line& line);

  /// In the model, rounded to the grid.
  [[nodiscard]] geometry::Vec3l at(const Param& t, const geometry::Vec3l& origin) const;

  /// Cuts [lo, hi] down to what lies within the limits, or the window; false when nothing of any
  /// length does.
  [[nodiscard]] bool clip(const geometry::Box3l& limits, Param& lo, Param& hi) const;
  [[nodiscard]] bool clip(std::span<const HalfSpace> window, Param& lo, Param& hi) const;
};

}  // namespace strake::hlr
