// SPDX-License-Identifier: Apache-2.0
#include "drawing/ink/hidden_ink.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace strake::drawing {

void choose_hidden_lines(std::vector<HiddenLine>& lines, const LayingRule& rule,
                         const std::stop_token& stop, LineIntervals& out) {
  if (lines.empty()) return;
  std::ranges::sort(lines, {},
                    [](const HiddenLine& line) { return std::pair(-line.order, line.number); });
  double reach = 0;
  std::vector<PlaneSegment> flats;
  flats.reserve(lines.size());
  for (const HiddenLine& line : lines) {
    reach = std::max(reach, line.flat.reach);
    flats.push_back(line.flat);
  }
  // Cells are so wide that a query, which is widened by the reach, visits few of them.
  const LineGrid cells(flats, 16 * reach);
  LaidLines laid(cells, rule.overlap);
  const std::size_t begin = out.size();
  constexpr std::size_t kUnasked = 1024;  // lines between two checks whether to stop
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (i % kUnasked == 0 && stop.stop_requested()) return;
    HiddenLine& line = lines[i];
    laid.find(line.flat, i, line.covers);
    const std::size_t first = out.size();
    append_kept(line.flat, line.number, line.covers, rule, out);
    for (std::size_t k = first; k < out.size(); ++k)
      laid.add(part_of(line.flat, out[k].from, out[k].to));
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(),
            [](const LineInterval& a, const LineInterval& b) {
              return std::tie(a.line, a.from) < std::tie(b.line, b.from);
            });
}

}  // namespace strake::drawing
