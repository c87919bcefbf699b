// SPDX-License-Identifier: Apache-2.0
#include "drawing/collinear/collinear_overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "drawing/collinear/line_index.hpp"
#include "drawing/collinear/radix_sort.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

/// A covered interval of a line; each line has one for every line on it.
struct Cover {
  std::uint32_t line = 0;
  ParamInterval interval{};
};

/// Finds the covered intervals, leaf by leaf of the index.
///
/// For the lines of a leaf, covering lines are sought in their own class of lengths and in lower
/// ones; lines of lower classes that they cover are found on the same pass, so that a short line
/// need not search for long ones, which are everywhere.
class OverlapSearch {
 public:
  /// `fully_covered`, by line: marks the lines that one other covers as a whole.
  OverlapSearch(const OverlapRule& rule, const LineIndex& index, parallel::Marks& fully_covered)
      : rule_(rule), index_(index), fully_covered_(fully_covered) {}

  /// Returns the covered intervals of lines that are covered in part.
  [[nodiscard]] Result<std::vector<Cover>> run(const parallel::Context& context) {
    return parallel::collect_with<Cover>(
        context, {.name = "overlapping lines", .n = index_.leaves(), .grain = 64},
        [] { return Lists{}; },
        [&](Lists& lists, std::size_t number, std::vector<Cover>& out) {
          visit(index_.leaf(number), lists, out);
        });
  }

 private:
  /// The covers of one line of a leaf.
  struct CoverList {
    std::uint32_t position = 0;
    bool can_be_covered = false;
    std::vector<ParamInterval> covers;
    std::size_t many = 0;  ///< the number from which on uniting them pays
  };
  using Lists = std::array<CoverList, LineIndex::kFan>;
  static constexpr std::size_t kMany = 64;

  /// Whether one other line covers a line as a whole: then nothing else matters. When a worker sees
  /// the mark changes the work, not the result.
  [[nodiscard]] bool is_fully_covered(std::uint32_t position) {
    return fully_covered_.is_set(index_.line(position));
  }
  void set_fully_covered(std::uint32_t position) { fully_covered_.set(index_.line(position)); }

  [[nodiscard]] bool stays_over(std::uint32_t position, std::uint32_t other) const {
    return has_precedence(index_.flat(position), index_.line(position), index_.flat(other),
                          index_.line(other));
  }

  void visit(const LineIndex::Leaf& leaf, Lists& lists, std::vector<Cover>& out) {
    bool any = false;
    for (std::uint32_t k = leaf.first; k < leaf.last; ++k) {
      CoverList& list = lists[k - leaf.first];
      list.position = k;
      list.can_be_covered = can_be_covered(index_.flat(k), rule_) && !is_fully_covered(k);
      list.covers.clear();
      list.many = kMany;
      any = any || list.can_be_covered;
    }
    const unsigned own = index_.sector(leaf.sector).length_class;
    for (unsigned c = 0; c <= own; ++c) {
      if (c == own && !any) continue;
      index_.candidates(leaf, c, [&](std::size_t i, std::uint32_t other) {
        CoverList& list = lists[i];
        if (other != list.position) {
          if (stays_over(other, list.position))
            cover(list, other);
          else if (c < own)
            cover_shorter(other, list.position, out);
        }
        return c < own || list.can_be_covered;
      });
    }
    for (std::uint32_t k = 0; k < leaf.last - leaf.first; ++k) {
      CoverList& list = lists[k];
      if (!list.can_be_covered) continue;
      unite(list.covers);
      for (const ParamInterval& interval : list.covers)
        out.push_back({index_.line(list.position), interval});
    }
  }

  void cover(CoverList& list, std::uint32_t other) {
    if (!list.can_be_covered || !can_cover(index_.flat(other), rule_)) return;
    const auto interval = covered(index_.flat(list.position), index_.flat(other), rule_);
    if (!interval) return;
    if (is_all(*interval)) {
      set_fully_covered(list.position);
      list.can_be_covered = false;
      return;
    }
    list.covers.push_back(*interval);
    if (list.covers.size() < list.many) return;
    unite(list.covers);
    list.many = std::max(kMany, 2 * list.covers.size());
  }

  void cover_shorter(std::uint32_t position, std::uint32_t other, std::vector<Cover>& out) {
    if (!can_be_covered(index_.flat(position), rule_) || is_fully_covered(position)) return;
    if (!can_cover(index_.flat(other), rule_)) return;
    const auto interval = covered(index_.flat(position), index_.flat(other), rule_);
    if (!interval) return;
    if (is_all(*interval))
      set_fully_covered(position);
    else
      out.push_back({index_.line(position), *interval});
  }

  [[nodiscard]] static bool is_all(const ParamInterval& interval) {
    return interval.from <= 0 && interval.to >= 1;
  }

  const OverlapRule& rule_;
  const LineIndex& index_;
  parallel::Marks& fully_covered_;
};

/// Returns the covers by line, as keys with their numbers.
Result<std::vector<KeyedItem>> by_line(std::span<const Cover> covers,
                                       const parallel::Context& context) {
  constexpr std::size_t kCoversPerRun = 16384;
  auto keys = parallel::transform(
      context, {.name = "keys of covers", .n = covers.size(), .grain = kCoversPerRun},
      [&](std::size_t i) { return KeyedItem{covers[i].line, static_cast<std::uint32_t>(i)}; });
  if (!keys) return keys;
  const Status status = radix_sort(*keys, context);
  if (!status) return status.error();
  return keys;
}

}  // namespace

