// SPDX-License-Identifier: Apache-2.0
#include "report/view_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "strake/geometry/bvh.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::report {
namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// Pairs of boxes that meet, 8 bytes each.
constexpr std::uint64_t kMostPairs = std::uint64_t{1} << 28U;

auto key(const ClassedPiece& p) {
  const auto& [least, most] = std::minmax(p.piece->a, p.piece->b);
  return std::tuple(Vec3l(least), Vec3l(most), p.cls);
}

Box3l box_of(const ViewPiece& piece, std::int64_t margin) {
  Box3l box = geometry::empty_box<std::int64_t>();
  box.include(piece.a);
  box.include(piece.b);
  for (int k = 0; k < 3; ++k) {
    box.lo[k] -= margin;
    box.hi[k] += margin;
  }
  return box;
}

}  // namespace

std::vector<std::uint8_t> find_twins(std::span<const ClassedPiece> pieces) {
  std::vector<std::uint32_t> before, after;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) (pieces[i].after ? after : before).push_back(i);
  const auto by_key = [&](std::uint32_t i) { return key(pieces[i]); };
  std::ranges::sort(before, {}, by_key);
  std::ranges::sort(after, {}, by_key);
  std::vector<std::uint8_t> twins(pieces.size());
  auto a = before.begin();
  auto b = after.begin();
  while (a != before.end() && b != after.end()) {
    const auto order = by_key(*a) <=> by_key(*b);
    if (order < 0) {
      ++a;
    } else if (order > 0) {
      ++b;
    } else {
      // Of one class at one place, however often.
      const auto same = by_key(*a);
      for (; a != before.end() && by_key(*a) == same; ++a) twins[*a] = 1;
      for (; b != after.end() && by_key(*b) == same; ++b) twins[*b] = 1;
    }
  }
  return twins;
}

Result<std::vector<CoverOf>> find_covers(std::span<const ClassedPiece> pieces,
                                         std::span<const std::uint8_t> has_twin,
                                         double tolerance_mm, const parallel::Context& context) {
  const auto margin = static_cast<std::int64_t>(std::ceil(tolerance_mm * 1000));
  Box3l asked = geometry::empty_box<std::int64_t>();
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (has_twin[i] == 0) asked.include(box_of(*pieces[i].piece, margin));
  if (asked.empty()) return std::vector<CoverOf>{};
  std::vector<geometry::BoxItem> items(pieces.size());
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const Box3l box = box_of(*pieces[i].piece, margin);
    items[i] = {box.meets(asked) ? box : geometry::empty_box<std::int64_t>(), i,
                static_cast<std::uint8_t>(has_twin[i] != 0 ? geometry::kSetB
                                                           : geometry::kSetA | geometry::kSetB)};
  }
  const auto tree = geometry::BoxTree::build(items, context);
  if (!tree) return tree.error();
  const auto pairs = geometry::meeting_pairs(*tree, context, kMostPairs);
  if (!pairs) return pairs.error();
  auto covers = parallel::collect<CoverOf>(
      context, {.name = "lines at one place", .n = pairs->size(), .grain = 1024},
      [&](std::size_t i, std::vector<CoverOf>& out) {
        const auto [first, second] = (*pairs)[i];
        for (const auto& [of, by] : {std::pair(first, second), std::pair(second, first)}) {
          if (has_twin[of] != 0) continue;
          const auto stretch = common_stretch(*pieces[of].piece, *pieces[by].piece, tolerance_mm);
          if (stretch)
            out.push_back(
                {of, {stretch->first, stretch->second, pieces[by].cls, pieces[by].after}});
        }
      });
  if (!covers) return covers.error();
  std::ranges::sort(*covers, {}, [](const CoverOf& c) {
    return std::tuple(c.of, c.cover.from_mm, c.cover.to_mm, c.cover.after, c.cover.cls);
  });
  return covers;
}

}  // namespace strake::report
