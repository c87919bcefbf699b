// SPDX-License-Identifier: Apache-2.0
#include "report/json/json_reader.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

#include "core/text_encoding.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18U;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool in_number(char c) {
  return is_digit(c) || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

bool in_word(char c) { return c >= 'a' && c <= 'z'; }

/// Moves `at` over digits; returns false where there is none.
bool pass_digits(const char*& at, const char* end) {
  const char* const first = at;
  while (at != end && is_digit(*at)) ++at;
  return at != first;
}

bool is_number(std::string_view text) {
  const char *at = text.data(), *const end = at + text.size();
  if (at != end && *at == '-') ++at;
  const char* const first = at;
  if (!pass_digits(at, end) || (*first == '0' && at - first > 1)) return false;
  if (at != end && *at == '.' && !pass_digits(++at, end)) return false;
  if (at == end || (*at != 'e' && *at != 'E')) return at == end;
  ++at;
  if (at != end && (*at == '+' || *at == '-')) ++at;
  return pass_digits(at, end) && at == end;
}

}  // namespace

JsonReader::JsonReader(std::istream& in, int max_depth)
    : in_(in), buffer_(kBufferBytes), max_depth_(max_depth) {
  at_ = end_ = buffer_.data();
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (refill() &&
      std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(kByteOrderMark))
    at_ += kByteOrderMark.size();
}

std::uint64_t JsonReader::lines_up_to(const char* at) const {
  const char* const first = buffer_.data();
  return static_cast<std::uint64_t>(std::count(first, at, '\n'));
}

bool JsonReader::refill() {
  lines_before_ += lines_up_to(end_);
  in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  at_ = buffer_.data();
  end_ = at_ + in_.gcount();
  return at_ != end_;
}

int JsonReader::peek() {
  if (at_ == end_ && !refill()) return kEnd;
  return static_cast<unsigned char>(*at_);
}

int JsonReader::peek_behind_blanks() {
  while (true) {
    const int c = peek();
    if (c != ' ' && c != '\n' && c != '\t' && c != '\r') return c;
    ++at_;
  }
}

void JsonReader::fail(Fault::What what) const {
  throw Fault{what, lines_before_ + lines_up_to(at_) + 1};
}

void JsonReader::fail_at_next() { fail(peek() == kEnd ? Fault::What::cut : Fault::What::broken); }

void JsonReader::expect(char c) {
  if (peek_behind_blanks() != c) fail_at_next();
  ++at_;
}

JsonReader::Kind JsonReader::kind() {
  const int c = peek_behind_blanks();
  if (c == '{') return Kind::object;
  if (c == '[') return Kind::array;
  if (c == '"') return Kind::string;
  if (c == 't' || c == 'f') return Kind::boolean;
  if (c == 'n') return Kind::null;
  if (c != '-' && (c < '0' || c > '9')) fail_at_next();
  return Kind::number;
}

bool JsonReader::open(char bracket, char closing) {
  expect(bracket);
  if (++depth_ > max_depth_) fail(Fault::What::deep);
  if (peek_behind_blanks() != closing) return true;
  ++at_;
  --depth_;
  return false;
}

bool JsonReader::next(char closing) {
  const int c = peek_behind_blanks();
  if (c != ',' && c != closing) fail_at_next();
  ++at_;
  if (c == ',') return true;
  --depth_;
  return false;
}

void JsonReader::read_key() {
  key_ = text();
  expect(':');
}

std::string_view JsonReader::text() {
  expect('"');
  spilled_.clear();
  bool spilled = false, ascii = true;
  const char* first = at_;
  const auto spill = [&] {
    spilled = true;
    spilled_.append(first, at_);
  };
  while (true) {
    at_ += plain_json_prefix({at_, static_cast<std::size_t>(end_ - at_)});
    if (at_ == end_) {
      spill();
      if (!refill()) fail(Fault::What::cut);
      first = at_;
    } else if (*at_ == '"') {
      break;
    } else if (*at_ == '\\') {
      spill();
      read_escape();
      first = at_;
    } else if (static_cast<unsigned char>(*at_) < 0x20) {
      fail(Fault::What::broken);
    } else {
      ascii = ascii && static_cast<unsigned char>(*at_) < 0x80;
      ++at_;
    }
  }
  if (spilled) spill();
  const std::string_view found =
      spilled ? std::string_view(spilled_)
              : std::string_view(first, static_cast<std::size_t>(at_ - first));
  if (!ascii && !is_utf8(found)) fail(Fault::What::broken);
  ++at_;
  return found;
}

