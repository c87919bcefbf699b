// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_lists.hpp"
#include "strake/geometry/bvh.hpp"
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {
namespace {

using Node = BoxTree::Node;

/// Pieces of work that the self-join is expanded into before it is shared out: enough for any
/// team, and the same for every team.
constexpr std::size_t kSubtasks = 1024;

struct NodePair {
  std::uint32_t a = 0, b = 0;  ///< a == b: the pairs within one node
};

class SelfJoin {
 public:
  explicit SelfJoin(const BoxTree& tree) : tree_(tree), nodes_(tree.nodes()) {}

  /// The root pair, expanded breadth first.
  [[nodiscard]] std::vector<NodePair> subtasks() const {
    std::vector<NodePair> tasks;
    if (nodes_.empty()) return tasks;
    tasks.push_back({0, 0});
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
  [[nodiscard]] bool run(const NodePair& task, std::vector<NodePair>& stack,
                         std::vector<IndexPair>& out, parallel::Allowance& allowance) const {
    constexpr std::size_t kAskAfter = std::size_t{1} << 14U;
    std::size_t counted = out.size();
    stack.assign(1, task);
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
  [[nodiscard]] bool leaves(const NodePair& p) const {
    return nodes_[p.a].count > 0 && nodes_[p.b].count > 0;
  }

  void push(std::uint32_t a, std::uint32_t b, std::vector<NodePair>& out) const {
    const Node &x = nodes_[a], &y = nodes_[b];
    if (sets_match(x.sets, y.sets) && (a == b || x.box.meets(y.box))) out.push_back({a, b});
  }

  void expand(const NodePair& p, std::vector<NodePair>& out) const {
    const Node &x = nodes_[p.a], &y = nodes_[p.b];
    if (p.a == p.b) {
      push(x.first, x.first, out);
      push(x.first + 1, x.first + 1, out);
      push(x.first, x.first + 1, out);
    } else if (y.count > 0 || (x.count == 0 && size(x) >= size(y))) {
      push(x.first, p.b, out);
      push(x.first + 1, p.b, out);
    } else {
      push(p.a, y.first, out);
      push(p.a, y.first + 1, out);
    }
  }

  static std::int64_t size(const Node& n) {
    return (std::int64_t{n.box.hi.x} - n.box.lo.x) + (std::int64_t{n.box.hi.y} - n.box.lo.y) +
           (std::int64_t{n.box.hi.z} - n.box.lo.z);
  }

  void test_items(const NodePair& p, std::vector<IndexPair>& out) const {
    const Node &x = nodes_[p.a], &y = nodes_[p.b];
    for (std::uint32_t i = x.first; i < x.first + x.count; ++i) {
      const BoxItem& item = tree_.items()[i];
      for (std::uint32_t j = p.a == p.b ? i + 1 : y.first; j < y.first + y.count; ++j) {
        const BoxItem& other = tree_.items()[j];
        if (item.owner == other.owner || !sets_match(item.sets, other.sets) ||
            !item.box.meets(other.box))
          continue;
        const std::uint32_t a = tree_.order()[i], b = tree_.order()[j];
        out.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  }

  const BoxTree& tree_;
  const std::vector<Node>& nodes_;
};

/// Sorts pairs by counting: first into lots by ranges of their first item, then each lot by first
/// item, and the few seconds of each. All of it in pieces that do not depend on the team.
class PairSorter {
 public:
  static constexpr std::size_t kPairsPerPiece = 65536;

  /// All first items are below `items`.
  PairSorter(std::vector<IndexPair>& pairs, std::size_t items)
      : pairs_(pairs),
        range_(items / kLots + 1),
        pieces_((pairs.size() + kPairsPerPiece - 1) / kPairsPerPiece) {}

  Status run(const parallel::Context& context) {
    auto counts = parallel::transform(context, {.name = "count pairs", .n = pieces_},
                                      [&](std::size_t piece) { return count(piece); });
    if (!counts) return counts.error();
    // Where each piece's pairs of each lot go: lot by lot, piece by piece.
    std::size_t at = 0;
    for (std::size_t lot = 0; lot < kLots; ++lot) {
      begin_[lot] = at;
      for (std::array<std::size_t, kLots>& of : *counts) at += std::exchange(of[lot], at);
    }
    begin_[kLots] = at;
    sorted_.resize(pairs_.size());
    Status status = parallel::for_each(context, {.name = "deal pairs", .n = pieces_},
                                       [&](std::size_t piece) { deal(piece, (*counts)[piece]); });
    if (!status) return status;
    return parallel::for_each(context, {.name = "sort pairs", .n = kLots},
                              [&](std::size_t lot) { sort(lot); });
  }

 private:
  static constexpr std::size_t kLots = 64;

  [[nodiscard]] std::span<const IndexPair> piece(std::size_t number) const {
    const std::size_t first = number * kPairsPerPiece;
    return std::span<const IndexPair>(pairs_).subspan(
        first, std::min(kPairsPerPiece, pairs_.size() - first));
  }
  [[nodiscard]] std::array<std::size_t, kLots> count(std::size_t number) const {
    std::array<std::size_t, kLots> counts{};
    for (const IndexPair& p : piece(number)) ++counts[p.first / range_];
    return counts;
  }
  void deal(std::size_t number, std::array<std::size_t, kLots>& next) {
    for (const IndexPair& p : piece(number)) sorted_[next[p.first / range_]++] = p;
  }
  /// Back from sorted_ into pairs_.
  void sort(std::size_t lot) {
    const std::size_t base = lot * range_, first = begin_[lot];
    const auto from = std::span(sorted_).subspan(first, begin_[lot + 1] - first);
    std::vector<std::size_t> begin(range_ + 1, first);
    for (const IndexPair& p : from) ++begin[p.first - base + 1];
    for (std::size_t i = 1; i <= range_; ++i) begin[i] += begin[i - 1] - first;
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const IndexPair& p : from) pairs_[next[p.first - base]++] = p;
    const auto at = [&](std::size_t k) { return pairs_.begin() + static_cast<std::ptrdiff_t>(k); };
    for (std::size_t i = 0; i < range_; ++i) std::sort(at(begin[i]), at(begin[i + 1]));
  }

  std::vector<IndexPair>& pairs_;
  std::vector<IndexPair> sorted_;
  std::size_t range_;  ///< first items of a lot
  std::size_t pieces_;
  std::array<std::size_t, kLots + 1> begin_{};  ///< of the lots
};

}  // namespace

Error too_many(const parallel::Allowance& allowed) {
  return {ErrorCode::input,
          "more than " + std::to_string(allowed.most()) + " pairs of boxes meet",
          {},
          "take fewer objects at one place, or a smaller reach"};
}

Status sort_pairs(std::vector<IndexPair>& pairs, const parallel::Context& context) {
  constexpr std::size_t kFew = 1024;
  if (pairs.size() <= kFew) {
    std::sort(pairs.begin(), pairs.end());
    return {};
  }
  const auto last = parallel::reduce(
      context, {.name = "last pair", .n = pairs.size(), .grain = PairSorter::kPairsPerPiece},
      std::uint32_t{0},
      [&](std::uint32_t& partial, std::size_t i) { partial = std::max(partial, pairs[i].first); },
      [](std::uint32_t& into, std::uint32_t partial) { into = std::max(into, partial); });
  if (!last) return last.error();
  return PairSorter(pairs, std::size_t{*last} + 1).run(context);
}

Result<std::vector<IndexPair>> meeting_pairs(const BoxTree& tree, const parallel::Context& context,
                                             std::uint64_t most) {
  parallel::Allowance allowance(most);
  const SelfJoin join(tree);
  const std::vector<NodePair> tasks = join.subtasks();
  auto pairs = parallel::collect_with<IndexPair>(
      context, {.name = "broad phase", .n = tasks.size()}, [] { return std::vector<NodePair>(); },
      [&](std::vector<NodePair>& stack, std::size_t i, std::vector<IndexPair>& out) -> Status {
        if (join.run(tasks[i], stack, out, allowance)) return {};
        return too_many(allowance);
      });
  if (!pairs) return pairs.error();
  if (const Status s = sort_pairs(*pairs, context); !s) return s.error();
  return pairs;
}

Result<std::vector<IndexPair>> meeting_pairs_all(std::span<const BoxItem> items,
                                                 const parallel::Context& context,
                                                 std::uint64_t most) {
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    return items[a].box.meets(items[b].box);
  };
  return all_pairs_that(items, meet, context, most);
}

}  // namespace strake::geometry
