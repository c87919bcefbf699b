// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "settings/document.hpp"

namespace strake::settings {

/// Where a TOML text has a dotted key of more than `most` parts, as a.b.c has three. Each part is a
/// table within a table, and the parser, which limits the nesting of values, takes a key of any
/// depth and ends with the stack. Of a text that is no TOML this looks at the part before the first
/// fault at least, which is as far as the parser gets.
[[nodiscard]] std::optional<Place> first_deep_key(std::string_view text, std::size_t most);

}  // namespace strake::settings
