// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "core/number.hpp"
#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kGapMm = 2, kTriangleMm = 3, kLevelLettersMm = 2.5;

bool is_elevation(const hlr::View& view) {
  return !view.perspective && view.direction.z == 0 && view.up.x == 0 && view.up.y == 0 &&
         view.up.z > 0;
}

/// Returns how wide the line and the text of a level are.
double width_of(const LevelSpec& level) {
  return 2 * kTriangleMm + text_width(level_text(level)) * kLevelLettersMm;
}

}  // namespace

std::string level_text(const LevelSpec& level) {
  const std::string metres = fixed(std::fabs(level.at_mm) / 1000, 3);
  const std::string_view sign = metres == "0.000" ? "\xC2\xB1" : level.at_mm < 0 ? "-" : "+";
  return (level.label.empty() ? "" : level.label + " ") + std::string(sign) + metres;
}

double level_margin(const LevelsSpec& levels, const ViewSpec& view) {
  const bool named =
      levels.views.empty() || std::ranges::find(levels.views, view.name) != levels.views.end();
  if (levels.all.empty() || !named || !is_elevation(view.view)) return 0;
  double widest = 0;
  for (const LevelSpec& level : levels.all) widest = std::max(widest, width_of(level));
  return kGapMm + widest;
}

std::vector<bool> mark_levels(const LevelsSpec& levels, const ViewSpec& view,
                              const drawing::Placement& placement, const PaperBox& box,
                              double right_mm, Marks& marks) {
  std::vector<bool> within(levels.all.size());
  if (level_margin(levels, view) == 0) return within;
  std::vector<std::size_t> upwards(levels.all.size());
  for (std::size_t i = 0; i < upwards.size(); ++i) upwards[i] = i;
  std::ranges::sort(upwards, {}, [&](std::size_t i) { return std::pair(levels.all[i].at_mm, i); });
  double lowest = std::numeric_limits<double>::max();
  for (const std::size_t i : upwards) {
    const LevelSpec& level = levels.all[i];
    const auto at = geometry::snap(level.at_mm);
    if (!at) continue;
    const auto steps = static_cast<double>(*at - placement.anchor.z);
    const double y =
        rounded_paper(placement.at.y - steps / geometry::kGridPerMm / placement.sheet.scale);
    if (y < box.top - 0.01 || y > box.bottom + 0.01) continue;
    within[i] = true;
    if (y > lowest - kTriangleMm - kLevelLettersMm) continue;
    lowest = y;
    const double left = rounded_paper(right_mm + kGapMm),
                 right = rounded_paper(left + width_of(level));
    const double tip = rounded_paper(left + kTriangleMm);
    const double half = rounded_paper(kTriangleMm / 2);
    marks.paths.push_back({LineClass::note, {{left, y}, {right, y}}, false});
    marks.paths.push_back({LineClass::note,
                           {{tip, y},
                            {tip - half, rounded_paper(y - kTriangleMm)},
                            {tip + half, rounded_paper(y - kTriangleMm)},
                            {tip, y}},
                           false});
    marks.texts.push_back({LineClass::note,
                           {rounded_paper(left + 2 * kTriangleMm), rounded_paper(y - 0.8)},
                           kLevelLettersMm,
                           Align::start,
                           on_one_line(level_text(level)),
                           false});
  }
  return within;
}

}  // namespace strake::sheets
