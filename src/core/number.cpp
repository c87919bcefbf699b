// SPDX-License-Identifier: Apache-2.0
#include "core/number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace strake {

namespace {

// The largest double has 309 digits before the point.
using Buffer = std::array<char, 350>;

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

void append_shortest(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "nan";  // to_chars may add a sign
    return;
  }
  Buffer buffer;
  // Adding zero turns a negative zero into a positive one and nothing else.
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0).ptr;
  out.append(buffer.data(), end);
}

std::string shortest(double value) {
  std::string out;
  append_shortest(out, value);
  return out;
}

void append_fixed(std::string& out, double value, int decimals) {
  if (!std::isfinite(value)) {
    append_shortest(out, value);
    return;
  }
  Buffer buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, std::clamp(decimals, 0, 17))
                       .ptr;
  std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string_view::npos)
    text.remove_prefix(1);
  out += text;
}

std::string fixed(double value, int decimals) {
  std::string out;
  append_fixed(out, value, decimals);
  return out;
}

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<long long> parse_integer(std::string_view text) {
  text = without_plus(text);
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace strake
