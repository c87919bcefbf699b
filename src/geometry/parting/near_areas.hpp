// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/pair_view.hpp"
#include "geometry/sided_sets.hpp"

namespace strake::geometry {

/// A triangle of one sheet that comes within a distance of the other.
struct NearTriangle {
  std::uint32_t triangle = 0;
  bool along = false;  ///< it lies along one of the other's, or one of them along it
  std::uint32_t area = 0;
  bool swapped = false;  ///< its outer side is the inner side of the first triangle of its area
};

/// The areas of one of two sheets that come within a distance of the other: near triangles, joined
/// over edges.
struct NearAreas {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::vector<NearTriangle> triangles;  ///< ascending
  std::vector<std::uint32_t> number;  ///< by triangle of the sheet: place in `triangles`, or kNone
  /// By area: has two sides. What closes to a Möbius strip has one.
  std::vector<bool> two_sided;

  /// Null where the triangle is not near.
  [[nodiscard]] const NearTriangle* find(std::uint32_t triangle) const {
    const std::uint32_t i = number[triangle];
    return i == kNone ? nullptr : &triangles[i];
  }
};

/// Those of b, or of a. None where the triangles that are near each other are too many to look at:
/// the work is bounded by a multiple of the number of triangles of the two.
[[nodiscard]] std::optional<NearAreas> near_areas(const PartView& a, const PartView& b, bool of_b,
                                                  double distance, PairWork& work);

}  // namespace strake::geometry
