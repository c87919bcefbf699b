// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/text/xml_text.hpp"
#include "core/text_encoding.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

std::string xml_escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  append_xml(out, text, XmlCharacters::printable);
  return out;
}

std::string json_quoted(std::string_view text) {
  std::string out;
  append_json_string(out, text);
  return out;
}

}  // namespace strake::drawing
