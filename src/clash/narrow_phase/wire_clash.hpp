// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/pairs/pair_result.hpp"

namespace strake::clash {

/// Whether one of the two is a wire: lines, which have no triangles to be tested by.
[[nodiscard]] bool has_wire(const geometry::Part& a, const geometry::Part& b);

/// Returns the whole result for such a pair: docs/clash.md, "Lines". Both parts need trees. A swap
/// of the two mirrors the result.
[[nodiscard]] PartPairResult evaluate_wire(const PairOperand& a, const PairOperand& b,
                                           const PairTolerances& options, NarrowWork& work);

}  // namespace strake::clash
