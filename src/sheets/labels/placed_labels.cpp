// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/placed_labels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sheets/labels/paper/occupancy_grid.hpp"

namespace strake::sheets {

namespace {

constexpr double kBinMm = 12;
/// How near to a leader bins are its own: the clearance, and a little for rounding.
constexpr double kReachMm = kClearanceMm + 0.01;

std::size_t bins(double mm) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(mm / kBinMm)));
}

std::size_t bin(double mm, std::size_t count) {
  if (!(mm > 0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(mm / kBinMm, 1e9)), count - 1);
}

/// Returns whether a leader runs nearer to a text than the clearance.
bool runs_over(const LabelPlace& leader, const LabelPlace& text) {
  if (!leader.has_leader) return false;
  const auto& [a, b] = leader.leader;
  const PaperBox near = widened(text.box, kClearanceMm);
  // Most are far off.
  if (std::max(a.x, b.x) < near.left || std::min(a.x, b.x) > near.right ||
      std::max(a.y, b.y) < near.top || std::min(a.y, b.y) > near.bottom)
    return false;
  return clipped(leader.leader, near).has_value();
}

bool block_each_other(const LabelPlace& one, const LabelPlace& other) {
  return widened(one.box, kClearanceMm).overlaps(other.box) || runs_over(one, other) ||
         runs_over(other, one);
}

}  // namespace

PlacedLabels::PlacedLabels(double width_mm, double height_mm, std::size_t labels)
    : columns_(bins(width_mm)),
      rows_(bins(height_mm)),
      bins_(columns_ * rows_),
      places_(labels),
      last_query_(labels) {}

/// Calls visit(bin) for the bins of a box until it returns false; returns whether it never did.
template <class Visit>
bool PlacedLabels::each_bin(const PaperBox& box, Visit&& visit) const {
  const std::size_t right = bin(box.right, columns_), bottom = bin(box.bottom, rows_);
  for (std::size_t r = bin(box.top, rows_); r <= bottom; ++r)
    for (std::size_t c = bin(box.left, columns_); c <= right; ++c)
      if (!visit(r * columns_ + c)) return false;
  return true;
}

/// The same for the bins within the clearance of a line: of each row those beside the part of the
/// line that is so near to the row.
template <class Visit>
bool PlacedLabels::each_bin(const PaperSegment& line, Visit&& visit) const {
  const auto& [low, high] = std::minmax(line.a.y, line.b.y);
  const double slope = low < high ? (line.b.x - line.a.x) / (line.b.y - line.a.y) : 0;
  const auto x_at = [&](double y) { return line.a.x + (y - line.a.y) * slope; };
  const std::size_t last = bin(high + kReachMm, rows_);
  for (std::size_t r = bin(low - kReachMm, rows_); r <= last; ++r) {
    const double from = static_cast<double>(r) * kBinMm;
    const double top = r == 0 ? low : std::clamp(from - kReachMm, low, high);
    const double bottom = r + 1 == rows_ ? high : std::clamp(from + kBinMm + kReachMm, low, high);
    const auto [x1, x2] =
        low < high ? std::pair{x_at(top), x_at(bottom)} : std::pair{line.a.x, line.b.x};
    const PaperBox part{std::min(x1, x2) - kReachMm, from + kBinMm / 2, std::max(x1, x2) + kReachMm,
                        from + kBinMm / 2};
    if (!each_bin(part, visit)) return false;
  }
  return true;
}

template <class Visit>
bool PlacedLabels::each_bin(const LabelPlace& place, double rim_mm, Visit&& visit) const {
  return each_bin(widened(place.box, rim_mm), visit) &&
         (!place.has_leader || each_bin(place.leader, visit));
}

void PlacedLabels::add(Label label, LabelPlace& place) {
  if (place.number == 0) place.number = ++numbers_;
  places_[label] = place;
  each_bin(place, 0, [&](std::size_t b) {
    if (bins_[b].empty() || bins_[b].back() != label) bins_[b].push_back(label);
    return true;
  });
}

void PlacedLabels::remove(Label label) {
  each_bin(places_[label], 0, [&](std::size_t b) {
    std::erase(bins_[b], label);
    return true;
  });
  places_[label].number = 0;
}

void PlacedLabels::find_conflicts(const LabelPlace& place, const QueryLimit& limit,
                                  Conflicts& found) {
  found.blockers.clear();
  found.crossed.clear();
  found.visited = 0;
  ++query_;
  each_bin(place, kClearanceMm, [&](std::size_t b) {
    ++found.visited;
    for (const Label label : bins_[b]) {
      ++found.visited;
      if (last_query_[label] == query_) continue;
      last_query_[label] = query_;
      compare(place, label, found);
      if (found.blockers.size() > limit.blockers || found.crossed.size() > limit.crossed)
        return false;
    }
    return true;
  });
  std::ranges::sort(found.blockers);
  std::ranges::sort(found.crossed);
}

void PlacedLabels::compare(const LabelPlace& place, Label label, Conflicts& found) const {
  const LabelPlace& other = places_[label];
  if (block_each_other(place, other))
    found.blockers.push_back(label);
  else if (place.has_leader && other.has_leader && segments_cross(place.leader, other.leader))
    found.crossed.push_back(label);
}

}  // namespace strake::sheets
