// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/placed_labels.hpp"

#include <algorithm>
#include <cmath>

#include "sheets/annotation/occupancy_grid.hpp"

namespace strake::sheets {

namespace {

constexpr double kBinMm = 12;

std::size_t bins(double mm) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(mm / kBinMm)));
}

std::size_t bin(double mm, std::size_t count) {
  if (!(mm > 0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(mm / kBinMm, 1e9)), count - 1);
}

PaperBox box_round(const PaperSegment& line) {
  return {std::min(line.a.x, line.b.x), std::min(line.a.y, line.b.y), std::max(line.a.x, line.b.x),
          std::max(line.a.y, line.b.y)};
}

/// Returns whether a leader runs nearer to a text than the clearance.
bool runs_over(const LabelPlace& leader, const LabelPlace& text) {
  return leader.has_leader && clipped(leader.leader, widened(text.box, kClearanceMm)).has_value();
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

template <class Visit>
void PlacedLabels::each_bin(const PaperBox& box, Visit&& visit) const {
  const std::size_t right = bin(box.right, columns_), bottom = bin(box.bottom, rows_);
  for (std::size_t r = bin(box.top, rows_); r <= bottom; ++r)
    for (std::size_t c = bin(box.left, columns_); c <= right; ++c) visit(r * columns_ + c);
}

void PlacedLabels::add(Label label, const LabelPlace& place) {
  places_[label] = place;
  const auto put = [&](std::size_t b) { bins_[b].push_back(label); };
  each_bin(place.box, put);
  if (place.has_leader) each_bin(box_round(place.leader), put);
}

void PlacedLabels::remove(Label label) {
  const LabelPlace& place = places_[label];
  const auto take = [&](std::size_t b) { std::erase(bins_[b], label); };
  each_bin(place.box, take);
  if (place.has_leader) each_bin(box_round(place.leader), take);
}

void PlacedLabels::find_conflicts(const LabelPlace& place, std::size_t most, Conflicts& found) {
  found.blockers.clear();
  found.crossed.clear();
  ++query_;
  const auto meet = [&](std::size_t b) {
    for (const Label label : bins_[b]) {
      if (found.blockers.size() > most) return;
      if (last_query_[label] == query_) continue;
      last_query_[label] = query_;
      const LabelPlace& other = places_[label];
      if (block_each_other(place, other))
        found.blockers.push_back(label);
      else if (place.has_leader && other.has_leader && segments_cross(place.leader, other.leader))
        found.crossed.push_back(label);
    }
  };
  each_bin(widened(place.box, kClearanceMm), meet);
  if (place.has_leader) each_bin(widened(box_round(place.leader), kClearanceMm), meet);
  std::ranges::sort(found.blockers);
  std::ranges::sort(found.crossed);
}

}  // namespace strake::sheets
