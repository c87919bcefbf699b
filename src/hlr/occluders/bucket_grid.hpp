// SPDX-License-Identifier: Apache-2.0
// Grids over the paper, the buckets of the source thesis, and the choice of their size.
#pragma once

// Decision 0029 says why parts have buckets, and how many.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// One side of a grid over the paper.
struct BucketAxis {
  double lo = 0, hi = 0, size = 1;  ///< size: of a bucket
  std::uint32_t count = 1;

  // Monotone, so that the cell of a point is between those of the ends of a box that holds it.
  [[nodiscard]] std::uint32_t cell(double x) const {
    const double at = (x - lo) / size;
    return at > 0 ? static_cast<std::uint32_t>(std::min<double>(at, count - 1)) : 0;
  }
};

struct BucketAxes {
  BucketAxis u, v;
};

/// Number and length of the edges that are looked up in a grid.
struct EdgeLengths {
  double count = 0;
  double sum = 0;  ///< sum of the longer of |u| and |v|
};

/// The cost of a grid over some boxes, as a function of the number of its buckets.
class BucketPlan {
 public:
  BucketPlan() = default;
  explicit BucketPlan(std::span<const ViewBox> boxes);

  /// Adds a box, unless it is empty.
  void add(const ViewBox& box);
  /// Adds the boxes of another plan.
  void add(const BucketPlan& more);

  /// Returns how many buckets along the longer side give the least cost for some edges: in boxes
  /// examined, when all buckets are alike. Where there are no edges, edges about as long as the
  /// boxes are assumed. The result is a power of two for which buckets and entries are not more
  /// than eight times the boxes. The source thesis requests such a choice and has none.
  [[nodiscard]] std::uint32_t best_side(const EdgeLengths& own) const;

  /// Returns a grid of about square buckets, `side` of them along the longer side: fewer where they
  /// would list much more than there is.
  [[nodiscard]] BucketAxes axes(std::uint32_t side) const;

 private:
  struct Sides {
    double u = 1, v = 1;  ///< buckets
  };
  [[nodiscard]] double width() const;
  [[nodiscard]] double height() const;
  [[nodiscard]] double longest() const { return std::max(width(), height()); }
  [[nodiscard]] Sides sides(std::uint32_t side) const;
  [[nodiscard]] double buckets(std::uint32_t side) const;
  [[nodiscard]] double entries(std::uint32_t side) const;
  [[nodiscard]] bool fits(std::uint32_t side, double per_box) const;

  ViewBox extent_;
  double count_ = 0, sides_sum_ = 0, area_ = 0;  ///< sums over the boxes
};

/// Marks of the items that a traversal has met already, for one worker; it keeps its memory.
class BucketMarks {
 public:
  void begin(std::size_t items) {
    if (marks_.size() < items) marks_.resize(items, 0);
    if (++visit_number_ != 0) return;
    std::ranges::fill(marks_, 0U);
    visit_number_ = 1;
  }
  /// Returns whether an item is met for the first time in this traversal.
  bool first(std::uint32_t item) {
    return std::exchange(marks_[item], visit_number_) != visit_number_;
  }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t visit_number_ = 0;
};

/// A grid over the paper whose cells list the boxes that reach into them, the nearest first: the
/// buckets of the source thesis.
class BucketGrid {
 public:
  BucketGrid() = default;
  /// Builds the grid; empty boxes are left out. Errors: cancelled.
  [[nodiscard]] static Result<BucketGrid> of(std::span<const ViewBox> boxes, const BucketAxes& axes,
                                             const parallel::Context& context);

  [[nodiscard]] bool empty() const { return first_.empty(); }
  /// Returns how many entries the bucket of an entry has in the mean: what a traversal examines
  /// there.
  [[nodiscard]] double crowding() const;

  /// Calls visit(index) -> bool once for every box that may hide the segment, bucket by bucket;
  /// visit ends the traversal by returning false.
  template <class Visit>
  void traverse(SegmentQuery segment, BucketMarks& marks, Visit&& visit) const {
    marks.begin(items_);
    // open_box() is up to a unit shorter than the segment, which may cross a side of buckets there.
    segment.u0 -= 1;
    segment.u1 += 1;
    segment.v0 -= 1;
    segment.v1 += 1;
    const bool steep = std::abs(segment.dv) > std::abs(segment.du);
    const BucketAxis& along = steep ? axes_.v : axes_.u;
    const std::uint32_t last = along.cell(steep ? segment.v1 : segment.u1);
    for (std::uint32_t i = along.cell(steep ? segment.v0 : segment.u0); i <= last; ++i) {
      const Cells cells = across(segment, steep, i);
      for (std::uint32_t j = cells.from; j <= cells.to; ++j) {
        const auto [u, v] = steep ? std::pair{j, i} : std::pair{i, j};
        const std::size_t bucket = std::size_t{v} * axes_.u.count + u;
        if (!visit_bucket(bucket, segment.w0, marks, visit)) return;
      }
    }
  }

 private:
  struct Cells {
    std::uint32_t from = 0, to = 0;
  };
  struct Entry {
    std::uint32_t item = 0;
    float nearest = 0;  ///< the box's greatest w, rounded up
  };
  class Dealer;

  // The cells across, where the segment is in row or column i.
  [[nodiscard]] Cells across(const SegmentQuery& s, bool steep, std::uint32_t i) const;

  template <class Visit>
  bool visit_bucket(std::size_t bucket, double depth, BucketMarks& marks, Visit& visit) const {
    for (std::uint32_t k = first_[bucket]; k < first_[bucket + 1]; ++k) {
      const Entry& entry = entries_[k];
      if (static_cast<double>(entry.nearest) <= depth) return true;
      if (marks.first(entry.item) && !visit(entry.item)) return false;
    }
    return true;
  }

  BucketAxes axes_;
  std::size_t items_ = 0;
  std::vector<std::uint32_t> first_;  ///< first entry by bucket, row by row, and the end
  std::vector<Entry> entries_;
};

}  // namespace strake::hlr
