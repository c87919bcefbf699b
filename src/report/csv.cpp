// SPDX-License-Identifier: Apache-2.0
#include "report/csv.hpp"

#include "strake/core/text.hpp"

namespace strake::report {
namespace {

bool looks_like_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
}

}  // namespace

void append_csv(std::string& out, std::string_view raw) {
  std::string text = valid_utf8(raw);
  if (looks_like_formula(text)) text.insert(0, 1, '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace strake::report
