// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "hlr/frame.hpp"

namespace strake::hlr {

/// One side of a grid over the paper.
struct BucketAxis {
  double lo = 0, hi = 0, size = 1;  ///< of a bucket
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

/// The edges that go through a grid.
struct EdgeLengths {
  double count = 0;
  double sum = 0;  ///< of the longer of |u| and |v|
};

/// What a grid over some boxes comes to, by the number of its buckets.
class BucketPlan {
 public:
  BucketPlan() = default;
  explicit BucketPlan(std::span<const ViewBox> boxes);

  /// Empty ones are left out.
  void add(const ViewBox& box);
  /// The boxes of another.
  void add(const BucketPlan& more);

  /// How many buckets along the longer side some edges walk with the least cost: in boxes looked
  /// at, when all buckets are alike. Where there are no edges, others' may come that are about as
  /// long as the boxes. A power of two for which buckets and entries are not more than eight times
  /// the boxes. The source thesis asks for such a choice and has none.
  [[nodiscard]] std::uint32_t best_side(const EdgeLengths& own) const;

  /// A grid of about square buckets, `side` of them along the longer side: fewer where all of them
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
  double count_ = 0, sides_sum_ = 0, area_ = 0;  ///< of the boxes
};

}  // namespace strake::hlr
