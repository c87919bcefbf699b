// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

/// Returns the report of which encode_head() made these bytes, without pairs and regions. Errors:
/// input for bytes that are no report over so many objects; `what` is what errors call it.
[[nodiscard]] Result<clash::Report> decode_head(std::span<const std::byte> bytes,
                                                std::size_t objects, const std::string& what);

}  // namespace strake::project