void unite(std::vector<ParamInterval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const ParamInterval& a, const ParamInterval& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  std::size_t kept = 0;
  for (const ParamInterval& next : intervals)
    if (kept > 0 && next.from <= intervals[kept - 1].to)
      intervals[kept - 1].to = std::max(intervals[kept - 1].to, next.to);
    else
      intervals[kept++] = next;
  intervals.resize(kept);
}

std::optional<ParamInterval> covered(const PlaneSegment& line, const PlaneSegment& other,
                                     const OverlapRule& rule) {
  const double distance = line.reach + other.reach;
  const double length = line.length(), other_length = other.length();
  if (length > rule.least && line.ends() == other.ends()) return ParamInterval{0, 1};
  const double dx = (line.bx - line.ax) / length, dy = (line.by - line.ay) / length;
  double d0 = (other.ay - line.ay) * dx - (other.ax - line.ax) * dy;
  double d1 = (other.by - line.ay) * dx - (other.bx - line.ax) * dy;
  if (std::min(d0, d1) > distance || std::max(d0, d1) < -distance) return std::nullopt;
  const double sine = std::fabs(d1 - d0) / other_length;
  if (sine > rule.greatest_sine || sine * std::min(length, other_length) > 2 * distance)
    return std::nullopt;
  double s0 = (other.ax - line.ax) * dx + (other.ay - line.ay) * dy;
  double s1 = (other.bx - line.ax) * dx + (other.by - line.ay) * dy;
  if (s0 > s1) {
    std::swap(s0, s1);
    std::swap(d0, d1);
  }
  const double from = std::max(0.0, s0), to = std::min(length, s1);
  if (to - from <= rule.least) return std::nullopt;
  // The other line's distance at both ends of the common interval.
  const double slope = (d1 - d0) / (s1 - s0);
  if (std::fabs(d0 + slope * (from - s0)) > distance ||
      std::fabs(d0 + slope * (to - s0)) > distance)
    return std::nullopt;
  return ParamInterval{from / length, to / length};
}

bool has_precedence(const PlaneSegment& a, std::uint32_t i, const PlaneSegment& b,
                    std::uint32_t j) {
  return std::tuple(a.rank, -a.depth, i) < std::tuple(b.rank, -b.depth, j);
}
bool has_precedence(std::span<const PlaneSegment> lines, std::uint32_t i, std::uint32_t j) {
  return has_precedence(lines[i], i, lines[j], j);
}

bool can_be_covered(const PlaneSegment& line, const OverlapRule& rule) {
  return line.rank == OverlapRank::hidden ||
         (line.rank == OverlapRank::visible && rule.covers_visible);
}

bool can_cover(const PlaneSegment& line, const OverlapRule& rule) {
  return line.rank == OverlapRank::visible ||
         (line.rank == OverlapRank::hidden && rule.hidden_covers);
}

void append_intervals(LineIntervals& out, std::uint32_t line, std::span<ParamInterval> covers,
                      double shortest) {
  std::sort(covers.begin(), covers.end(), [](const ParamInterval& a, const ParamInterval& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  double done = 0;
  for (std::size_t i = 0; i < covers.size();) {
    double from = covers[i].from, to = covers[i].to;
    for (++i; i < covers.size() && covers[i].from <= to + shortest; ++i)
      to = std::max(to, covers[i].to);
    const double least = std::min(shortest, to - from);
    if (from - done <= least) from = done;
    if (1 - to <= least) to = 1;
    if (from > done) out.push_back({line, false, done, from});
    out.push_back({line, true, from, to});
    done = to;
  }
  if (done < 1) out.push_back({line, false, done, 1});
}

Result<LineOverlaps> cut_overlaps(std::span<const PlaneSegment> lines, const OverlapRule& rule,
                                  const parallel::Context& context) {
  LineOverlaps found;
  found.fully_covered = parallel::Marks(lines.size());
  const Result<std::vector<Cover>> covers = [&]() -> Result<std::vector<Cover>> {
    const Result<LineIndex> index = LineIndex::build(lines, rule, found.fully_covered, context);
    if (!index) return index.error();
    return OverlapSearch(rule, *index, found.fully_covered).run(context);
  }();
  if (!covers) return covers.error();
  const Result<std::vector<KeyedItem>> order = by_line(*covers, context);
  if (!order) return order.error();
  const std::span<const KeyedItem> keys = *order;
  auto cut_intervals = parallel::collect_with<LineInterval>(
      context, {.name = "cut lines", .n = keys.size(), .grain = 4096},
      [] { return std::vector<ParamInterval>{}; },
      [&](std::vector<ParamInterval>& of_line, std::size_t i, LineIntervals& out) {
        const auto line = static_cast<std::uint32_t>(keys[i].key);
        if ((i > 0 && keys[i - 1].key == keys[i].key) || found.fully_covered.is_set(line)) return;
        of_line.clear();
        for (std::size_t k = i; k < keys.size() && keys[k].key == keys[i].key; ++k)
          of_line.push_back((*covers)[keys[k].item].interval);
        append_intervals(out, line, of_line, rule.shortest / lines[line].length());
      });
  if (!cut_intervals) return cut_intervals.error();
  found.cut_intervals = std::move(*cut_intervals);
  return found;
}

}  // namespace strake::drawing
