// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::tiles {

/// What the cut knows of an object.
struct Extent {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();  ///< of what it places; may be empty
  std::uint32_t bytes = 0;  ///< about what it takes of a worker's memory
};

/// A cell, and the objects whose boxes reach into it, ascending.
struct CutCell {
  clash::Cell cell;
  std::vector<std::uint32_t> objects;
  std::uint64_t bytes = 0;
};

/// Cuts space into cells, halves of halves across their longest side, until what reaches into one
/// takes no more than `max_bytes`. A cell that halves make no smaller, since everything in it lies
/// at one place, stays as it is. There is one at least. The cells depend on the extents alone.
[[nodiscard]] std::vector<CutCell> cut_space(std::span<const Extent> extents,
                                             std::uint64_t max_bytes);

}  // namespace strake::tiles
