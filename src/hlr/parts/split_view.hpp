// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A part of a view: objects whose lines it finds, and what may hide or cross these.
struct ViewPart {
  std::vector<std::uint32_t> objects;  ///< both, ascending
  std::vector<bool> to_solve;          ///< by place in `objects`: its lines are found here
  std::uint64_t bytes = 0;             ///< about what a worker takes for it
};

/// What is known of all that is drawn; by object, with an empty box where nothing is drawn.
struct ViewToSplit {
  const View& view;
  const Options& options;
  const geometry::Box3l& drawn;            ///< the box of all of it
  std::span<const geometry::Box3l> boxes;  ///< as object_extents() has them
  std::span<const std::uint32_t> bytes;    ///< about what each takes of a worker's memory
};

/// Splits the objects of a view into parts that take no more than `max_bytes`, as far as halves of
/// halves of the paper can be smaller: each object with a box is requested in one part, and there
/// is one part at least. Errors: cancelled.
[[nodiscard]] Result<std::vector<ViewPart>> split_view(const ViewToSplit& whole,
                                                       std::uint64_t max_bytes,
                                                       const parallel::Context& context);

}  // namespace strake::hlr
