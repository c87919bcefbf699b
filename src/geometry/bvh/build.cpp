// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "strake/geometry/bvh.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {
namespace {

using Node = BoxTree::Node;

constexpr std::size_t kLeafSize = 4;
constexpr std::size_t kBins = 16;
/// Ranges of at most this many items are built as one piece of parallel work; fixed, so that the
/// tree does not depend on the team.
constexpr std::size_t kSubtree = 4096;

/// What the build moves about instead of the items: 32-bit boxes relative to the root.
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

double half_area(const Box3i& b) {
  const double x = double{1} * b.hi.x - b.lo.x, y = double{1} * b.hi.y - b.lo.y,
               z = double{1} * b.hi.z - b.lo.z;
  return x * y + y * z + z * x;
}

/// Twice the centre: exact.
std::int64_t centre2(const Box3i& b, int axis) {
  return std::int64_t{b.lo[axis]} + std::int64_t{b.hi[axis]};
}

struct Split {
  int axis = -1;
  std::size_t bin = 0;  ///< items in bins 0..bin go left
  std::int64_t lo = 0, extent = 0;
  double cost = std::numeric_limits<double>::infinity();

  [[nodiscard]] static std::size_t bin_of(std::int64_t c, std::int64_t lo, std::int64_t extent) {
    return static_cast<std::size_t>((c - lo) * static_cast<std::int64_t>(kBins) / (extent + 1));
  }
  [[nodiscard]] bool left(const Ref& r) const {
    return bin_of(centre2(r.box, axis), lo, extent) <= bin;
  }
};

struct Bin {
  Box3i box = empty_box<std::int32_t>();
  std::size_t count = 0;
};

void sweep(const std::array<Bin, kBins>& bins, Split& candidate, Split& best) {
  std::array<double, kBins> right{};
  Bin tail;
  for (std::size_t b = kBins - 1; b > 0; --b) {
    tail.box.include(bins[b].box);
    tail.count += bins[b].count;
    right[b - 1] = tail.count == 0 ? 0 : half_area(tail.box) * static_cast<double>(tail.count);
  }
  Bin head;
  for (std::size_t b = 0; b + 1 < kBins; ++b) {
    head.box.include(bins[b].box);
    head.count += bins[b].count;
    if (head.count == 0) continue;
    candidate.bin = b;
    candidate.cost = half_area(head.box) * static_cast<double>(head.count) + right[b];
    if (candidate.cost < best.cost) best = candidate;
  }
}

Split best_split(std::span<const Ref> refs) {
  std::array<std::int64_t, 3> lo, hi;
  lo.fill(std::numeric_limits<std::int64_t>::max());
  hi.fill(std::numeric_limits<std::int64_t>::min());
  for (const Ref& r : refs)
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(k);
      const std::int64_t c = centre2(r.box, k);
      lo[a] = std::min(lo[a], c);
      hi[a] = std::max(hi[a], c);
    }
  Split best;
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    if (lo[a] == hi[a]) continue;
    Split candidate;
    candidate.axis = k;
    candidate.lo = lo[a];
    candidate.extent = hi[a] - lo[a];
    std::array<Bin, kBins> bins;
    for (const Ref& r : refs) {
      Bin& bin = bins[Split::bin_of(centre2(r.box, k), lo[a], candidate.extent)];
      bin.box.include(r.box);
      ++bin.count;
    }
    sweep(bins, candidate, best);
  }
  return best;
}

/// Sorts the range into two non-empty halves and returns the size of the first.
std::size_t divide(std::span<Ref> refs) {
  const Split split = best_split(refs);
  if (split.axis < 0) return refs.size() / 2;  // all centres equal: any halves do
  const auto middle =
      std::partition(refs.begin(), refs.end(), [&](const Ref& r) { return split.left(r); });
  const auto size = static_cast<std::size_t>(middle - refs.begin());
  return size == 0 || size == refs.size() ? refs.size() / 2 : size;
}

/// A range of refs that a node stands for.
struct Task {
  std::uint32_t node = 0;
  std::size_t first = 0, count = 0;
};

