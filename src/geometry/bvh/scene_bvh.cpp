// SPDX-License-Identifier: Apache-2.0
#include "geometry/bvh/scene_bvh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parting.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {
namespace {

using Node = SceneBvh::Node;

// On ships of 3,000 leaves of 2 or 8 and 8 or 32 bins are within 0.4 % in instructions.
constexpr std::size_t kLeafSize = 4;
constexpr std::size_t kBins = 16;
/// Number of items sampled to find the split of a range.
constexpr std::size_t kSample = std::size_t{1} << 14U;
/// Ranges of at most this many items are built as one piece of parallel work; fixed, so that the
/// tree does not depend on the team.
constexpr std::size_t kSubtree = 4096;

/// A reference to an item that the build moves instead: its 32-bit box relative to the root.
struct Ref {
  Box3i box;
  std::uint32_t item = 0;
  std::uint8_t sets = 0;
};

/// 64-bit boxes to 32-bit ones by an offset and a power of two, rounded outward.
struct Quantiser {
  Vec3l origin;
  int shift = 0;

  explicit Quantiser(const Box3l& root) : origin(root.lo) {
    std::int64_t extent = 0;
    for (int k = 0; k < 3; ++k) extent = std::max(extent, root.hi[k] - root.lo[k]);
    while ((extent >> shift) >= (std::int64_t{1} << 30)) ++shift;
  }
  [[nodiscard]] Box3i box(const Box3l& b) const {
    Box3i q;
    const std::int64_t up = (std::int64_t{1} << shift) - 1;
    for (int k = 0; k < 3; ++k) {
      q.lo[k] = static_cast<std::int32_t>((b.lo[k] - origin[k]) >> shift);
      q.hi[k] = static_cast<std::int32_t>((b.hi[k] - origin[k] + up) >> shift);
    }
    return q;
  }
};

/// Bins along the longest side of the box of centres.
struct Split {
  int axis = 0;
  std::size_t bin = 0;  ///< items in bins 0..bin go left
  std::int64_t lo = 0, extent = 0;

  /// Rounding may misplace an item by a bin: nothing but the tree's shape depends on it.
  [[nodiscard]] std::size_t bin_of(const Box3i& box) const {
    const double scale = static_cast<double>(kBins) / static_cast<double>(extent + 1);
    const double at = static_cast<double>(twice_centre(box, axis) - lo) * scale;
    return at < 0 ? 0 : std::min(kBins - 1, static_cast<std::size_t>(at));
  }
  [[nodiscard]] bool left(const Ref& r) const { return bin_of(r.box) <= bin; }
};

struct Bin {
  Box3i box = empty_box<std::int32_t>();
  std::size_t count = 0;
};

using Bins = std::array<Bin, kBins>;

/// Returns the bin after which a split costs least: half areas times counts on either side.
std::size_t cheapest_cut(const Bins& bins) {
  std::array<double, kBins> right{};
  Bin tail;
  for (std::size_t b = kBins - 1; b > 0; --b) {
    tail.box.include(bins[b].box);
    tail.count += bins[b].count;
    right[b - 1] = tail.count == 0 ? 0 : half_area(tail.box) * static_cast<double>(tail.count);
  }
  Bin head;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b + 1 < kBins; ++b) {
    head.box.include(bins[b].box);
    head.count += bins[b].count;
    if (head.count == 0) continue;
    const double cost = half_area(head.box) * static_cast<double>(head.count) + right[b];
    if (cost < least) {
      least = cost;
      best = b;
    }
  }
  return best;
}

