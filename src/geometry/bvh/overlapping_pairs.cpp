// SPDX-License-Identifier: Apache-2.0
#include "geometry/bvh/overlapping_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "geometry/bvh/tree_join.hpp"
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {
namespace {

/// Sorts pairs by counting: first into lots by ranges of their first item, then each lot by first
/// item, and the few seconds of each. All blocks are independent of the team.
class PairSorter {
 public:
  // Only shares the work out: between 16'384 and 262'144 no difference can be seen (decision 0073).
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
    // Compute where each block's pairs of each lot go: lot by lot, block by block.
    std::size_t at = 0;
    for (std::size_t lot = 0; lot < kLots; ++lot) {
      begin_[lot] = at;
      for (std::array<std::size_t, kLots>& of : *counts) at += std::exchange(of[lot], at);
    }
    begin_[kLots] = at;
    auto sorted = parallel::unset_slots<IndexPair>(pairs_.size(), context);
    if (!sorted) return sorted.error();
    sorted_ = std::move(*sorted);
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
  /// Sorts a lot from sorted_ back into pairs_.
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
          "more than " + std::to_string(allowed.limit()) + " pairs of boxes meet",
          {},
          "take fewer objects at one place, or a smaller reach"};
}

Status sort_pairs(std::vector<IndexPair>& pairs, const parallel::Context& context) {
  // Between 256 and 4096 ships show no difference (decision 0073).
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

namespace {

/// Pairs of boxes along the axes of one tree.
struct WithinTree {
  const SceneBvh& tree;

  static bool nodes_meet(const SceneBvh::Node& x, const SceneBvh::Node& y) {
    return x.box.meets(y.box);
  }
  [[nodiscard]] bool items_meet(std::uint32_t i, std::uint32_t j) const {
    return tree.items()[i].box.meets(tree.items()[j].box);
  }
  [[nodiscard]] IndexPair numbers(std::uint32_t i, std::uint32_t j) const {
    return {tree.order()[i], tree.order()[j]};
  }
};

}  // namespace

Result<std::vector<IndexPair>> overlapping_box_pairs(const SceneBvh& tree,
                                                     const parallel::Context& context,
                                                     std::uint64_t limit) {
  parallel::Allowance allowance(limit);
  const WithinTree rule{tree};
  auto pairs = TreeJoin(tree, tree, rule).run("broad phase", context, allowance);
  if (!pairs) return pairs.error();
  if (const Status s = sort_pairs(*pairs, context); !s) return s.error();
  return pairs;
}

Result<std::vector<IndexPair>> overlapping_box_pairs_brute_force(std::span<const BoxItem> items,
                                                                 const parallel::Context& context,
                                                                 std::uint64_t limit) {
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    return items[a].box.meets(items[b].box);
  };
  return all_pairs_that(items, meet, context, limit);
}

namespace {

/// Two frames, with the separating-axis tests for boxes in the one against boxes in the other.
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
  /// Relative rounding error of a width.
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

  /// Whether the cross product of an edge of each separates them. Where these are parallel every
  /// width is rounding.
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
  SceneBvh tree = {};
};

/// Pairs of two groups, or those within one.
class BetweenFrames {
 public:
  using Node = SceneBvh::Node;

  BetweenFrames(std::span<const BoxItem> items, const BoxesInFrames& framed,
                const std::vector<Group>& groups, std::size_t x, std::size_t y)
      : items_(items),
        x_(groups[x]),
        y_(groups[y]),
        frames_(framed.frames[x], framed.frames[y]),
        within_(x == y) {}

  /// Boxes of one tree compare as they are.
  [[nodiscard]] bool nodes_meet(const Node& x, const Node& y) const {
    return within_ ? x.box.meets(y.box) : !frames_.parted(x_.tree.box(x), y_.tree.box(y));
  }
  [[nodiscard]] bool items_meet(std::uint32_t i, std::uint32_t j) const {
    const IndexPair of = numbers(i, j);
    return items_[of.first].box.meets(items_[of.second].box) &&
           !frames_.parted(x_.tree.items()[i].box, y_.tree.items()[j].box);
  }
  [[nodiscard]] IndexPair numbers(std::uint32_t i, std::uint32_t j) const {
    return {x_.items[x_.tree.order()[i]], y_.items[y_.tree.order()[j]]};
  }

 private:
  std::span<const BoxItem> items_;
  const Group &x_, &y_;
  FramePair frames_;
  bool within_;
};

Result<std::vector<Group>> group_by_frame(std::span<const BoxItem> items,
                                          const BoxesInFrames& framed,
                                          const parallel::Context& context) {
  std::vector<Group> groups(framed.frames.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) groups[framed.frame[i]].items.push_back(i);
  for (Group& group : groups) {
    std::vector<BoxItem> in_frame;
    in_frame.reserve(group.items.size());
    for (const std::uint32_t i : group.items)
      in_frame.push_back({items[i].box.empty() ? empty_box<std::int64_t>() : framed.box[i],
                          items[i].owner, items[i].sets});
    auto tree = SceneBvh::build(in_frame, context);
    if (!tree) return tree.error();
    group.tree = std::move(*tree);
  }
  return groups;
}

}  // namespace

Result<std::vector<IndexPair>> overlapping_box_pairs(std::span<const BoxItem> items,
                                                     const BoxesInFrames& framed,
                                                     const parallel::Context& context,
                                                     std::uint64_t limit) {
  const auto groups = group_by_frame(items, framed, context);
  if (!groups) return groups.error();
  parallel::Allowance allowance(limit);
  std::vector<IndexPair> pairs;
  for (std::size_t x = 0; x < groups->size(); ++x)
    for (std::size_t y = x; y < groups->size(); ++y) {
      const BetweenFrames rule(items, framed, *groups, x, y);
      const auto found = TreeJoin((*groups)[x].tree, (*groups)[y].tree, rule)
                             .run("broad phase, askew", context, allowance);
      if (!found) return found.error();
      pairs.insert(pairs.end(), found->begin(), found->end());
    }
  if (const Status s = sort_pairs(pairs, context); !s) return s.error();
  return pairs;
}

Result<std::vector<IndexPair>> overlapping_box_pairs_brute_force(std::span<const BoxItem> items,
                                                                 const BoxesInFrames& framed,
                                                                 const parallel::Context& context,
                                                                 std::uint64_t limit) {
  const std::size_t n = framed.frames.size();
  std::vector<FramePair> frames;
  for (const Mat3d& x : framed.frames)
    for (const Mat3d& y : framed.frames) frames.emplace_back(x, y);
  // The lower frame comes first, as between groups, so that rounding gives the same result.
  const auto parted = [&](std::uint32_t a, std::uint32_t b) {
    return frames[framed.frame[a] * n + framed.frame[b]].parted(framed.box[a], framed.box[b]);
  };
  const auto meet = [&](std::uint32_t a, std::uint32_t b) {
    return items[a].box.meets(items[b].box) &&
           !(framed.frame[a] <= framed.frame[b] ? parted(a, b) : parted(b, a));
  };
  return all_pairs_that(items, meet, context, limit);
}

}  // namespace strake::geometry