void fill(Node& node, std::span<const Ref> refs) {
  node.box = empty_box<std::int32_t>();
  node.sets = 0;
  for (const Ref& r : refs) {
    node.box.include(r.box);
    node.sets = static_cast<std::uint8_t>(node.sets | r.sets);
  }
}

/// Splits the node of a task, appends its two children and tells them to `add`.
template <class Add>
void grow(std::vector<Node>& nodes, std::span<Ref> refs, const Task& task, Add&& add) {
  const std::size_t left = divide(refs.subspan(task.first, task.count));
  const auto child = static_cast<std::uint32_t>(nodes.size());
  nodes[task.node].first = child;
  nodes[task.node].count = 0;
  nodes.emplace_back();
  nodes.emplace_back();
  add(Task{child, task.first, left});
  add(Task{child + 1, task.first + left, task.count - left});
}

/// The subtree over one range: node 0 is its root, leaves point into the whole array of refs.
std::vector<Node> subtree(std::span<Ref> refs, const Task& range) {
  std::vector<Node> nodes(1);
  nodes.reserve(range.count);
  std::vector<Task> stack{{0, range.first, range.count}};
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    fill(nodes[task.node], refs.subspan(task.first, task.count));
    if (task.count <= kLeafSize) {
      nodes[task.node].first = static_cast<std::uint32_t>(task.first);
      nodes[task.node].count = static_cast<std::uint16_t>(task.count);
    } else {
      grow(nodes, refs, task, [&](const Task& t) { stack.push_back(t); });
    }
  }
  return nodes;
}

/// Nodes above the subtrees; their tasks in the order in which they were found.
std::vector<Task> top(std::vector<Node>& nodes, std::span<Ref> refs, const std::stop_token& stop) {
  std::vector<Task> done, level{{0, 0, refs.size()}};
  while (!level.empty() && !stop.stop_requested()) {
    std::vector<Task> next;
    for (const Task& task : level) {
      fill(nodes[task.node], refs.subspan(task.first, task.count));
      if (task.count <= kSubtree)
        done.push_back(task);
      else
        grow(nodes, refs, task, [&](const Task& t) { next.push_back(t); });
    }
    level.swap(next);
  }
  return done;
}

/// Puts a subtree in place of its root task; children move behind the nodes there are.
void attach(std::vector<Node>& nodes, const Task& task, std::span<const Node> piece) {
  const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
  const auto moved = [shift](Node n) {
    if (n.count == 0) n.first += shift;
    return n;
  };
  nodes[task.node] = moved(piece[0]);
  for (const Node& n : piece.subspan(1)) nodes.push_back(moved(n));
}

std::vector<Ref> make_refs(std::span<const BoxItem> items) {
  Box3l root = empty_box<std::int64_t>();
  for (const BoxItem& item : items) root.include(item.box);
  const Quantiser quantiser(root);
  std::vector<Ref> refs;
  refs.reserve(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!items[i].box.empty() && items[i].sets != 0)
      refs.push_back({quantiser.box(items[i].box), static_cast<std::uint32_t>(i), items[i].sets});
  return refs;
}

}  // namespace

Result<BoxTree> BoxTree::build(std::span<const BoxItem> items, const parallel::Context& context) {
  BoxTree tree;
  std::vector<Ref> refs = make_refs(items);
  if (refs.empty()) return tree;
  tree.nodes_.reserve(refs.size());
  tree.nodes_.resize(1);
  const std::vector<Task> tasks = top(tree.nodes_, refs, context.stop);
  auto pieces = parallel::transform(context, {.name = "box tree", .n = tasks.size()},
                                    [&](std::size_t i) { return subtree(refs, tasks[i]); });
  if (!pieces) return pieces.error();
  for (std::size_t i = 0; i < tasks.size(); ++i) attach(tree.nodes_, tasks[i], (*pieces)[i]);
  tree.items_.reserve(refs.size());
  tree.order_.reserve(refs.size());
  for (const Ref& r : refs) {
    tree.items_.push_back(items[r.item]);
    tree.order_.push_back(r.item);
  }
  return tree;
}

}  // namespace strake::geometry
