// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/xml_reader.hpp"

#include <algorithm>

#include "core/text_encoding.hpp"

namespace strake::sheets {

namespace {

constexpr std::size_t kDeepest = 200, kMaxAttributes = 1000;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Returns whether a character may be in a name as drawings have them: other letters of XML are not
/// expected.
bool in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.' || c == ':';
}

bool is_xml_character(std::uint32_t code) {
  return code == '\t' || code == '\n' || code == '\r' || (code >= 0x20 && code <= 0xD7FF) ||
         (code >= 0xE000 && code <= 0xFFFD) || (code >= 0x10000 && code <= 0x10FFFF);
}

/// Returns the character that "#65" or "#x41" stands for.
std::optional<std::uint32_t> character_of(std::string_view reference) {
  if (!reference.starts_with('#')) return std::nullopt;
  const bool hex = reference.starts_with("#x");
  reference.remove_prefix(hex ? 2 : 1);
  if (reference.empty() || reference.size() > 8) return std::nullopt;
  std::uint32_t code = 0;
  for (const char c : reference) {
    std::uint32_t digit = 16;
    if (c >= '0' && c <= '9') digit = static_cast<std::uint32_t>(c - '0');
    if (c >= 'a' && c <= 'f') digit = static_cast<std::uint32_t>(c - 'a') + 10;
    if (c >= 'A' && c <= 'F') digit = static_cast<std::uint32_t>(c - 'A') + 10;
    if (digit >= (hex ? 16U : 10U)) return std::nullopt;
    code = code * (hex ? 16 : 10) + digit;
    if (code > 0x10FFFF) return std::nullopt;
  }
  return is_xml_character(code) ? std::optional(code) : std::nullopt;
}

}  // namespace

XmlReader::XmlReader(std::string_view text) : rest_(text), utf8_(is_utf8(text)) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kMark)) rest_.remove_prefix(kMark.size());
}

Error XmlReader::fault(std::string message, std::string mend) const {
  return {ErrorCode::input, std::move(message), "line " + std::to_string(line_), std::move(mend)};
}

bool XmlReader::at(std::string_view what) const { return rest_.starts_with(what); }

void XmlReader::advance(std::size_t bytes) {
  const std::string_view passed = rest_.substr(0, bytes);
  line_ += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
  rest_.remove_prefix(passed.size());
}

bool XmlReader::skip_past(std::string_view end) {
  const std::size_t found = rest_.find(end);
  if (found == std::string_view::npos) return false;
  advance(found + end.size());
  return true;
}

void XmlReader::skip_blanks() {
  std::size_t blanks = 0;
  while (blanks < rest_.size() && is_blank(rest_[blanks])) ++blanks;
  advance(blanks);
}

Status XmlReader::skip_declaration() {
  if (!utf8_) return fault("the text is no UTF-8", "save it as UTF-8");
  if (at("<?xml ") && !skip_past("?>")) return fault("the XML declaration does not end");
  return {};
}

Status XmlReader::skip_comments() {
  while (at("<!--")) {
    advance(4);
    if (!skip_past("-->")) return fault("a comment does not end");
    if (open_.empty()) skip_blanks();
  }
  return {};
}

Result<XmlEvent> XmlReader::next() {
  if (!begun_) {
    if (const Status status = skip_declaration(); !status) return status.error();
  }
  if (close_) {
    close_ = false;
    XmlEvent event{XmlEvent::Kind::end, line_, open_.back(), {}, {}};
    open_.pop_back();
    return event;
  }
  if (open_.empty()) skip_blanks();
  if (const Status status = skip_comments(); !status) return status.error();
  if (rest_.empty()) {
    if (!open_.empty()) return fault("<" + open_.back() + "> is not closed");
    if (!begun_) return fault("there is no element");
    return XmlEvent{XmlEvent::Kind::finish, line_, {}, {}, {}};
  }
  if (at("<!DOCTYPE") || at("<!ENTITY"))
    return fault("a document type has no place in a drawing", "take the <!DOCTYPE ...> out");
  if (at("<?"))
    return fault("a processing instruction has no place in a drawing", "take the <? ... ?> out");
  if (at("</")) return end_tag();
  if (at("<") && !at("<![CDATA[")) return element();
  return characters();
}

