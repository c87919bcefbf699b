// SPDX-License-Identifier: Apache-2.0
#include "report/text.hpp"

#include <cmath>
#include <vector>

#include "strake/core/number.hpp"
#include "strake/core/text.hpp"

namespace strake::report {
namespace {

constexpr double kPerMm = 1e6;
}  // namespace

void append_range(std::string& out, const clash::Pair& pair, std::string_view between) {
  append_mm_down(out, pair.d_lower_mm);
  out += between;
  append_mm_up(out, pair.d_upper_mm);
}

void append_point(std::string& out, const geometry::Vec3d& mm, std::string_view between) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += between;
    append_mm(out, mm[k]);
  }
}

void append_flags(std::string& out, const clash::Pair& pair, std::string_view between,
                  std::string_view quote) {
  bool first = true;
  for (const std::string_view flag : clash::flag_names(pair.flags)) {
    if (!first) out += between;
    first = false;
    out += quote;
    out += flag;
    out += quote;
  }
}

void append_json(std::string& out, std::string_view text) { append_json_string(out, text); }

void append_mm(std::string& out, double mm) {
  const std::size_t start = out.size();
  append_fixed(out, mm, 6);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  if (out.compare(start, std::string::npos, "-0") == 0) out.replace(start, 2, "0");
}

void append_mm_down(std::string& out, double mm) {
  append_mm(out, std::floor(mm * kPerMm) / kPerMm);
}

void append_mm_up(std::string& out, double mm) { append_mm(out, std::ceil(mm * kPerMm) / kPerMm); }

std::string fitted(std::string_view text, std::size_t columns) {
  std::vector<std::string_view> characters;
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t length = c.length == 0 ? 1 : c.length;
    const bool shown = c.length != 0 && !is_control(c.code) && !turns_writing(c.code);
    characters.push_back(shown ? text.substr(0, length) : std::string_view("?"));
    text.remove_prefix(length);
  }
  std::string out;
  if (characters.size() <= columns) {
    for (const std::string_view c : characters) out += c;
    out.append(columns - characters.size(), ' ');
    return out;
  }
  if (columns == 0) return out;
  // The tail of a name tells more than its head, so it gets the larger half.
  const std::size_t head = (columns - 1) / 2, tail = columns - 1 - head;
  for (std::size_t i = 0; i < head; ++i) out += characters[i];
  out += "…";
  for (std::size_t i = characters.size() - tail; i < characters.size(); ++i) out += characters[i];
  return out;
}

}  // namespace strake::report
