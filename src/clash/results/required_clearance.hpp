// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Returns the clearance that a pair of the report has to keep, mm, where its objects add to it;
/// nothing where it is the one of the settings.
[[nodiscard]] std::optional<double> required_clearance_mm(const Report& report, const Pair& pair);

}  // namespace strake::clash