Result<std::string> XmlReader::decoded(std::string_view raw) const {
  std::string text;
  while (!raw.empty()) {
    const std::size_t plain = std::min(raw.find('&'), raw.size());
    text += raw.substr(0, plain);
    raw.remove_prefix(plain);
    if (raw.empty()) break;
    const std::size_t end = raw.find(';');
    const std::string_view reference =
        end == std::string_view::npos ? std::string_view() : raw.substr(1, end - 1);
    if (reference == "amp")
      text += '&';
    else if (reference == "lt")
      text += '<';
    else if (reference == "gt")
      text += '>';
    else if (reference == "quot")
      text += '"';
    else if (reference == "apos")
      text += '\'';
    else if (const auto code = character_of(reference))
      append_utf8(text, *code);
    else
      return fault("'&" + std::string(reference.substr(0, 40)) + ";' stands for nothing",
                   "write the character itself, and &amp; for &");
    raw.remove_prefix(end + 1);
  }
  return text;
}

Result<std::string> XmlReader::name() {
  std::size_t length = 0;
  while (length < rest_.size() && in_name(rest_[length])) ++length;
  if (length == 0) return fault("a name is missing", "is it SVG, and whole?");
  std::string found(rest_.substr(0, length));
  advance(length);
  return found;
}

Result<XmlEvent> XmlReader::element() {
  if (begun_ && open_.empty()) return fault("something follows the end of the drawing");
  if (open_.size() == kDeepest) return fault("elements are nested too deeply");
  begun_ = true;
  XmlEvent event{XmlEvent::Kind::start, line_, {}, {}, {}};
  advance(1);
  Result<std::string> element_name = name();
  if (!element_name) return element_name.error();
  event.name = std::move(*element_name);
  for (;;) {
    skip_blanks();
    if (at(">") || at("/>")) break;
    Result<std::string> key = name();
    if (!key) return key.error();
    skip_blanks();
    const auto taken = [&](const auto& other) { return other.first == *key; };
    if (std::any_of(event.attributes.begin(), event.attributes.end(), taken))
      return fault("'" + *key + "' is given twice");
    if (event.attributes.size() == kMaxAttributes)
      return fault("an element of too many attributes");
    if (!at("=")) return fault("'" + *key + "' has no value");
    advance(1);
    skip_blanks();
    if (!at("\"") && !at("'")) return fault("the value of '" + *key + "' is not in quotes");
    const std::size_t end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return fault("the value of '" + *key + "' does not end");
    const std::string_view raw = rest_.substr(1, end - 1);
    if (raw.find('<') != std::string_view::npos) return fault("'<' stands in a value");
    Result<std::string> value = decoded(raw);
    if (!value) return value.error();
    advance(end + 1);
    event.attributes.emplace_back(std::move(*key), std::move(*value));
  }
  close_ = at("/>");
  advance(close_ ? 2 : 1);
  open_.push_back(event.name);
  return event;
}

Result<XmlEvent> XmlReader::end_tag() {
  advance(2);
  XmlEvent event{XmlEvent::Kind::end, line_, {}, {}, {}};
  Result<std::string> closed = name();
  if (!closed) return closed.error();
  if (open_.empty() || open_.back() != *closed)
    return fault("</" + *closed + "> closes nothing", "is it SVG, and whole?");
  skip_blanks();
  if (!at(">")) return fault("</" + *closed + "> does not end");
  advance(1);
  event.name = std::move(*closed);
  open_.pop_back();
  return event;
}

Result<XmlEvent> XmlReader::characters() {
  if (open_.empty()) return fault("text outside of the drawing", "is it SVG?");
  XmlEvent event{XmlEvent::Kind::text, line_, {}, {}, {}};
  if (at("<![CDATA[")) {
    advance(9);
    const std::size_t end = rest_.find("]]>");
    if (end == std::string_view::npos) return fault("a CDATA section does not end");
    event.text = rest_.substr(0, end);
    advance(end + 3);
    return event;
  }
  const std::string_view raw = rest_.substr(0, rest_.find('<'));
  Result<std::string> text = decoded(raw);
  if (!text) return text.error();
  advance(raw.size());
  event.text = std::move(*text);
  return event;
}

}  // namespace strake::sheets
