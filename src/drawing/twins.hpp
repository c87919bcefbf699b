// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drawing/flat.hpp"
#include "drawing/overlaps.hpp"
#include "drawing/radix_order.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::drawing {

/// Takes out of `keys`, in which twins (lines with the same ends and reach) have equal keys and
/// stand together, each line that may go and has a twin that stays, and marks it in `gone`, by
/// line.
///
/// Most lines of a plan go here: what stands on the deck has its edges exactly above each other.
[[nodiscard]] Status drop_twins(std::vector<Keyed>& keys, std::span<const Flat> lines,
                                const OverlapRule& rule, parallel::Marks& gone,
                                const parallel::Context& context);

}  // namespace strake::drawing
