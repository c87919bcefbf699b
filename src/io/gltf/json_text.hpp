// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace strake::io::gltf {

/// Appends text as a JSON string with its quotes; bytes that are no UTF-8 become U+FFFD.
void append_json_string(std::string& out, std::string_view text);

/// Length of the UTF-8 character at the start of a non-empty text, 0 if none is there.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

}  // namespace strake::io::gltf
