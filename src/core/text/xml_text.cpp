// SPDX-License-Identifier: Apache-2.0
#include "core/text/xml_text.hpp"

namespace strake {
namespace {

/// Whether XML 1.0 can hold a character.
bool is_xml(std::uint32_t code) {
  if (code == '\t' || code == '\n' || code == '\r') return true;
  return (code >= 0x20 && code <= 0xD7FF) || (code >= 0xE000 && code <= 0xFFFD) || code >= 0x10000;
}

bool is_kept(const DecodedCharacter& c, XmlCharacters kept) {
  if (c.length == 0 || !is_xml(c.code)) return false;
  if (kept == XmlCharacters::all || is_printable(c)) return true;
  return kept == XmlCharacters::lines && c.code < 0x20;
}

}  // namespace

void append_xml(std::string& out, const DecodedCharacter& c, XmlCharacters kept) {
  if (!is_kept(c, kept))
    out += kReplacement;
  else if (c.code == '&')
    out += "&amp;";
  else if (c.code == '<')
    out += "&lt;";
  else if (c.code == '>')
    out += "&gt;";
  else if (c.code == '"')
    out += "&quot;";
  else if (c.code == '\'')
    out += "&#39;";
  else if (c.code == '\r')
    out += "&#13;";
  else
    out += c.bytes;
}

void append_xml(std::string& out, std::string_view text, XmlCharacters kept) {
  while (!text.empty()) append_xml(out, decode_character(text), kept);
}

}  // namespace strake
