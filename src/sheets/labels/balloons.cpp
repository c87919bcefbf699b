// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/balloons.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max();

/// Returns the views of the balloons as indices, in the order in which they are requested.
std::vector<std::size_t> views_of(const BalloonSpec& spec, const Sheet& sheet) {
  std::vector<std::size_t> views;
  if (spec.views.empty())
    for (std::size_t v = 0; v < sheet.views.size(); ++v) views.push_back(v);
  for (const std::string& name : spec.views) {
    const auto view = std::ranges::find(sheet.views, name, &PlacedView::name);
    if (view != sheet.views.end())
      views.push_back(static_cast<std::size_t>(view - sheet.views.begin()));
  }
  return views;
}

/// Returns the height at which the widest of the numbers fits its circle, no larger than is usual.
double letters_in(double diameter_mm, std::size_t rows) {
  constexpr double kUsual = 0.4375, kRimMm = 0.5;
  double widest = 0;
  for (std::size_t row = 1; row <= rows; ++row)
    widest = std::max(widest, text_width(std::to_string(row)));
  const double largest = (diameter_mm - 2 * kRimMm) / std::sqrt(widest * widest + 1);
  return drawing::rounded_paper(std::min(kUsual * diameter_mm, largest));
}

}  // namespace

BalloonList balloons_of(const PartsListSpec& spec,
                        std::span<const std::vector<model::ObjectId>> listed, std::size_t objects,
                        const Sheet& sheet) {
  BalloonList list{&spec, letters_in(spec.balloons->diameter_mm, listed.size()), {}, {}, {}};
  std::vector<std::uint32_t> row_of(objects, kNoRow);
  std::vector<bool> picked(objects);
  for (std::size_t row = 0; row < listed.size(); ++row)
    for (const model::ObjectId object : listed[row]) {
      row_of[model::index(object)] = static_cast<std::uint32_t>(row);
      picked[model::index(object)] = true;
    }
  std::vector<std::optional<Balloon>> of_row(listed.size());
  for (const std::size_t view : views_of(*spec.balloons, sheet))
    for (const VisibleObject& visible : visible_objects(sheet.views[view].ink, picked)) {
      const std::uint32_t row = row_of[model::index(visible.object)];
      std::optional<Balloon>& best = of_row[row];
      if (!best || (best->view == view && visible.length > best->visible.length))
        best = Balloon{std::to_string(row + 1), visible, view};
    }
  for (std::size_t row = 0; row < of_row.size(); ++row)
    if (of_row[row])
      list.all.push_back(std::move(*of_row[row]));
    else
      list.unseen.push_back(std::to_string(row + 1));
  return list;
}

PaperBox paper_beside(const PaperBox& lines, BalloonSpec::Side side, const Sheet& sheet) {
  PaperBox box{0, 0, sheet.width_mm, sheet.height_mm};
  if (side == BalloonSpec::Side::left) box.right = lines.left;
  if (side == BalloonSpec::Side::right) box.left = lines.right;
  if (side == BalloonSpec::Side::top) box.bottom = lines.top;
  if (side == BalloonSpec::Side::bottom) box.top = lines.bottom;
  return box;
}

}  // namespace strake::sheets
