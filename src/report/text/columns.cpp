// SPDX-License-Identifier: Apache-2.0
#include "report/text/columns.hpp"

#include <algorithm>
#include <array>

#include "core/text_encoding.hpp"

namespace strake::report {
namespace {

/// The first and the last of some code points.
struct CodeRange {
  std::uint32_t first, last;
};

/// Scripts of East Asia with their punctuation, full-width forms, and pictographs.
constexpr std::array kWide{
    CodeRange{0x1100, 0x115F},   CodeRange{0x2E80, 0x303E},   CodeRange{0x3041, 0x33FF},
    CodeRange{0x3400, 0x4DBF},   CodeRange{0x4E00, 0xA4CF},   CodeRange{0xA960, 0xA97F},
    CodeRange{0xAC00, 0xD7A3},   CodeRange{0xF900, 0xFAFF},   CodeRange{0xFE10, 0xFE19},
    CodeRange{0xFE30, 0xFE6F},   CodeRange{0xFF01, 0xFF60},   CodeRange{0xFFE0, 0xFFE6},
    CodeRange{0x1B000, 0x1B2FF}, CodeRange{0x1F300, 0x1F64F}, CodeRange{0x1F900, 0x1F9FF},
    CodeRange{0x20000, 0x3FFFD}};

/// Combining marks, joiners and selectors of variants; some are among the wide ones.
constexpr std::array kWithoutColumn{
    CodeRange{0x302A, 0x302D}, CodeRange{0x3099, 0x309A}, CodeRange{0x0300, 0x036F},
    CodeRange{0x1AB0, 0x1AFF}, CodeRange{0x1DC0, 0x1DFF}, CodeRange{0x200B, 0x200D},
    CodeRange{0x20D0, 0x20FF}, CodeRange{0xFE00, 0xFE0F}, CodeRange{0xFE20, 0xFE2F}};

template <class Ranges>
bool is_in(const Ranges& ranges, std::uint32_t code) {
  return std::ranges::any_of(ranges,
                             [&](const CodeRange& r) { return r.first <= code && code <= r.last; });
}

}  // namespace

std::size_t columns_of(std::uint32_t code) {
  constexpr std::uint32_t kFirstOfAny = 0x0300;
  if (code < kFirstOfAny) return 1;
  if (is_in(kWithoutColumn, code)) return 0;
  return is_in(kWide, code) ? 2 : 1;
}

std::size_t columns_in(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) {
    columns += columns_of(decode_character(text).code);
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
