// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/gltf/json_text.hpp"
#include "io/text_number.hpp"

namespace strake::io::gltf {

/// Builds the index: a loop over the text with an explicit stack of what is open.
class JsonIndexer {
 public:
  explicit JsonIndexer(std::string_view text) : text_(text) {
    document_.text_ = text;
    // Dense documents have a value every five or six bytes.
    document_.entries_.reserve(text.size() / 8);
  }
  Result<JsonDocument> run();

 private:
  using Entry = JsonDocument::Entry;
  enum class Expect { value, value_or_end, key, key_or_end, comma_or_end };

  bool step();
  bool value(char c);
  bool key(char c);
  bool open(JsonType type);
  bool close(char c);
  bool string();
  bool escape();
  bool number();
  bool literal(std::string_view word, JsonType type);
  void after_value() { expect_ = Expect::comma_or_end; }
  bool fail(const char* message) {
    message_ = message;
    return false;
  }
  void push(JsonType type, std::size_t begin, std::size_t end) {
    const auto next = static_cast<std::uint32_t>(document_.entries_.size() + 1);
    document_.entries_.push_back(
        {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), next, type});
  }
  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  [[nodiscard]] bool in_object() const {
    return document_.entries_[stack_.back()].type == JsonType::object;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Expect expect_ = Expect::value;
  std::vector<std::uint32_t> stack_;  ///< entries of the open arrays and objects
  JsonDocument document_;
  const char* message_ = nullptr;
};

namespace {

constexpr bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
constexpr bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// Bytes that end the plain part of a string: the quote, the backslash, and control characters.
constexpr std::array<bool, 256> kStringStops = [] {
  std::array<bool, 256> stops{};
  for (std::size_t c = 0; c < 0x20; ++c) stops[c] = true;
  stops[static_cast<unsigned char>('"')] = stops[static_cast<unsigned char>('\\')] = true;
  return stops;
}();

}  // namespace

bool JsonIndexer::escape() {
  const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
  if (c == 'u') {
    for (std::size_t k = 2; k < 6; ++k) {
      const char digit = at_ + k < text_.size() ? text_[at_ + k] : '\0';
      const bool hex =
          is_digit(digit) || (digit >= 'a' && digit <= 'f') || (digit >= 'A' && digit <= 'F');
      if (!hex) return fail("a \\u needs four hexadecimal digits");
    }
    at_ += 6;
    return true;
  }
  if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos)
    return fail("this escape does not exist");
  at_ += 2;
  return true;
}

bool JsonIndexer::string() {
  const std::size_t begin = ++at_;
  while (true) {
    while (at_ < text_.size() && !kStringStops[static_cast<unsigned char>(text_[at_])]) ++at_;
    if (at_ == text_.size()) return fail("a string does not end");
    if (text_[at_] == '"') break;
    if (text_[at_] != '\\') return fail("a control character stands in a string");
    if (!escape()) return false;
  }
  push(JsonType::string, begin, at_++);
  return true;
}

bool JsonIndexer::number() {
  const std::size_t begin = at_;
  if (here() == '-') ++at_;
  const std::size_t whole = at_;
  while (is_digit(here())) ++at_;
  if (at_ == whole) return fail("a value is expected here");
  if (text_[whole] == '0' && at_ - whole > 1) return fail("a number may not begin with 0");
  if (here() == '.') {
    const std::size_t fraction = ++at_;
    while (is_digit(here())) ++at_;
    if (at_ == fraction) return fail("digits are expected behind the point");
  }
  if (here() == 'e' || here() == 'E') {
    ++at_;
    if (here() == '-' || here() == '+') ++at_;
    const std::size_t exponent = at_;
    while (is_digit(here())) ++at_;
    if (at_ == exponent) return fail("digits are expected in the exponent");
  }
  push(JsonType::number, begin, at_);
  return true;
}

