// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "report/text/formatting.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::report {

/// Writes the texts of n items in their order: line(i, out) appends that of item i. The team makes
/// as many at a time as fit some tens of megabytes, so memory does not grow with n, and the bytes
/// are the same for any team. Errors: cancelled, and lack of memory.
template <class Line>
[[nodiscard]] Status write_lines(const parallel::Context& context, std::size_t n,
                                 BufferedWriter& buffer, Line&& line) {
  constexpr std::size_t kPerPiece = 64, kPerBatch = kPerPiece * 1024;
  for (std::size_t first = 0; first < n; first += kPerBatch) {
    const std::size_t last = std::min(n, first + kPerBatch);
    const parallel::Region lines{.n = last - first, .grain = kPerPiece};
    const auto texts = parallel::transform(
        context, {.name = "format results", .n = lines.blocks()}, [&](std::size_t piece) {
          std::string text;
          const std::size_t begin = first + piece * kPerPiece;
          for (std::size_t i = begin; i < std::min(last, begin + kPerPiece); ++i) line(i, text);
          return text;
        });
    if (!texts) return texts.error();
    for (const std::string& text : *texts) {
      buffer.text() += text;
      buffer.done();
    }
  }
  return {};
}

}  // namespace strake::report
