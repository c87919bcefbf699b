// SPDX-License-Identifier: Apache-2.0
#include "tiles/split.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/parting.hpp"

namespace strake::tiles {
namespace {

constexpr std::int64_t kFarthest = std::numeric_limits<std::int64_t>::max();

/// The middle of a box along an axis, without an overflow.
std::int64_t middle(const geometry::Box3l& box, int axis) {
  return box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
}

class Cutter {
 public:
  Cutter(std::span<const Extent> extents, std::uint64_t max_bytes)
      : extents_(extents), max_bytes_(max_bytes) {}

  std::vector<CutCell> run() {
    CutCell all{{{-kFarthest, -kFarthest, -kFarthest}, {kFarthest, kFarthest, kFarthest}}, {}, 0};
    for (std::uint32_t o = 0; o < extents_.size(); ++o)
      if (!extents_[o].box.empty()) add(all, o);
    cut(std::move(all));
    return std::move(cells_);
  }

 private:
  void add(CutCell& cell, std::uint32_t object) const {
    cell.objects.push_back(object);
    cell.bytes += extents_[object].bytes;
  }

  void cut(CutCell whole) {
    if (whole.bytes > max_bytes_) {
      for (const int axis : axes_of(whole)) {
        std::optional<std::pair<CutCell, CutCell>> halves = halved(whole, axis);
        if (!halves) continue;
        whole.objects = {};
        cut(std::move(halves->first));
        cut(std::move(halves->second));
        return;
      }
    }
    cells_.push_back(std::move(whole));
  }

  /// Returns the axes, that along which the middles of the objects lie farthest apart first.
  [[nodiscard]] std::array<int, 3> axes_of(const CutCell& cell) const {
    geometry::Box3l middles = geometry::empty_box<std::int64_t>();
    for (const std::uint32_t o : cell.objects) {
      const geometry::Box3l& box = extents_[o].box;
      middles.include(geometry::Vec3l{middle(box, 0), middle(box, 1), middle(box, 2)});
    }
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::sort(axes, [&](int x, int y) {
      const std::int64_t of_x = middles.hi[x] - middles.lo[x];
      const std::int64_t of_y = middles.hi[y] - middles.lo[y];
      return of_x != of_y ? of_x > of_y : x < y;
    });
    return axes;
  }

  /// Returns the halves of a cell; nothing where one of them would have nearly all of it.
  [[nodiscard]] std::optional<std::pair<CutCell, CutCell>> halved(const CutCell& whole,
                                                                  int axis) const {
    constexpr std::size_t kSamples = 4096;
    std::vector<std::int64_t> middles;
    const std::size_t step = whole.objects.size() / kSamples + 1;
    for (std::size_t i = 0; i < whole.objects.size(); i += step)
      middles.push_back(middle(extents_[whole.objects[i]].box, axis));
    const std::int64_t at = nth_value(std::span(middles), middles.size() / 2);
    if (at <= whole.cell.lo[axis] || at >= whole.cell.hi[axis]) return std::nullopt;
    std::pair<CutCell, CutCell> halves{{whole.cell, {}, 0}, {whole.cell, {}, 0}};
    halves.first.cell.hi[axis] = halves.second.cell.lo[axis] = at;
    for (const std::uint32_t o : whole.objects) {
      if (extents_[o].box.lo[axis] < at) add(halves.first, o);
      if (extents_[o].box.hi[axis] >= at) add(halves.second, o);
    }
    const std::uint64_t larger = std::max(halves.first.bytes, halves.second.bytes);
    if (larger / 8 >= whole.bytes / 9) return std::nullopt;
    return halves;
  }

  std::span<const Extent> extents_;
  std::uint64_t max_bytes_;
  std::vector<CutCell> cells_;
};

}  // namespace

std::vector<CutCell> cut_space(std::span<const Extent> extents, std::uint64_t max_bytes) {
  return Cutter(extents, max_bytes).run();
}

}  // namespace strake::tiles
