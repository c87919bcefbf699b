// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"

namespace strake::test {

/// Lines that lie on each other in every way that there is, seeded.
enum class LineSet : std::uint8_t {
  any,       ///< of all lengths and directions
  lattice,   ///< between the points of a small lattice: equal, within each other, staggered
  parallel,  ///< about one direction and one axis, by angles and distances about the limits
  chains,    ///< long ones, cut into short ones, cut again
};
inline constexpr unsigned kLineSets = 4;

struct LineSetOptions {
  LineSet set = LineSet::any;
  std::uint32_t count = 200;
  double reach = 0.002;
  double offset = 0;  ///< of the whole, from the origin
};

[[nodiscard]] std::vector<drawing::PlaneSegment> make_lines(std::uint64_t seed,
                                                            const LineSetOptions& options);

/// Every line against every other: the definition of cut_overlaps.
[[nodiscard]] drawing::LineIntervals cut_by_all_pairs(std::span<const drawing::PlaneSegment> lines,
                                                      const drawing::OverlapRule& rule);

}  // namespace strake::test