/// Returns the best split, from every n-th item when there are many; nothing when all centres are
/// equal.
std::optional<Split> best_split(std::span<const Ref> refs) {
  const std::size_t step = 1 + refs.size() / kSample;
  Box3l centres = empty_box<std::int64_t>();
  for (std::size_t i = 0; i < refs.size(); i += step) {
    const Box3i& box = refs[i].box;
    centres.include(Vec3l{twice_centre(box, 0), twice_centre(box, 1), twice_centre(box, 2)});
  }
  Split split;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t extent = centres.hi[k] - centres.lo[k];
    if (extent <= split.extent) continue;
    split.axis = k;
    split.lo = centres.lo[k];
    split.extent = extent;
  }
  if (split.extent == 0) return std::nullopt;
  Bins bins;
  for (std::size_t i = 0; i < refs.size(); i += step) {
    Bin& bin = bins[split.bin_of(refs[i].box)];
    bin.box.include(refs[i].box);
    ++bin.count;
  }
  split.bin = cheapest_cut(bins);
  return split;
}

/// Sorts the range into two non-empty halves and returns the size of the first.
std::size_t divide(std::span<Ref> refs) {
  const auto split = best_split(refs);
  if (!split) return refs.size() / 2;  // all centres equal: any halves do
  const std::size_t size = part_by(refs, [&](const Ref& r) { return split->left(r); });
  return size == 0 || size == refs.size() ? refs.size() / 2 : size;
}

/// The range of refs of a node.
struct Task {
  std::uint32_t node = 0;
  std::size_t first = 0, count = 0;
};

void fill_leaf(Node& node, std::span<const Ref> refs) {
  node.box = empty_box<std::int32_t>();
  node.sets = 0;
  for (const Ref& r : refs) {
    node.box.include(r.box);
    node.sets = static_cast<std::uint8_t>(node.sets | r.sets);
  }
}

/// Computes the boxes of the inner nodes from those of their children, which follow them.
void fill_inner(std::span<Node> nodes) {
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    if (node.count > 0) continue;
    const Node &left = nodes[node.first], &right = nodes[node.first + 1];
    node.box = left.box;
    node.box.include(right.box);
    node.sets = static_cast<std::uint8_t>(left.sets | right.sets);
  }
}

/// Appends two children to the node of a task and passes them to `add`; `left` items go left.
template <class Add>
void grow(std::vector<Node>& nodes, const Task& task, std::size_t left, Add&& add) {
  const auto child = static_cast<std::uint32_t>(nodes.size());
  nodes[task.node].first = child;
  nodes[task.node].count = 0;
  nodes.emplace_back();
  nodes.emplace_back();
  add(Task{child, task.first, left});
  add(Task{child + 1, task.first + left, task.count - left});
}

/// Builds the subtree over one range: node 0 is its root, leaves point into the whole array of
/// refs.
std::vector<Node> subtree(std::span<Ref> refs, const Task& range) {
  std::vector<Node> nodes(1);
  nodes.reserve(range.count);
  std::vector<Task> stack{{0, range.first, range.count}};
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    const std::span<Ref> mine = refs.subspan(task.first, task.count);
    if (task.count <= kLeafSize) {
      fill_leaf(nodes[task.node], mine);
      nodes[task.node].first = static_cast<std::uint32_t>(task.first);
      nodes[task.node].count = static_cast<std::uint16_t>(task.count);
    } else {
      grow(nodes, task, divide(mine), [&](const Task& t) { stack.push_back(t); });
    }
  }
  fill_inner(nodes);
  return nodes;
}

/// Builds the nodes above the subtrees, a level at a time. Returns the tasks of the subtrees in the
/// order in which they were found.
Result<std::vector<Task>> top(std::vector<Node>& nodes, std::span<Ref> refs,
                              const parallel::Context& context) {
  std::vector<Task> done, level{{0, 0, refs.size()}};
  while (!level.empty()) {
    std::vector<Task> large, next;
    for (const Task& task : level) (task.count <= kSubtree ? done : large).push_back(task);
    const auto left = parallel::transform(
        context, {.name = "box tree, top", .n = large.size()},
        [&](std::size_t i) { return divide(refs.subspan(large[i].first, large[i].count)); });
    if (!left) return left.error();
    for (std::size_t i = 0; i < large.size(); ++i)
      grow(nodes, large[i], (*left)[i], [&](const Task& t) { next.push_back(t); });
    level.swap(next);
  }
  return done;
}

