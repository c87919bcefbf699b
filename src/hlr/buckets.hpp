// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hlr/bucket_plan.hpp"
#include "hlr/frame.hpp"
#include "hlr/view_tree.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// What a walk over buckets has met already, for one worker; it keeps its memory.
class BucketMarks {
 public:
  void begin(std::size_t items) {
    if (marks_.size() < items) marks_.resize(items, 0);
    if (++walk_ != 0) return;
    std::ranges::fill(marks_, 0U);
    walk_ = 1;
  }
  /// Whether an item is met for the first time in this walk.
  bool first(std::uint32_t item) { return std::exchange(marks_[item], walk_) != walk_; }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t walk_ = 0;
};

/// A grid over the paper whose cells list the boxes that reach into them, the nearest first: the
/// buckets of the source thesis.
class Buckets {
 public:
  Buckets() = default;
  /// Empty boxes are left out. Errors: cancelled.
  [[nodiscard]] static Result<Buckets> of(std::span<const ViewBox> boxes, const BucketAxes& axes,
                                          const parallel::Context& context);

  [[nodiscard]] bool empty() const { return first_.empty(); }
  /// How many entries the bucket of an entry has in the mean: what a walk looks at there.
  [[nodiscard]] double crowding() const;

  /// Calls visit(index) -> bool once for every box that may hide the segment, bucket by bucket;
  /// visit ends the walk by returning false.
  template <class Visit>
  void walk(const LooseSegment& segment, BucketMarks& marks, Visit&& visit) const {
    marks.begin(items_);
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
    float nearest = 0;  ///< no less than the box's
  };
  class Dealer;

  // The cells across, where the segment is in row or column i.
  [[nodiscard]] Cells across(const LooseSegment& s, bool steep, std::uint32_t i) const;

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
  std::vector<std::uint32_t> first_;  ///< by bucket, row by row, and the end
  std::vector<Entry> entries_;
};

}  // namespace strake::hlr
