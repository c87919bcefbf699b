// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake {

/// Whether the pattern matches the whole text. '*' stands for any text, also across '/'; '?' for
/// one character (a UTF-8 sequence); "[a-c]" for one of a set of ASCII characters, "[!a-c]" for
/// one outside it; '\' takes the next character as it is. A '[' without its ']' is an ordinary
/// character. Upper and lower case differ. Time: at most |pattern| · |text|.
[[nodiscard]] bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace strake
