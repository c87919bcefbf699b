// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/bvh/pair_lists.hpp"
#include "strake/geometry/framed_boxes.hpp"

namespace strake::geometry {
namespace {

using Node = BoxTree::Node;

/// Two frames, and how boxes in the one are parted from boxes in the other.
class FramePair {
 public:
  FramePair(const Mat3d& x, const Mat3d& y) : same_(x == y) {
    for (std::size_t i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        turn_.row[i][j] = dot(x.row[i], y.row[static_cast<std::size_t>(j)]);
        size_.row[i][j] = std::fabs(turn_.row[i][j]);
      }
  }

  [[nodiscard]] bool parted(const Box3l& x, const Box3l& y) const {
    if (same_) return !x.meets(y);
    const Vec3d p = half(x.hi - x.lo), q = half(y.hi - y.lo);
    const Vec3d way = turn_ * half(y.lo + y.hi) - half(x.lo + x.hi);
    const double slack =
        kRounding * (sum(p) + sum(q) + std::fabs(way.x) + std::fabs(way.y) + std::fabs(way.z));
    return parted_by_face(p, q, way, slack) || parted_by_edges(p, q, way, slack);
  }

 private:
  /// What rounding may make of a width, relative.
  static constexpr double kRounding = 1e-12;

  static Vec3d half(const Vec3l& v) { return v.as<double>() * 0.5; }
  static double sum(const Vec3d& v) { return v.x + v.y + v.z; }
  [[nodiscard]] double turn(int i, int j) const {
    return turn_.row[static_cast<std::size_t>(i)][j];
  }
  [[nodiscard]] double size(int i, int j) const {
    return size_.row[static_cast<std::size_t>(i)][j];
  }

  [[nodiscard]] bool parted_by_face(const Vec3d& p, const Vec3d& q, const Vec3d& way,
                                    double slack) const {
    for (int k = 0; k < 3; ++k) {
      double of_q = 0, of_p = 0, along = 0;
      for (int j = 0; j < 3; ++j) {
        of_q += size(k, j) * q[j];
        of_p += size(j, k) * p[j];
        along += turn(j, k) * way[j];
      }
      if (std::fabs(way[k]) > p[k] + of_q + slack || std::fabs(along) > q[k] + of_p + slack)
        return true;
    }
    return false;
  }

  /// Across an edge of each. Where these are parallel nothing is left of any width but rounding.
  [[nodiscard]] bool parted_by_edges(const Vec3d& p, const Vec3d& q, const Vec3d& way,
                                     double slack) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        const double of_p = p[i1] * size(i2, j) + p[i2] * size(i1, j);
        const double of_q = q[j1] * size(i, j2) + q[j2] * size(i, j1);
        if (std::fabs(way[i2] * turn(i1, j) - way[i1] * turn(i2, j)) > of_p + of_q + slack)
          return true;
      }
    return false;
  }

  Mat3d turn_;  ///< from the second frame to the first
  Mat3d size_;  ///< its entries without signs
  bool same_;
};

/// The items of one frame.
struct Group {
  std::vector<std::uint32_t> items;
  BoxTree tree = {};
};

struct NodePair {
  std::uint32_t a = 0, b = 0;
};

/// The pairs of two groups, or those within one.
class GroupJoin {
 public:
  GroupJoin(std::span<const BoxItem> items, const FramedBoxes& framed,
            const std::vector<Group>& groups, std::size_t x, std::size_t y)
      : items_(items),
        x_(groups[x]),
        y_(groups[y]),
        frames_(framed.frames[x], framed.frames[y]),
        within_(x == y) {}