void JsonReader::read_escape() {
  constexpr std::string_view kNames = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
  ++at_;
  const int c = peek();
  if (c == 'u') {
    ++at_;
    std::uint32_t code = read_hex();
    if (code >= 0xDC00 && code < 0xE000) fail(Fault::What::broken);
    if (code >= 0xD800 && code < 0xDC00) {
      for (const char expected : {'\\', 'u'}) {
        if (peek() != expected) fail_at_next();
        ++at_;
      }
      const std::uint32_t low = read_hex();
      if (low < 0xDC00 || low >= 0xE000) fail(Fault::What::broken);
      code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
    }
    append_utf8(spilled_, code);
    return;
  }
  const std::size_t name = c == kEnd ? std::string_view::npos : kNames.find(static_cast<char>(c));
  if (name == std::string_view::npos) fail_at_next();
  spilled_ += kMeant[name];
  ++at_;
}

std::uint32_t JsonReader::read_hex() {
  std::uint32_t code = 0;
  for (int i = 0; i < 4; ++i) {
    const int c = peek();
    const int lower = c | 0x20;
    const int digit = c >= '0' && c <= '9'           ? c - '0'
                      : lower >= 'a' && lower <= 'f' ? lower - 'a' + 10
                                                     : -1;
    if (c == kEnd || digit < 0) fail_at_next();
    code = code * 16 + static_cast<std::uint32_t>(digit);
    ++at_;
  }
  return code;
}

std::string_view JsonReader::read_number() {
  if (kind() != Kind::number) fail(Fault::What::broken);
  const char* first = at_;
  while (at_ != end_ && in_number(*at_)) ++at_;
  std::string_view found(first, static_cast<std::size_t>(at_ - first));
  if (at_ == end_) {
    spilled_ = found;
    while (peek() != kEnd && in_number(*at_)) spilled_ += *at_++;
    found = spilled_;
  }
  if (!is_number(found)) fail_at_next();
  return found;
}

double JsonReader::number() {
  const std::string_view found = read_number();
  double value = 0;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return value;
}

std::string_view JsonReader::read_word() {
  constexpr std::size_t kLongest = 5;
  spilled_.clear();
  while (peek() != kEnd && in_word(*at_) && spilled_.size() < kLongest) spilled_ += *at_++;
  if (spilled_ != "true" && spilled_ != "false" && spilled_ != "null") fail_at_next();
  return spilled_;
}

void JsonReader::skip() {
  switch (kind()) {
    case Kind::object:
      return members([this](std::string_view) { skip(); });
    case Kind::array:
      return items([this] { skip(); });
    case Kind::string:
      (void)text();
      return;
    case Kind::number:
      (void)read_number();
      return;
    case Kind::boolean:
    case Kind::null:
      (void)read_word();
  }
}

void JsonReader::copy(std::string& out) {
  const char* between = "";
  switch (kind()) {
    case Kind::object:
      out += '{';
      members([&](std::string_view key) {
        out += between;
        between = ",";
        append_json_string(out, key);
        out += ':';
        copy(out);
      });
      out += '}';
      return;
    case Kind::array:
      out += '[';
      items([&] {
        out += between;
        between = ",";
        copy(out);
      });
      out += ']';
      return;
    case Kind::string:
      append_json_string(out, text());
      return;
    case Kind::number:
      out += read_number();
      return;
    case Kind::boolean:
    case Kind::null:
      out += read_word();
  }
}

void JsonReader::end() {
  if (peek_behind_blanks() != kEnd) fail(Fault::What::broken);
}

}  // namespace strake::report
