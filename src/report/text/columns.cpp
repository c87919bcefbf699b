// SPDX-License-Identifier: Apache-2.0
#include "report/text/columns.hpp"

#include "core/text_encoding.hpp"

namespace strake::report {

std::size_t columns_in(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) {
    (void)take_character(text);
    ++columns;
  }
  return columns;
}

std::string left_aligned(std::string text, std::size_t columns) {
  const std::size_t taken = columns_in(text);
  if (taken < columns) text.append(columns - taken, ' ');
  return text;
}

std::string right_aligned(std::string text, std::size_t columns) {
  const std::size_t taken = columns_in(text);
  if (taken < columns) text.insert(0, columns - taken, ' ');
  return text;
}

std::string ended(std::string line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line + "\n";
}

}  // namespace strake::report
