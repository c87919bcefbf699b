// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "clash/parts.hpp"
#include "clash/reduce.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::clash {

/// What the answers about parts are told of.
struct PartAnswers {
  const PartList& list;
  const std::vector<geometry::IndexPair>& candidates;
  const std::vector<Found>& found;            ///< by candidate
  std::span<const geometry::PartTree> trees;  ///< by unique part; empty where none was wanted yet
};

/// Pair::volume_mm3 of every HIT of the report: the common volumes of its pairs of solid parts
/// whose interiors meet, added up in their order.
[[nodiscard]] Status measure_volumes(const PartAnswers& answers, const parallel::Context& context,
                                     Report& report);

}  // namespace strake::clash
