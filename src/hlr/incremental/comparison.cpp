// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/comparison.hpp"

#include <algorithm>

#include "strake/hlr/incremental.hpp"

namespace strake::hlr {
namespace {

Error misfit() {
  return {ErrorCode::usage, "the earlier drawing and the numbers of its objects do not fit", "view",
          "give a number of this scene, each once, or none for each object of that drawing"};
}

/// Returns, of a sequence of distinct numbers, which belong to a longest ascending part of it.
std::vector<bool> longest_ascent(std::span<const std::uint32_t> sequence) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> ends;  // by length, the position of the least last number
  std::vector<std::uint32_t> previous(sequence.size(), kNone);
  for (std::uint32_t i = 0; i < sequence.size(); ++i) {
    const auto at = std::ranges::lower_bound(ends, sequence[i], {},
                                             [&](std::uint32_t end) { return sequence[end]; });
    if (at != ends.begin()) previous[i] = *(at - 1);
    if (at == ends.end())
      ends.push_back(i);
    else
      *at = i;
  }
  std::vector<bool> chosen(sequence.size());
  for (std::uint32_t i = ends.empty() ? kNone : ends.back(); i != kNone; i = previous[i])
    chosen[i] = true;
  return chosen;
}

/// Makes another of an object that stayed.
void make_other(std::uint32_t number, std::span<const geometry::Box3l> boxes, Comparison& result) {
  std::uint32_t& before = result.before[number];
  result.left.push_back(boxes[before]);
  before = model::kNoObject;
  ++result.changed;
}

/// Makes others of those objects that changed places.
void keep_in_order(std::span<const std::uint32_t> now, std::span<const geometry::Box3l> boxes,
                   Comparison& result) {
  std::vector<std::uint32_t> sequence;
  for (const std::uint32_t number : now)
    if (number != model::kNoObject) sequence.push_back(number);
  if (std::ranges::is_sorted(sequence)) return;
  const std::vector<bool> kept = longest_ascent(sequence);
  for (std::size_t i = 0; i < sequence.size(); ++i)
    if (!kept[i]) make_other(sequence[i], boxes, result);
}

}  // namespace

void mark_changed_hatches(std::span<const Hatch> earlier, std::span<const Hatch> now,
                          std::span<const geometry::Box3l> boxes, Comparison& comparison) {
  if (earlier.empty() && now.empty()) return;
  const bool comparable = !earlier.empty() && !now.empty();
  for (std::uint32_t o = 0; o < comparison.before.size(); ++o) {
    const std::uint32_t before = comparison.before[o];
    if (before == model::kNoObject || (comparable && earlier[before] == now[o])) continue;
    make_other(o, boxes, comparison);
  }
}

Result<Comparison> compare_objects(std::span<const std::uint32_t> now,
                                   std::span<const geometry::Box3l> boxes, std::size_t objects) {
  if (now.size() != boxes.size()) return misfit();
  Comparison result;
  result.before.assign(objects, model::kNoObject);
  result.changed = objects;
  for (std::uint32_t old = 0; old < now.size(); ++old) {
    if (now[old] == model::kNoObject) {
      result.left.push_back(boxes[old]);
      continue;
    }
    if (now[old] >= objects || result.before[now[old]] != model::kNoObject) return misfit();
    result.before[now[old]] = old;
    result.same_numbers = result.same_numbers && now[old] == old;
    --result.changed;
  }
  keep_in_order(now, boxes, result);
  return result;
}

}  // namespace strake::hlr