bool JsonIndexer::literal(std::string_view word, JsonType type) {
  if (text_.substr(at_, word.size()) != word) return fail("a value is expected here");
  push(type, at_, at_ + word.size());
  at_ += word.size();
  return true;
}

bool JsonIndexer::open(JsonType type) {
  if (stack_.size() == JsonDocument::kMaxDepth) return fail("values are nested too deep");
  stack_.push_back(static_cast<std::uint32_t>(document_.entries_.size()));
  push(type, at_++, 0);
  expect_ = type == JsonType::object ? Expect::key_or_end : Expect::value_or_end;
  return true;
}

bool JsonIndexer::close(char c) {
  if (stack_.empty() || (c == '}') != in_object()) return fail("this closes nothing that is open");
  Entry& opened = document_.entries_[stack_.back()];
  opened.end = static_cast<std::uint32_t>(++at_);
  opened.next = static_cast<std::uint32_t>(document_.entries_.size());
  stack_.pop_back();
  after_value();
  return true;
}

bool JsonIndexer::value(char c) {
  if (c == '{') return open(JsonType::object);
  if (c == '[') return open(JsonType::array);
  if (c == ']' && expect_ == Expect::value_or_end) return close(c);
  const bool good = c == '"'   ? string()
                    : c == 't' ? literal("true", JsonType::boolean)
                    : c == 'f' ? literal("false", JsonType::boolean)
                    : c == 'n' ? literal("null", JsonType::null)
                               : number();
  after_value();
  return good;
}

bool JsonIndexer::key(char c) {
  if (c == '}' && expect_ == Expect::key_or_end) return close(c);
  if (c != '"') return fail("a key in quotes is expected here");
  if (!string()) return false;
  while (is_space(here())) ++at_;
  if (here() != ':') return fail("a colon is expected behind the key");
  ++at_;
  expect_ = Expect::value;
  return true;
}

bool JsonIndexer::step() {
  const char c = text_[at_];
  switch (expect_) {
    case Expect::value:
    case Expect::value_or_end:
      return value(c);
    case Expect::key:
    case Expect::key_or_end:
      return key(c);
    case Expect::comma_or_end:
      break;
  }
  if (stack_.empty()) return fail("something follows behind the document");
  if (c == '}' || c == ']') return close(c);
  if (c != ',') return fail("a comma or the end of the list is expected here");
  ++at_;
  expect_ = in_object() ? Expect::key : Expect::value;
  return true;
}

Result<JsonDocument> JsonIndexer::run() {
  const auto error = [this](const char* message) {
    return Error{ErrorCode::input, fmt::format("is not valid JSON: {}", message),
                 fmt::format("byte {}", at_), "copy or export the file again"};
  };
  if (text_.size() >= std::numeric_limits<std::uint32_t>::max())
    return error("more than 4 GiB of text");
  while (true) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ == text_.size()) break;
    if (!step()) return error(message_);
  }
  if (!stack_.empty() || expect_ != Expect::comma_or_end) return error("the text ends too early");
  return std::move(document_);
}

Result<JsonDocument> JsonDocument::parse(std::string_view text) { return JsonIndexer(text).run(); }

Json JsonDocument::root() const { return {this, 0, static_cast<std::uint32_t>(entries_.size())}; }

JsonType Json::type() const { return exists() ? entry().type : JsonType::absent; }

Json Json::first_child() const {
  if (!is_object() && !is_array()) return {};
  const std::uint32_t next = entry().next;
  return entry_ + 1 == next ? Json{} : Json{document_, entry_ + 1, next};
}

Json Json::after() const {
  const std::uint32_t next = entry().next;
  return next == end_ ? Json{} : Json{document_, next, end_};
}

Json Json::operator[](std::string_view key) const {
  if (!is_object()) return {};
  for (Json name = first_child(); name.exists();) {
    const Json value = name.after();
    const std::string_view raw = name.raw();
    const bool same =
        raw == key || (raw.find('\\') != std::string_view::npos && name.text_value() == key);
    if (same) return value;
    name = value.after();
  }
  return {};
}

