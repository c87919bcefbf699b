// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/neighbours.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace strake::sheets {

namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// A view with limits and the number of its sheet.
struct LimitedView {
  const ViewSpec* view = nullptr;
  std::size_t sheet = 0;
};

bool same_way(const Vec3l& a, const Vec3l& b) { return cross(a, b) == Vec3l{} && dot(a, b) > 0; }

/// Returns what two boxes have in common beside the plane in which they meet across an axis; none:
/// they do not meet there.
std::optional<Box3l> common_side(const Box3l& own, const Box3l& other, int axis, bool upper) {
  const auto plane = upper ? own.hi[axis] : own.lo[axis];
  if ((upper ? other.lo[axis] : other.hi[axis]) != plane) return std::nullopt;
  Box3l side;
  for (int k = 0; k < 3; ++k) {
    side.lo[k] = k == axis ? plane : std::max(own.lo[k], other.lo[k]);
    side.hi[k] = k == axis ? plane : std::min(own.hi[k], other.hi[k]);
    if (k != axis && side.lo[k] >= side.hi[k]) return std::nullopt;
  }
  return side;
}

bool overlap(const Box3l& a, const Box3l& b) {
  int common = 0;
  for (int k = 0; k < 3; ++k) {
    const auto lo = std::max(a.lo[k], b.lo[k]), hi = std::min(a.hi[k], b.hi[k]);
    if (lo > hi) return false;
    if (lo < hi) ++common;
  }
  return common == 2;
}

/// Adds the neighbours of a view on one side of its limits.
void add_neighbours(ViewSpec& view, std::size_t sheet, int axis, bool upper,
                    std::span<const LimitedView> others) {
  for (const bool own_sheet : {true, false})
    for (const LimitedView& other : others) {
      if ((other.sheet == sheet) != own_sheet || other.view == &view ||
          !same_way(other.view->view.direction, view.view.direction) ||
          !same_way(other.view->view.up, view.view.up))
        continue;
      const auto side = common_side(*view.view.limits, *other.view->view.limits, axis, upper);
      if (!side || std::ranges::any_of(view.neighbours, [&](const NeighbourView& known) {
            return overlap(known.side, *side);
          }))
        continue;
      const std::string& title = other.view->title;
      view.neighbours.push_back(
          {static_cast<std::uint8_t>(axis), upper, *side, title.empty() ? other.view->name : title,
           static_cast<std::ptrdiff_t>(other.sheet) - static_cast<std::ptrdiff_t>(sheet)});
    }
}

}  // namespace

void find_neighbours(std::span<SheetSpec> sheets) {
  std::vector<LimitedView> limited;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    for (const ViewSpec& view : sheets[s].views)
      if (view.view.limits && !view.view.perspective) limited.push_back({&view, s});
  for (std::size_t s = 0; s < sheets.size(); ++s)
    for (ViewSpec& view : sheets[s].views) {
      if (!view.match_lines || !view.view.limits || view.view.perspective) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true})
          if (view.view.direction[axis] == 0) add_neighbours(view, s, axis, upper, limited);
    }
}

}  // namespace strake::sheets
