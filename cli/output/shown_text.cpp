// SPDX-License-Identifier: Apache-2.0
#include "cli/output/shown_text.hpp"

#include <cstddef>
#include <utility>

#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"

namespace strake::cli {

std::string shown_line(std::string_view line) {
  constexpr std::size_t kLongestBytes = 2000;
  if (line.size() <= kLongestBytes) return printable(line);
  std::string cut;
  for (std::string_view rest = line; cut.size() < kLongestBytes;)
    cut += decode_character(rest).bytes;
  return printable(cut) + "…";
}

std::string shown_cell(std::string_view text) {
  constexpr std::size_t kMaxColumns = 200;
  std::string all = printable(text);
  return report::columns_in(all) > kMaxColumns ? report::fit_to_columns(all, kMaxColumns)
                                               : std::move(all);
}

}  // namespace strake::cli
