// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "clash/parts.hpp"

namespace strake::clash {

/// The pairs of objects behind pairs of parts, which stand side by side as near_pairs() lists them.
class ObjectPairs {
 public:
  ObjectPairs() = default;
  /// Errors: cancelled.
  [[nodiscard]] static Result<ObjectPairs> find(std::span<const geometry::IndexPair> pairs,
                                                const PartList& list,
                                                const parallel::Context& context);

  [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  /// The pairs of parts of the k-th pair of objects are [begin(k), end(k)).
  [[nodiscard]] std::size_t begin(std::size_t k) const { return begin_[k]; }
  [[nodiscard]] std::size_t end(std::size_t k) const { return begin_[k + 1]; }

 private:
  explicit ObjectPairs(std::vector<std::size_t> begin) : begin_(std::move(begin)) {}
  std::vector<std::size_t> begin_;  ///< and the number of pairs of parts
};

}  // namespace strake::clash
