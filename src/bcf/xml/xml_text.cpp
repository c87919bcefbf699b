// SPDX-License-Identifier: Apache-2.0
#include "bcf/xml/xml_text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

/// Whether XML 1.0 can hold a character.
bool is_xml(std::uint32_t code) {
  if (code == '\t' || code == '\n' || code == '\r') return true;
  return (code >= 0x20 && code <= 0xD7FF) || (code >= 0xE000 && code <= 0xFFFD) || code >= 0x10000;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

void append_xml(std::string& out, std::string_view text) {
  while (!text.empty()) {
    const TakenCharacter c = take_character(text);
    if (c.length == 0 || !is_xml(c.code))
      out += kReplacement;
    else if (c.code == '&')
      out += "&amp;";
    else if (c.code == '<')
      out += "&lt;";
    else if (c.code == '>')
      out += "&gt;";
    else if (c.code == '"')
      out += "&quot;";
    else if (c.code == '\r')
      out += "&#13;";
    else
      out += c.bytes;
  }
}

std::string printable_lines(std::string_view text) {
  std::string lines;
  for (;;) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::string plain(line);
    std::ranges::replace(plain, '\t', ' ');
    lines += printable(plain);
    if (end == std::string_view::npos) return lines;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string compared_text(std::string_view text) {
  std::string compared;
  bool gap = false;
  for (const char c : printable_lines(text)) {
    if (is_blank(c)) {
      gap = true;
      continue;
    }
    if (gap && !compared.empty()) compared += ' ';
    gap = false;
    compared += c;
  }
  return compared;
}

std::string short_name(std::string_view name, std::size_t most) {
  std::string shown = printable(name);
  std::vector<std::string_view> characters;
  for (std::string_view rest = shown; !rest.empty();)
    characters.push_back(take_character(rest).bytes);
  if (characters.size() <= most) return shown;
  const std::size_t front = (most - 1) / 2, back = most - 1 - front;
  std::string cut;
  for (std::size_t i = 0; i < front; ++i) cut += characters[i];
  cut += "\xE2\x80\xA6";
  for (std::size_t i = characters.size() - back; i < characters.size(); ++i) cut += characters[i];
  return cut;
}

XmlWriter::XmlWriter(std::string_view root) : out_(R"(<?xml version="1.0" encoding="UTF-8"?>)") {
  begin(root);
}

XmlWriter& XmlWriter::begin(std::string_view name) {
  close_tag();
  new_line();
  out_ += '<';
  out_ += name;
  open_.push_back(name);
  in_tag_ = true;
  return *this;
}

XmlWriter& XmlWriter::attribute(std::string_view name, std::string_view value) {
  out_ += ' ';
  out_ += name;
  out_ += "=\"";
  append_xml(out_, value);
  out_ += '"';
  return *this;
}

XmlWriter& XmlWriter::end() {
  const std::string_view name = open_.back();
  open_.pop_back();
  if (in_tag_) {
    out_ += "/>";
    in_tag_ = false;
    return *this;
  }
  new_line();
  out_ += "</";
  out_ += name;
  out_ += '>';
  return *this;
}

XmlWriter& XmlWriter::leaf(std::string_view name, std::string_view text) {
  begin(name);
  out_ += '>';
  in_tag_ = false;
  append_xml(out_, text);
  open_.pop_back();
  out_ += "</";
  out_ += name;
  out_ += '>';
  return *this;
}

XmlWriter& XmlWriter::leaf_if(std::string_view name, std::string_view text) {
  return trimmed(text, " \t\r\n").empty() ? *this : leaf(name, text);
}

XmlWriter& XmlWriter::vector(std::string_view name, const geometry::Vec3d& v, double divisor) {
  begin(name);
  leaf("X", shortest(v.x / divisor)).leaf("Y", shortest(v.y / divisor));
  return leaf("Z", shortest(v.z / divisor)).end();
}

std::string XmlWriter::finish() {
  while (!open_.empty()) end();
  out_ += '\n';
  return std::move(out_);
}

void XmlWriter::close_tag() {
  if (in_tag_) out_ += '>';
  in_tag_ = false;
}

void XmlWriter::new_line() {
  out_ += '\n';
  out_.append(2 * open_.size(), ' ');
}

}  // namespace strake::bcf
