// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/depth/depth_field.hpp"
#include "geometry/depth/level_cell.hpp"
#include "geometry/turned_part.hpp"

namespace strake::geometry {

/// Two solids as levels are asked for. Boxes along the coordinate axes tell nothing of needles that
/// lie askew to them (needle_axes): such solids are turned, and snapped to a finer grid.
class LevelFrame {
 public:
  /// Keeps references to both. `as_they_are`: they are not to be turned.
  LevelFrame(const DepthField& a, const DepthField& b, bool as_they_are);
  LevelFrame(const LevelFrame&) = delete;
  LevelFrame& operator=(const LevelFrame&) = delete;

  [[nodiscard]] const DepthField& a() const { return turned_a_ ? turned_a_->field : a_; }
  [[nodiscard]] const DepthField& b() const { return turned_b_ ? turned_b_->field : b_; }
  /// Half-spaces that hold either.
  [[nodiscard]] const std::vector<HalfSpace>& hull_a() const { return hull_a_; }
  [[nodiscard]] const std::vector<HalfSpace>& hull_b() const { return hull_b_; }
  /// Units of the frame in a grid unit.
  [[nodiscard]] double scale() const;
  /// Grid units that the two may be less deep in each other here than they are.
  [[nodiscard]] double error() const;
  /// Where a point of both of the frame was before the turn: in both too, but for rounding.
  [[nodiscard]] Vec3d back(const Vec3d& in_frame, PairWork& work) const;

 private:
  struct Turned {
    TurnedPart turned;
    TreedPart part;
    DepthField field;
    Turned(TurnedPart&& from, const Part& original);
  };

  void turn();
  [[nodiscard]] std::vector<HalfSpace> hull_of(const DepthField& original) const;

  const DepthField &a_, &b_;
  Axes axes_{};  ///< as long as a grid unit has units
  std::optional<Turned> turned_a_, turned_b_;
  std::vector<HalfSpace> hull_a_, hull_b_;
};

}  // namespace strake::geometry
