// SPDX-License-Identifier: Apache-2.0
// The index that finds candidates for coincident lines, and the removal of lines with equal ends.
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

/// Removes from `keys` each line that can be covered and coincides with a line of the same ends and
/// reach that stays, and marks it in `gone`, by line. Such lines have equal keys and stand
/// together.
///
/// Most lines of a plan are removed here: what stands on the deck has its edges exactly above each
/// other.
[[nodiscard]] Status remove_coincident(std::vector<KeyedItem>& keys,
                                       std::span<const PlaneSegment> lines, const OverlapRule& rule,
                                       parallel::Marks& gone, const parallel::Context& context);

/// An index of lines in a plane that finds the pairs that may lie on each other.
///
/// Two lines lie on each other only if the sine of their angle is at most twice their distance over
/// the shorter one's length. So lines are divided into classes by length, those of a class into
/// sectors by direction, the finer the longer they are, and those of a sector form a tree of boxes
/// whose axes run along and across the lines, so that boxes of parallel lines beside each other do
/// not meet.
///
/// Leaves hold eight lines, nodes eight nodes, whose boxes are tested side by side. Lines of a
/// sector are in Z-order (G. M. Morton 1966) of their middles, with the distance across weighted by
/// how fine the sectors are.
class LineIndex {
 public:
  /// Builds the index. Lines of rank none, those no longer than the rule's least, and those marked
  /// in `gone` are left out; pairs at a greater angle may be left out, too. A line that a
  /// coincident one with the same ends covers is left out and marked in `gone`: that one covers
  /// whatever the line does. The result does not depend on the team.
  [[nodiscard]] static Result<LineIndex> build(std::span<const PlaneSegment> lines,
                                               const OverlapRule& rule, parallel::Marks& gone,
                                               const parallel::Context& context);

  static constexpr std::size_t kFan = BoxLanes::kCount;
  static constexpr unsigned kClasses = 4;

  /// The axes of a sector: along a direction and across it.
  struct SectorAxes {
    double x = 1, y = 0;
    [[nodiscard]] double along(double px, double py) const { return px * x + py * y; }
    [[nodiscard]] double across(double px, double py) const { return py * x - px * y; }
  };
  struct Sector {
    unsigned length_class = 0;
    std::uint32_t first = 0, last = 0;  ///< positions of its lines
    std::size_t nodes = 0;              ///< its first node: leaves first, then upper levels
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

  /// Return the number of the line at a position, and a copy of the line, stored beside its
  /// neighbours.
  [[nodiscard]] std::uint32_t line(std::uint32_t position) const { return order_[position]; }
  [[nodiscard]] const PlaneSegment& flat(std::uint32_t position) const { return flats_[position]; }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] const Sector& sector(std::uint32_t number) const { return sectors_[number]; }

  /// Calls visit(line of the leaf, counted from its first; position of the other line) for every
  /// pair that may lie on each other. The other lines are of one class of lengths, the leaf's own
  /// or a lower one. Where visit returns false that line of the leaf is done with this class.
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
    double from = 2, to = 0;  ///< range of their directions, see slant()
    Box2 box;                 ///< box of the lines in their sector's axes
  };
  /// The lines of a leaf in the axes of the queried sector.
  struct Query {
    Query(const LineIndex& index, const Target& target, std::uint32_t number);
    /// Returns the bits of the boxes of a node that no axis of the sector or of the leaf separates
    /// from the box of all lines of the leaf.
    [[nodiscard]] unsigned meeting(const BoxLanes& node) const {
      const unsigned found = node.meeting(all);
      return found != 0 && turned ? found & node.meeting(own) : found;
    }
    const Sector* sector;
    BoxLanes lines;
    Box2 all;
    bool turned;     ///< the leaf's axes differ from the sector's
    TurnedBox2 own;  ///< the box of all lines in the leaf's axes
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
  [[nodiscard]] Status lay_out_sectors();
  [[nodiscard]] Status make_leaves(const parallel::Context& context);
  [[nodiscard]] Status make_nodes(const parallel::Context& context);

  template <class Visit>
  void descend(const Query& query, unsigned& open, Visit&& visit) const;

  double reach_ = 0;      ///< the largest distance of two coincident lines
  double x_ = 0, y_ = 0;  ///< centre of all lines
  double greatest_sine_ = 1;
  double radius_ = 0;  ///< radius of a circle about the centre that holds all lines
  double pad_ = 0;     ///< margin for rounding, and the reach
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
