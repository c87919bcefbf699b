// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/text_encoding.hpp"

namespace strake {

/// Which characters XML has as they are; for all others, and for bytes that are not UTF-8, it has
/// U+FFFD.
enum class XmlCharacters : std::uint8_t {
  printable,  ///< what may be shown on a line (is_printable())
  lines,      ///< tabs and line ends, too
  all,        ///< all that XML 1.0 can hold: what programs compare
};

/// Appends a character as text or value of XML: what is markup as a reference, and a carriage
/// return, which readers would take for a line end.
void append_xml(std::string& out, const DecodedCharacter& c, XmlCharacters kept);
/// Appends a text, character by character.
void append_xml(std::string& out, std::string_view text, XmlCharacters kept);

}  // namespace strake
