// SPDX-License-Identifier: Apache-2.0
#include "bcf/input/xml_tree.hpp"

#include <string_view>

#include "core/text_encoding.hpp"

namespace strake::bcf {

Status read_xml(pugi::xml_document& document, const std::string& text, const std::string& where) {
  const pugi::xml_parse_result read = document.load_buffer(text.data(), text.size());
  if (read) return {};
  if (read.status == pugi::status_out_of_memory) return out_of_memory();
  return Error{
      ErrorCode::input,
      "the XML is damaged at byte " + std::to_string(read.offset) + ": " + read.description(),
      where, "have it written again"};
}

bool is_called(const pugi::xml_node& node, const char* name) {
  const std::string_view full = node.name();
  const std::size_t colon = full.rfind(':');
  return (colon == std::string_view::npos ? full : full.substr(colon + 1)) == name;
}

pugi::xml_node child(const pugi::xml_node& node, const char* name) {
  for (const pugi::xml_node& some : node.children())
    if (is_called(some, name)) return some;
  return {};
}

std::string child_text(const pugi::xml_node& node, const char* name) {
  std::string text;
  for (const pugi::xml_node& piece : child(node, name).children())
    if (piece.type() == pugi::node_pcdata || piece.type() == pugi::node_cdata)
      text += piece.value();
  return valid_utf8(text);
}

std::string attribute_text(const pugi::xml_node& node, const char* name) {
  return valid_utf8(node.attribute(name).value());
}

}  // namespace strake::bcf
