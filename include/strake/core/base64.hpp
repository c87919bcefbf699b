// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strake {

/// Bytes as text of RFC 4648, section 4, with padding.
void append_base64(std::string& out, std::span<const std::uint8_t> bytes);

/// The bytes of such a text; nothing where it is anything else.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> parse_base64(std::string_view text);

}  // namespace strake
