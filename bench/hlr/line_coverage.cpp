// SPDX-License-Identifier: Apache-2.0
#include "hlr/line_coverage.hpp"

#include <span>

#include "drawing/collinear/collinear_overlaps.hpp"

namespace strake::bench {
namespace {

using drawing::PlaneSegment;

constexpr double kApart_mm = 0.5;

struct Cut {
  double first = 0;  ///< length of the first set
  double rest = 0;   ///< of what the second has beside it
};

/// `lines` are the `count` of the first set and then those of the second.
Cut cut(std::vector<PlaneSegment> lines, std::size_t count, const parallel::Context& context) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].reach = kApart_mm / 2;
    lines[i].depth = 0;
    lines[i].rank = i < count ? drawing::OverlapRank::visible : drawing::OverlapRank::hidden;
  }
  const auto overlaps = drawing::cut_overlaps(lines, {.shortest = kApart_mm}, context).value();
  std::vector<double> open(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    open[i] = overlaps.fully_covered.is_set(i) ? 0 : lines[i].length();
  for (const drawing::LineInterval& s : overlaps.cut_intervals)
    if (s.covered) open[s.line] -= (s.to - s.from) * lines[s.line].length();
  Cut result;
  for (std::size_t i = 0; i < lines.size(); ++i)
    (i < count ? result.first : result.rest) += open[i];
  return result;
}

std::vector<PlaneSegment> joined(const std::vector<PlaneSegment>& a,
                                 const std::vector<PlaneSegment>& b) {
  std::vector<PlaneSegment> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

}  // namespace

Common compare(const std::vector<PlaneSegment>& ours, const std::vector<PlaneSegment>& theirs,
               const parallel::Context& context) {
  const Cut by_ours = cut(joined(ours, theirs), ours.size(), context);
  const Cut by_theirs = cut(joined(theirs, ours), theirs.size(), context);
  return {by_ours.first, by_theirs.first, by_theirs.rest, by_ours.rest};
}

}  // namespace strake::bench
