// SPDX-License-Identifier: Apache-2.0
#include "drawing/ink/line_grid.hpp"

namespace strake::drawing {

PlaneSegment part_of(const PlaneSegment& flat, double from, double to) {
  PlaneSegment part = flat;
  const double dx = flat.bx - flat.ax, dy = flat.by - flat.ay;
  if (from > 0) {
    part.ax = flat.ax + dx * from;
    part.ay = flat.ay + dy * from;
  }
  if (to < 1) {
    part.bx = flat.ax + dx * to;
    part.by = flat.ay + dy * to;
  }
  return part;
}

void append_kept(const PlaneSegment& flat, std::uint32_t number, std::span<ParamInterval> covers,
                 const LayingRule& rule, LineIntervals& out) {
  const std::size_t first = out.size();
  const double length = flat.length();
  append_intervals(out, number, covers, rule.overlap.shortest / length);
  if (length < rule.whole_below) {
    double share = 0;
    for (std::size_t i = first; i < out.size(); ++i)
      if (out[i].covered) share += out[i].to - out[i].from;
    out.resize(first);
    if (share * length <= length / 2 + rule.touch) out.push_back({number, false, 0, 1});
    return;
  }
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  out.erase(std::remove_if(begin, out.end(), [](const LineInterval& s) { return s.covered; }),
            out.end());
}

}  // namespace strake::drawing
