// SPDX-License-Identifier: Apache-2.0
#include "bcf/xml/xml_text.hpp"

#include <algorithm>
#include <cstddef>

#include "core/number.hpp"
#include "core/text/xml_text.hpp"
#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

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

std::string short_name(std::string_view name, std::size_t limit) {
  std::string shown = printable(name);
  std::vector<std::string_view> characters;
  for (std::string_view rest = shown; !rest.empty();)
    characters.push_back(decode_character(rest).bytes);
  if (characters.size() <= limit) return shown;
  const std::size_t front = (limit - 1) / 2, back = limit - 1 - front;
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
  append_xml(out_, value, XmlCharacters::all);
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
  append_xml(out_, text, XmlCharacters::all);
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
