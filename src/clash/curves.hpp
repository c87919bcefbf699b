// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// Whether one of the two is a wire: lines, which have no triangles to be judged by.
[[nodiscard]] bool has_wire(const geometry::Part& a, const geometry::Part& b);

/// The whole answer for such a pair: docs/clash.md, "Lines". Trees are wanted. A swap of the two
/// mirrors it.
[[nodiscard]] PartAnswer judge_wire(const NarrowPart& a, const NarrowPart& b,
                                    const NarrowOptions& options, NarrowWork& work);

}  // namespace strake::clash
