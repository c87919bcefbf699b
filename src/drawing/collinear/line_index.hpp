// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0025 says why lines are sought by length, direction and place.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drawing/collinear/box_lanes.hpp"
#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/collinear/radix_sort.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::drawing {

/// Takes out of `keys`, in which twins (lines with the same ends and reach) have equal keys and
/// stand together, each line that may go and has a twin that stays, and marks it in `gone`, by
/// line.
///
/// Most lines of a plan go here: what stands on the deck has its edges exactly above each other.
[[nodiscard]] Status remove_coincident(std::vector<KeyedItem>& keys,
                                       std::span<const PlaneSegment> lines, const OverlapRule& rule,
                                       parallel::Marks& gone, const parallel::Context& context);

/// Lines of a plane, sought by which may lie on each other.
///
/// Two lines lie on each other only if the sine of their angle is within twice their distance over
/// the shorter one's length. So lines are put into classes by their lengths, those of a class into
/// sectors by their directions, the finer the longer they are, and those of a sector into a tree of
/// boxes whose axes run along and across the lines: parallel lines beside each other do not meet.
///
/// Leaves hold eight lines, nodes eight nodes, whose boxes are tested side by side. The order
/// within a sector is that of a curve through the middles of the lines (Z-order, G. M. Morton
/// 1966), the distance across weighed by how fine the sectors are.
class LineIndex {
 public:
  /// Lines of rank none, those no longer than the rule's least, and those that are `gone`, by line,
  /// are left out, and so may be pairs at a greater angle. A line that a twin covers, one with the
  /// same ends, is left out too and marked in `gone`: the twin covers whatever the line does. The
  /// same for any team.
  [[nodiscard]] static Result<LineIndex> build(std::span<const PlaneSegment> lines,
                                               const OverlapRule& rule, parallel::Marks& gone,
                                               const parallel::Context& context);

  static constexpr std::size_t kFan = BoxLanes::kCount;
  static constexpr unsigned kClasses = 4;

  /// A direction, with how to turn into its axes.
  struct SectorAxes {
    double x = 1, y = 0;
    [[nodiscard]] double along(double px, double py) const { return px * x + py * y; }
    [[nodiscard]] double across(double px, double py) const { return py * x - px * y; }
  };
  struct Sector {
    unsigned length_class = 0;
    std::uint32_t first = 0, last = 0;  ///< of its lines, as positions
    std::size_t nodes = 0;              ///< its first node: the leaves, then what is above
    std::size_t leaf = 0;               ///< number of its first leaf among all
    SectorAxes frame;
  };

  /// Up to eight lines of a sector that lie near each other.
  struct Leaf {
    std::uint32_t sector = 0;
    std::uint32_t first = 0, last = 0;  ///< positions
  };
  [[nodiscard]] std::size_t leaves() const { return leaves_; }
  [[nodiscard]] Leaf leaf(std::size_t number) const;

