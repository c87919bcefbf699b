// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/natural_order.hpp"

#include <algorithm>
#include <cstddef>

namespace strake::sheets {

namespace {

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes the digits off the front of a text.
std::string_view take_digits(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_decimal_digit);
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  int by_zeros = 0;
  while (!a.empty() && !b.empty()) {
    if (is_decimal_digit(a.front()) && is_decimal_digit(b.front())) {
      const std::string_view of_a = take_digits(a), of_b = take_digits(b);
      const std::string_view x = without_zeros(of_a), y = without_zeros(of_b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      if (by_zeros == 0 && of_a.size() != of_b.size())
        by_zeros = of_a.size() < of_b.size() ? -1 : 1;
    } else {
      if (a.front() != b.front())
        return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front());
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return by_zeros < 0;
}

}  // namespace strake::sheets