  /// The root pair, expanded breadth first.
  [[nodiscard]] std::vector<NodePair> subtasks() const {
    constexpr std::size_t kSubtasks = 1024;
    std::vector<NodePair> tasks;
    if (!x_.tree.nodes().empty() && !y_.tree.nodes().empty()) push(0, 0, tasks);
    for (bool grew = true; grew && tasks.size() < kSubtasks;) {
      grew = false;
      std::vector<NodePair> next;
      for (const NodePair& p : tasks) {
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

  /// False when there are too many pairs.
  [[nodiscard]] bool run(const NodePair& task, std::vector<IndexPair>& out,
                         parallel::Allowance& allowance) const {
    constexpr std::size_t kAskAfter = std::size_t{1} << 14U;
    std::size_t counted = out.size();
    std::vector<NodePair> stack{task};
    while (!stack.empty()) {
      const NodePair p = stack.back();
      stack.pop_back();
      if (leaves(p))
        test_items(p, out);
      else
        expand(p, stack);
      if (out.size() - counted < kAskAfter) continue;
      if (!allowance.take(out.size() - counted)) return false;
      counted = out.size();
    }
    return allowance.take(out.size() - counted);
  }

 private:
  [[nodiscard]] const Node& node_x(std::uint32_t i) const { return x_.tree.nodes()[i]; }
  [[nodiscard]] const Node& node_y(std::uint32_t i) const { return y_.tree.nodes()[i]; }
  [[nodiscard]] bool leaves(const NodePair& p) const {
    return node_x(p.a).count > 0 && node_y(p.b).count > 0;
  }
  [[nodiscard]] bool is_one(const NodePair& p) const { return within_ && p.a == p.b; }

  void push(std::uint32_t a, std::uint32_t b, std::vector<NodePair>& out) const {
    const Node &x = node_x(a), &y = node_y(b);
    if (sets_match(x.sets, y.sets) && (is_one({a, b}) || near(x, y))) out.push_back({a, b});
  }

  /// Of one tree the boxes compare as they are.
  [[nodiscard]] bool near(const Node& x, const Node& y) const {
    return within_ ? x.box.meets(y.box) : !frames_.parted(x_.tree.box(x), y_.tree.box(y));
  }

  void expand(const NodePair& p, std::vector<NodePair>& out) const {
    const Node &x = node_x(p.a), &y = node_y(p.b);
    if (is_one(p)) {
      push(x.first, x.first, out);
      push(x.first + 1, x.first + 1, out);
      push(x.first, x.first + 1, out);
    } else if (y.count > 0 || (x.count == 0 && extent(x_.tree, x) >= extent(y_.tree, y))) {
      push(x.first, p.b, out);
      push(x.first + 1, p.b, out);
    } else {
      push(p.a, y.first, out);
      push(p.a, y.first + 1, out);
    }
  }

  static std::int64_t extent(const BoxTree& tree, const Node& node) {
    const Box3l box = tree.box(node);
    const Vec3l d = box.hi - box.lo;
    return d.x + d.y + d.z;
  }

  void test_items(const NodePair& p, std::vector<IndexPair>& out) const {
    const Node &x = node_x(p.a), &y = node_y(p.b);
    for (std::uint32_t i = x.first; i < x.first + x.count; ++i)
      for (std::uint32_t j = is_one(p) ? i + 1 : y.first; j < y.first + y.count; ++j) {
        const std::uint32_t a = x_.items[x_.tree.order()[i]], b = y_.items[y_.tree.order()[j]];
        if (items_[a].owner != items_[b].owner && sets_match(items_[a].sets, items_[b].sets) &&
            items_[a].box.meets(items_[b].box) &&
            !frames_.parted(x_.tree.items()[i].box, y_.tree.items()[j].box))
          out.push_back({std::min(a, b), std::max(a, b)});
      }
  }

  std::span<const BoxItem> items_;
  const Group &x_, &y_;
  FramePair frames_;
  bool within_;
};

Result<std::vector<Group>> group_by_frame(std::span<const BoxItem> items, const FramedBoxes& framed,
                                          const parallel::Context& context) {
  std::vector<Group> groups(framed.frames.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) groups[framed.frame[i]].items.push_back(i);
  for (Group& group : groups) {
    std::vector<BoxItem> in_frame;
    in_frame.reserve(group.items.size());
    for (const std::uint32_t i : group.items)
      in_frame.push_back({items[i].box.empty() ? empty_box<std::int64_t>() : framed.box[i],
                          items[i].owner, items[i].sets});
    auto tree = BoxTree::build(in_frame, context);
    if (!tree) return tree.error();
    group.tree = std::move(*tree);
  }
  return groups;
}

}  // namespace

Result<std::vector<IndexPair>> meeting_pairs(std::span<const BoxItem> items,
                                             const FramedBoxes& framed,
                                             const parallel::Context& context, std::uint64_t most) {
  const auto groups = group_by_frame(items, framed, context);
  if (!groups) return groups.error();
  parallel::Allowance allowance(most);
  std::vector<IndexPair> pairs;
  for (std::size_t x = 0; x < groups->size(); ++x)
    for (std::size_t y = x; y < groups->size(); ++y) {
      const GroupJoin join(items, framed, *groups, x, y);
      const std::vector<NodePair> tasks = join.subtasks();
      const auto found =
          parallel::collect<IndexPair>(context, {.name = "broad phase, askew", .n = tasks.size()},
                                       [&](std::size_t i, std::vector<IndexPair>& out) -> Status {
                                         if (join.run(tasks[i], out, allowance)) return {};
                                         return too_many(allowance);
                                       });
      if (!found) return found.error();
      pairs.insert(pairs.end(), found->begin(), found->end());
    }
  if (const Status s = sort_pairs(pairs, context); !s) return s.error();
  return pairs;
}

Result<std::vector<IndexPair>> meeting_pairs_all(std::span<const BoxItem> items,
                                                 const FramedBoxes& framed,
                                                 const parallel::Context& context,
                                                 std::uint64_t most) {
  const std::size_t n = framed.frames.size();
  std::vector<FramePair> frames;
  for (const Mat3d& x : framed.frames)
    for (const Mat3d& y : framed.frames) frames.emplace_back(x, y);
  // The lower frame first, as between groups: what rounding makes of two boxes is the same then.
  const auto parted = [&](std::uint32_t a, std::uint32_t b) {
    return frames[framed.frame[a] * n + framed.frame[b]].parted(framed.box[a], framed.box[b]);
  };
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    return items[a].box.meets(items[b].box) &&
           !(framed.frame[a] <= framed.frame[b] ? parted(a, b) : parted(b, a));
  };
  return all_pairs_that(items, meet, context, most);
}

}  // namespace strake::geometry
