// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "strake/core/result.hpp"

namespace strake::pictures {

/// Returns rows of red, green and blue bytes, from above, as a PNG of 8 bits a channel; `rgb` has
/// three bytes for each point. Errors: out of memory.
[[nodiscard]] Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                                             std::span<const std::uint8_t> rgb);

}  // namespace strake::pictures