/// Puts each subtree in place of its root task; children move behind the nodes there are.
Status attach(std::vector<Node>& top, const std::vector<Task>& tasks,
              const std::vector<std::vector<Node>>& pieces, const parallel::Context& context) {
  std::vector<std::size_t> begin(pieces.size());  // where the nodes below the root go
  std::size_t size = top.size();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    begin[i] = size;
    size += pieces[i].size() - 1;
  }
  auto made = parallel::unset_slots<Node>(size, context);
  if (!made) return made.error();
  std::vector<Node> nodes = std::move(*made);
  std::ranges::copy(top, nodes.begin());
  top.swap(nodes);
  return parallel::for_each(
      context, {.name = "box tree, joined", .n = pieces.size()}, [&](std::size_t i) {
        const auto moved = [shift = static_cast<std::uint32_t>(begin[i]) - 1](Node n) {
          if (n.count == 0) n.first += shift;
          return n;
        };
        const std::vector<Node>& piece = pieces[i];
        top[tasks[i].node] = moved(piece[0]);
        for (std::size_t k = 1; k < piece.size(); ++k) top[begin[i] + k - 1] = moved(piece[k]);
      });
}

Result<Box3l> box_of_all(std::span<const BoxItem> items, const parallel::Context& context) {
  return parallel::reduce(
      context, {.name = "box of all", .n = items.size(), .grain = kSubtree},
      empty_box<std::int64_t>(),
      [&](Box3l& partial, std::size_t i) { partial.include(items[i].box); },
      [](Box3l& into, const Box3l& partial) { into.include(partial); });
}

Result<std::vector<Ref>> make_refs(std::span<const BoxItem> items, const Quantiser& quantiser,
                                   const parallel::Context& context) {
  return parallel::collect<Ref>(context,
                                {.name = "boxes on a grid", .n = items.size(), .grain = kSubtree},
                                [&](std::size_t i, std::vector<Ref>& out) {
                                  if (!items[i].box.empty() && items[i].sets != 0)
                                    out.push_back({quantiser.box(items[i].box),
                                                   static_cast<std::uint32_t>(i), items[i].sets});
                                });
}

}  // namespace

Result<SceneBvh> SceneBvh::build(std::span<const BoxItem> items, const parallel::Context& context) {
  SceneBvh tree;
  const auto root = box_of_all(items, context);
  if (!root) return root.error();
  const Quantiser quantiser(*root);
  tree.origin_ = quantiser.origin;
  tree.shift_ = quantiser.shift;
  auto made = make_refs(items, quantiser, context);
  if (!made) return made.error();
  std::vector<Ref>& refs = *made;
  if (refs.empty()) return tree;
  tree.nodes_.resize(1);
  const auto tasks = top(tree.nodes_, refs, context);
  if (!tasks) return tasks.error();
  auto pieces = parallel::transform(context, {.name = "box tree", .n = tasks->size()},
                                    [&](std::size_t i) { return subtree(refs, (*tasks)[i]); });
  if (!pieces) return pieces.error();
  const std::size_t inner = tree.nodes_.size();
  if (const Status s = attach(tree.nodes_, *tasks, *pieces, context); !s) return s.error();
  fill_inner(std::span(tree.nodes_).first(inner));
  auto in_leaves = parallel::unset_slots<BoxItem>(refs.size(), context);
  if (!in_leaves) return in_leaves.error();
  tree.items_ = std::move(*in_leaves);
  auto order = parallel::unset_slots<std::uint32_t>(refs.size(), context);
  if (!order) return order.error();
  tree.order_ = std::move(*order);
  const Status status = parallel::for_each(
      context, {.name = "box tree items", .n = refs.size(), .grain = kSubtree}, [&](std::size_t i) {
        tree.items_[i] = items[refs[i].item];
        tree.order_[i] = refs[i].item;
      });
  if (!status) return status.error();
  return tree;
}

}  // namespace strake::geometry
