// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Returns a hexadecimal hash of the pairs by durable ids: classes, relations, d, witnesses, and
/// the rules that allow them. Errors: cancelled.
[[nodiscard]] Result<std::string> hash_of(const Report& report, const model::Model& model,
                                          const parallel::Context& context);

}  // namespace strake::clash