std::vector<Json> Json::items() const {
  std::vector<Json> items;
  if (is_array())
    elements([&](const Json& item) { items.push_back(item); });
  else if (is_object())
    for (Json key = first_child(); key.exists(); key = items.back().after())
      items.push_back(key.after());
  return items;
}

std::string_view Json::raw() const {
  if (!exists()) return {};
  return document_->text_.substr(entry().begin, entry().end - entry().begin);
}

std::optional<double> Json::number() const {
  if (type() != JsonType::number) return std::nullopt;
  const std::string_view text = raw();
  const char* at = text.data();
  double value = 0;
  DigitStatistics unused;
  if (!read_number(at, at + text.size(), value, unused)) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> Json::index() const {
  constexpr double kMost = 9007199254740992.0;  // 2^53
  const std::optional<double> value = number();
  if (!value || !(*value >= 0 && *value <= kMost) || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

std::optional<bool> Json::boolean() const {
  if (type() != JsonType::boolean) return std::nullopt;
  return raw() == "true";
}

bool Json::numbers(double* out, std::size_t count) const {
  std::size_t found = 0;
  bool good = is_array();
  elements([&](const Json& item) {
    const std::optional<double> value = item.number();
    if (value && found < count) out[found] = *value;
    good = good && value.has_value();
    ++found;
  });
  return good && found == count;
}

namespace {

/// ASCII that stands for itself.
constexpr bool is_plain(char c) { return static_cast<signed char>(c) >= 0 && c != '\\'; }

unsigned hex_value(std::string_view digits) {
  unsigned value = 0;
  for (const char c : digits.substr(0, 4))
    value = 16 * value + static_cast<unsigned>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
  return value;
}

void append_utf8(std::string& out, unsigned code) {
  const auto put = [&](unsigned byte) { out.push_back(static_cast<char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0U | code >> 6U);
    put(0x80U | (code & 0x3FU));
  } else if (code < 0x10000) {
    put(0xE0U | code >> 12U);
    put(0x80U | (code >> 6U & 0x3FU));
    put(0x80U | (code & 0x3FU));
  } else {
    put(0xF0U | code >> 18U);
    put(0x80U | (code >> 12U & 0x3FU));
    put(0x80U | (code >> 6U & 0x3FU));
    put(0x80U | (code & 0x3FU));
  }
}

/// Decodes the \u at the start of the text; a surrogate pair takes two. Returns the length taken.
std::size_t decode_unicode(std::string_view text, std::string& out) {
  const unsigned code = hex_value(text.substr(2));
  const bool high = code >= 0xD800 && code < 0xDC00;
  if (high && text.size() >= 12 && text[6] == '\\' && text[7] == 'u') {
    const unsigned low = hex_value(text.substr(8));
    if (low >= 0xDC00 && low < 0xE000) {
      append_utf8(out, 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00));
      return 12;
    }
  }
  append_utf8(out, code >= 0xD800 && code < 0xE000 ? 0xFFFD : code);
  return 6;
}

}  // namespace

std::string Json::text_value() const {
  std::string out;
  if (!is_string()) return out;
  std::string_view text = raw();
  out.reserve(text.size());
  while (true) {
    std::size_t plain = 0;
    while (plain < text.size() && is_plain(text[plain])) ++plain;
    out.append(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) return out;
    std::size_t length = utf8_length(text);
    if (length == 0) {
      append_utf8(out, 0xFFFD);
      length = 1;
    } else if (text.front() != '\\') {
      out.append(text.substr(0, length));
    } else if (text[1] == 'u') {
      length = decode_unicode(text, out);
    } else {
      constexpr std::string_view kNames = "bfnrt", kValues = "\b\f\n\r\t";
      const std::size_t known = kNames.find(text[1]);
      out.push_back(known == std::string_view::npos ? text[1] : kValues[known]);
      length = 2;
    }
    text.remove_prefix(length);
  }
}

}  // namespace strake::io::gltf
