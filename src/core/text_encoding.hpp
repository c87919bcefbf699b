// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strake {

// Names come from files and may hold anything; these functions make them fit for where they are
// shown.

/// The replacement for bytes that are not UTF-8: U+FFFD.
inline constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: the bytes are not UTF-8
};

/// Returns the well-formed UTF-8 character at the front of a text that is not empty.
[[nodiscard]] Character first_character(std::string_view text);

/// A character with its bytes: a single byte where they are not UTF-8.
struct DecodedCharacter : Character {
  std::string_view bytes;
};

/// Takes the first character off a text that is not empty.
[[nodiscard]] DecodedCharacter decode_character(std::string_view& text);

/// Whether all of it is well-formed UTF-8: no overlong forms, no surrogates.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Appends the character; `code` is at most 0x10FFFF.
void append_utf8(std::string& out, std::uint32_t code);

/// Returns how many characters at the front stand for themselves in a JSON string: most of every
/// name.
[[nodiscard]] std::size_t plain_json_prefix(std::string_view text);

/// Whether a code point is a control character, line breaks included, or no character.
[[nodiscard]] bool is_control(std::uint32_t code);

/// Whether a character without a shape changes the direction of writing: a name that holds one is
/// shown in another order than it has.
[[nodiscard]] bool is_bidi_control(std::uint32_t code);

/// Whether a character may be shown to people: it is UTF-8, commands no terminal and does not
/// change the direction of writing.
[[nodiscard]] bool is_printable(const Character& c);

/// Returns the text with '?' for everything that is not printable.
[[nodiscard]] std::string printable(std::string_view text);

/// Returns the text without blanks at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

/// Returns the text with small letters for the capitals of ASCII.
[[nodiscard]] std::string lowered(std::string_view text);

/// Returns the text in single quotes, as messages show what somebody wrote.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Returns the text with U+FFFD for bytes that are not UTF-8, and otherwise as it is.
[[nodiscard]] std::string valid_utf8(std::string_view text);
/// Returns the same without a copy of what is valid, as nearly all is: of what is not a copy
/// lies in `room`, which must outlast the result.
[[nodiscard]] std::string_view valid_utf8(std::string_view text, std::string& room);

/// Appends a JSON string with its quotes; bytes that are no UTF-8 become U+FFFD.
void append_json_string(std::string& out, std::string_view text);

/// Appends bytes as text of RFC 4648, section 4, with padding.
void append_base64(std::string& out, std::span<const std::uint8_t> bytes);

/// Returns the bytes of such a text; nothing where it is anything else.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> parse_base64(std::string_view text);

}  // namespace strake
