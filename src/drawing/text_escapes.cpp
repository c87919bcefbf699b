// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/text_encoding.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

std::string xml_escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const TakenCharacter c = take_character(text);
    if (!is_printable(c))
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
    else
      out += c.bytes;
  }
  return out;
}

std::string json_quoted(std::string_view text) {
  std::string out;
  append_json_string(out, text);
  return out;
}

}  // namespace strake::drawing
