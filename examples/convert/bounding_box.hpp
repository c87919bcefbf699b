// SPDX-License-Identifier: Apache-2.0
// The smallest box round many parts, and which part reaches its six sides.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "model.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace convert {

/// Empty until it holds a point; an empty one adds nothing to another.
struct Box {
  std::array<std::int32_t, 3> lo{kMax, kMax, kMax}, hi{-kMax, -kMax, -kMax};

  [[nodiscard]] bool is_empty() const { return lo[0] > hi[0]; }
  void add(const Point& p);
  void add(const Box& other);

 private:
  static constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
};

inline constexpr std::uint32_t kNoPart = 0xffffffffU;

struct Extent {
  Box box;
  /// The parts that reach lo x, y, z, hi x, y, z; of several the first that was added.
  std::array<std::uint32_t, 6> reached_by{kNoPart, kNoPart, kNoPart, kNoPart, kNoPart, kNoPart};

  void add(const Box& other, std::uint32_t part);
  void add(const Extent& other);

 private:
  void widen(std::size_t axis, std::int32_t lo, std::uint32_t lo_part, std::int32_t hi,
             std::uint32_t hi_part);
};

namespace before {
/// A part's box. The first call for a part works it out; forget_boxes() when the model changes.
const Box& box_of(const Model& model, std::uint32_t part);
void forget_boxes();
Extent extent_of(const Model& model, std::span<const std::uint32_t> selected);
}  // namespace before

namespace after {
/// By part.
strake::Result<std::vector<Box>> boxes_of(const Model& model,
                                          const strake::parallel::Context& context);
strake::Result<Extent> extent_of(const std::vector<Box>& boxes,
                                 std::span<const std::uint32_t> selected,
                                 const strake::parallel::Context& context);
}  // namespace after

}  // namespace convert
