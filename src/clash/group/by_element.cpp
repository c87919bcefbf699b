// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <queue>
#include <vector>

#include "clash/group/partition.hpp"

namespace strake::clash {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// What an item is between; `second` is absent where both are of one assembly.
struct Sides {
  std::uint32_t first = 0, second = kNone;

  template <class Visit>
  void each(Visit&& visit) const {
    visit(first);
    if (second != kNone) visit(second);
  }
};

Sides sides_of(const Pair& pair, std::span<const model::ObjectId> stands_for) {
  const std::uint32_t a = index(stands_for[index(pair.a)]), b = index(stands_for[index(pair.b)]);
  return {a, a == b ? kNone : b};
}

/// The items of each object.
class Uses {
 public:
  Uses(std::span<const Sides> items, std::size_t objects) {
    first_.assign(objects + 1, 0);
    for (const Sides& item : items) item.each([&](std::uint32_t o) { ++first_[o + 1]; });
    for (std::size_t o = 1; o < first_.size(); ++o) first_[o] += first_[o - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    uses_.resize(first_.back());
    for (std::uint32_t i = 0; i < items.size(); ++i)
      items[i].each([&](std::uint32_t o) { uses_[next[o]++] = i; });
  }
  [[nodiscard]] std::uint32_t objects() const {
    return static_cast<std::uint32_t>(first_.size() - 1);
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t object) const {
    return std::span(uses_).subspan(first_[object], first_[object + 1] - first_[object]);
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> uses_;
};

struct CoverCandidate {
  std::size_t count = 0;
  std::uint32_t object = 0;
  friend bool operator<(const CoverCandidate& x, const CoverCandidate& y) {
    return x.count != y.count ? x.count < y.count : x.object > y.object;
  }
};

}  // namespace

Partition by_element(std::span<const GroupingItem> items,
                     std::span<const model::ObjectId> stands_for) {
  Partition partition;
  partition.group.assign(items.size(), kNone);
  std::vector<Sides> sides;
  sides.reserve(items.size());
  for (const GroupingItem& item : items) sides.push_back(sides_of(*item.pair, stands_for));
  const Uses uses(sides, stands_for.size());
  std::vector<std::size_t> left(uses.objects());
  std::priority_queue<CoverCandidate> queue;
  for (std::uint32_t o = 0; o < uses.objects(); ++o) {
    left[o] = uses.of(o).size();
    if (left[o] > 0) queue.push({left[o], o});
  }
  while (!queue.empty()) {
    const CoverCandidate top = queue.top();
    queue.pop();
    if (left[top.object] == 0) continue;
    if (left[top.object] != top.count) {  // some went to others since it was queued
      queue.push({left[top.object], top.object});
      continue;
    }
    for (const std::uint32_t i : uses.of(top.object)) {
      if (partition.group[i] != kNone) continue;
      partition.group[i] = partition.count;
      sides[i].each([&](std::uint32_t o) { --left[o]; });
    }
    partition.about.push_back(model::ObjectId{top.object});
    ++partition.count;
  }
  return partition;
}

}  // namespace strake::clash