  /// The line at a position: its number and a copy, beside those of its neighbours.
  [[nodiscard]] std::uint32_t line(std::uint32_t position) const { return order_[position]; }
  [[nodiscard]] const PlaneSegment& flat(std::uint32_t position) const { return flats_[position]; }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] const Sector& sector(std::uint32_t number) const { return sectors_[number]; }

  /// Calls visit(line of the leaf, counted from its first; other position) for every pair that may
  /// lie on each other, with the others of one class of lengths, the leaf's own or a lower one.
  /// Where it returns false that line of the leaf is done with this class.
  template <class Visit>
  void candidates(const Leaf& leaf, unsigned length_class, Visit&& visit) const {
    const Target target(*this, leaf);
    unsigned open = (1U << (leaf.last - leaf.first)) - 1;
    for (const std::uint32_t number : sectors_near(target, length_class))
      if (open != 0 && sectors_[number].first < sectors_[number].last) {
        const Query query(*this, target, number);
        descend(query, open, visit);
      }
  }

 private:
  /// The lines of a leaf.
  struct Target {
    Target(const LineIndex& index, const Leaf& leaf);
    Leaf leaf;
    double from = 2, to = 0;  ///< of their directions, see slant()
    Box2 box;                 ///< in their sector's axes
  };
  /// The same in the axes of the sector that is asked.
  struct Query {
    Query(const LineIndex& index, const Target& target, std::uint32_t number);
    /// The bits of those boxes of a node that no axis of the sector or of the leaf tells apart
    /// from the box of all its lines.
    [[nodiscard]] unsigned meeting(const BoxLanes& node) const {
      const unsigned found = node.meeting(all);
      return found != 0 && turned ? found & node.meeting(own) : found;
    }
    const Sector* sector;
    BoxLanes lines;
    Box2 all;
    bool turned;     ///< the leaf has other axes than the sector
    TurnedBox2 own;  ///< the box of all in these
  };
  /// Numbers of sectors, at most all.
  struct Numbers {
    std::array<std::uint32_t, 8> number{};
    std::size_t count = 0;
    [[nodiscard]] const std::uint32_t* begin() const { return number.data(); }
    [[nodiscard]] const std::uint32_t* end() const { return number.data() + count; }
  };

  [[nodiscard]] Numbers sectors_near(const Target& target, unsigned length_class) const;
  [[nodiscard]] Box2 box_of(const PlaneSegment& line, const SectorAxes& frame) const;
  [[nodiscard]] std::uint32_t sector_of(const PlaneSegment& line) const;
  [[nodiscard]] Status measure(std::span<const PlaneSegment> lines, double least,
                               const parallel::Context& context);
  void choose_frames(std::span<const PlaneSegment> lines, double least);
  [[nodiscard]] std::uint64_t key_of(const PlaneSegment& line) const;
  [[nodiscard]] Result<std::vector<KeyedItem>> sorted(std::span<const PlaneSegment> lines,
                                                      double least,
                                                      const parallel::Context& context) const;
  [[nodiscard]] Status take(std::span<const PlaneSegment> lines, std::span<const KeyedItem> keys,
                            const parallel::Context& context);
  void lay_out_sectors();
  [[nodiscard]] Status make_leaves(const parallel::Context& context);
  [[nodiscard]] Status make_nodes(const parallel::Context& context);

  template <class Visit>
  void descend(const Query& query, unsigned& open, Visit&& visit) const;

  double reach_ = 0;      ///< up to which two lines lie on each other, at most
  double x_ = 0, y_ = 0;  ///< middle of all
  double greatest_sine_ = 1;
  double radius_ = 0;  ///< round it
  double pad_ = 0;     ///< what rounding may take from a box, and the reach
  std::vector<Sector> sectors_;
  std::vector<std::uint32_t> order_;
  std::vector<PlaneSegment> flats_;
  std::vector<BoxLanes> nodes_;  ///< widened for rounding only
  std::size_t leaves_ = 0;
};

template <class Visit>
void LineIndex::descend(const Query& query, unsigned& open, Visit&& visit) const {
  struct Level {
    std::size_t base, count;
  };
  // Eight lines to a leaf and eight nodes to a node: 2^32 lines have 11 levels.
  std::array<Level, 12> levels{};
  std::size_t depth = 0, base = query.sector->nodes;
  std::size_t count = (query.sector->last - query.sector->first + kFan - 1) / kFan;
  for (;; count = (count + kFan - 1) / kFan) {
    levels[depth++] = {base, count};
    base += count;
    if (count == 1) break;
  }
  struct Step {
    std::size_t level, node;
  };
  std::array<Step, 12 * kFan> stack;  // NOLINT(*-member-init): filled as far as it is used
  std::size_t top = 0;
  stack[top++] = {depth - 1, 0};
  while (top > 0) {
    const auto [level, number] = stack[--top];
    const BoxLanes& node = nodes_[levels[level].base + number];
    for (unsigned found = query.meeting(node); found != 0; found &= found - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(found));
      const std::size_t child = number * kFan + k;
      if (level > 0) {
        stack[top++] = {level - 1, child};
        continue;
      }
      const auto other = static_cast<std::uint32_t>(query.sector->first + child);
      for (unsigned lines = query.lines.meeting(node[k]) & open; lines != 0; lines &= lines - 1) {
        const auto line = static_cast<std::size_t>(std::countr_zero(lines));
        if (!visit(line, other)) open &= ~(1U << line);
      }
      if (open == 0) return;
    }
  }
}

}  // namespace strake::drawing
