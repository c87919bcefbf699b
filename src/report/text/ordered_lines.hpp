// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "report/text/formatting.hpp"

namespace strake::report {

/// Writes the texts of n items in their order: line(i, out) appends that of item i. The bytes are
/// the same for any team. Errors: those of drawing::write_in_batches().
template <class Line>
[[nodiscard]] Status write_lines(const parallel::Context& context, std::size_t n,
                                 BufferedWriter& buffer, Line&& line) {
  return drawing::write_in_batches(
      "clash results", n,
      [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t i = begin; i < end; ++i) line(i, out);
      },
      [&](std::string_view text) { buffer << text; }, context);
}

}  // namespace strake::report
