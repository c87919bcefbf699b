// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <queue>
#include <utility>

#include "clash/group/partition.hpp"

namespace strake::clash {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// The items of each object.
class ItemsOfObjects {
 public:
  explicit ItemsOfObjects(std::span<const GroupingItem> items) {
    std::uint32_t objects = 0;
    for (const GroupingItem& item : items) objects = std::max(objects, index(item.pair->b) + 1);
    first_.assign(objects + 1, 0);
    for (const GroupingItem& item : items)
      for (const model::ObjectId id : {item.pair->a, item.pair->b}) ++first_[index(id) + 1];
    for (std::size_t o = 1; o < first_.size(); ++o) first_[o] += first_[o - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    uses_.resize(2 * items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      for (const model::ObjectId id : {items[i].pair->a, items[i].pair->b})
        uses_[next[index(id)]++] = static_cast<std::uint32_t>(i);
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

Partition by_element(std::span<const GroupingItem> items) {
  Partition partition;
  partition.group.assign(items.size(), kNone);
  const ItemsOfObjects uses(items);
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
      --left[index(items[i].pair->a)];
      --left[index(items[i].pair->b)];
    }
    partition.about.push_back(model::ObjectId{top.object});
    ++partition.count;
  }
  return partition;
}

}  // namespace strake::clash
