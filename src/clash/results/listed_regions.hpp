// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Returns how many regions of a pair are listed, those that a rule allows too.
[[nodiscard]] std::uint32_t listed_regions(const Pair& pair, const Options& options);

/// Brings Report::regions into the order of the pairs, without those of pairs that are not there
/// any more.
void put_regions_in_order(Report& report);

}  // namespace strake::clash
