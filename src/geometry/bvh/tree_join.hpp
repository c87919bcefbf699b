// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0062 says what would have to be shown before this join ran on a GPU.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/bvh/overlapping_pairs.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::geometry {

/// Finds the pairs of items of two scene trees, or those within one, by dual-tree traversal.
///
/// Rule decides what is near: `nodes_meet(node of x, node of y)` may say yes too often,
/// `items_meet(i, j)` takes positions in the trees' items(), and `numbers(i, j)` names the
/// two items. All must outlive the join.
template <class Rule>
class TreeJoin {
 public:
  TreeJoin(const SceneBvh& x, const SceneBvh& y, const Rule& rule)
      : x_(x), y_(y), within_(&x == &y), rule_(rule) {}

  /// Returns the pairs in an order that no team changes. Errors: cancelled; input, where there are
  /// more than the allowance.
  [[nodiscard]] Result<std::vector<IndexPair>> run(const char* name,
                                                   const parallel::Context& context,
                                                   parallel::Allowance& allowance) const {
    const std::vector<Task> tasks = subtasks();
    return parallel::collect_with<IndexPair>(
        context, {.name = name, .n = tasks.size()}, [] { return std::vector<Task>(); },
        [&](std::vector<Task>& stack, std::size_t i, std::vector<IndexPair>& out) -> Status {
          if (run_task(tasks[i], stack, out, allowance)) return {};
          return too_many(allowance);
        });
  }

 private:
  using Node = SceneBvh::Node;
  /// Two nodes; within one tree a == b stands for the pairs within one node.
  struct Task {
    std::uint32_t a = 0, b = 0;
  };
  /// How many tasks the root pair is expanded into before they are shared: enough for any team, and
  /// the same for every team. Between 256 and 4096 no difference can be seen (decision 0073).
  static constexpr std::size_t kSubtasks = 1024;

  [[nodiscard]] const Node& node_x(std::uint32_t i) const { return x_.nodes()[i]; }
  [[nodiscard]] const Node& node_y(std::uint32_t i) const { return y_.nodes()[i]; }
  [[nodiscard]] bool is_one(const Task& p) const { return within_ && p.a == p.b; }
  [[nodiscard]] bool leaves(const Task& p) const {
    return node_x(p.a).count > 0 && node_y(p.b).count > 0;
  }

  [[nodiscard]] std::vector<Task> subtasks() const {
    std::vector<Task> tasks;
    if (!x_.nodes().empty() && !y_.nodes().empty()) push(0, 0, tasks);
    for (bool grew = true; grew && tasks.size() < kSubtasks;) {
      grew = false;
      std::vector<Task> next;
      for (const Task& p : tasks) {
        if (leaves(p)) {
          next.push_back(p);
        } else {
          grew = true;
          expand(p, next);
        }
      }
      tasks.swap(next);
    }
    return tasks;
  }

  /// Returns false when there are too many pairs.
  [[nodiscard]] bool run_task(const Task& task, std::vector<Task>& stack,
                              std::vector<IndexPair>& out, parallel::Allowance& allowance) const {
    // Only shares the work out: between 4096 and 65'536 no difference can be seen (decision 0073).
    constexpr std::size_t kPairsPerCharge = std::size_t{1} << 14U;
    std::size_t counted = out.size();
    stack.assign(1, task);
    while (!stack.empty()) {
      const Task p = stack.back();
      stack.pop_back();
      if (leaves(p))
        test_items(p, out);
      else
        expand(p, stack);
      if (out.size() - counted < kPairsPerCharge) continue;
      if (!allowance.take(out.size() - counted)) return false;
      counted = out.size();
    }
    return allowance.take(out.size() - counted);
  }

  void push(std::uint32_t a, std::uint32_t b, std::vector<Task>& out) const {
    const Node &x = node_x(a), &y = node_y(b);
    if (sets_match(x.sets, y.sets) && (is_one({a, b}) || rule_.nodes_meet(x, y)))
      out.push_back({a, b});
  }

  void expand(const Task& p, std::vector<Task>& out) const {
    const Node &x = node_x(p.a), &y = node_y(p.b);
    if (is_one(p)) {
      push(x.first, x.first, out);
      push(x.first + 1, x.first + 1, out);
      push(x.first, x.first + 1, out);
    } else if (y.count > 0 || (x.count == 0 && extent(x_, x) >= extent(y_, y))) {
      push(x.first, p.b, out);
      push(x.first + 1, p.b, out);
    } else {
      push(p.a, y.first, out);
      push(p.a, y.first + 1, out);
    }
  }

  static std::int64_t extent(const SceneBvh& tree, const Node& node) {
    const Box3l box = tree.box(node);
    const Vec3l d = box.hi - box.lo;
    return d.x + d.y + d.z;
  }

  void test_items(const Task& p, std::vector<IndexPair>& out) const {
    const Node &x = node_x(p.a), &y = node_y(p.b);
    for (std::uint32_t i = x.first; i < x.first + x.count; ++i) {
      const BoxItem& item = x_.items()[i];
      for (std::uint32_t j = is_one(p) ? i + 1 : y.first; j < y.first + y.count; ++j) {
        const BoxItem& other = y_.items()[j];
        if (item.owner == other.owner || !sets_match(item.sets, other.sets) ||
            !rule_.items_meet(i, j))
          continue;
        const IndexPair numbers = rule_.numbers(i, j);
        out.push_back(
            {std::min(numbers.first, numbers.second), std::max(numbers.first, numbers.second)});
      }
    }
  }

  const SceneBvh &x_, &y_;
  bool within_;
  const Rule& rule_;
};

}  // namespace strake::geometry
