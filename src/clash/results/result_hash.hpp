// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0070 says why the hash of a result is a sum over its pairs.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {

/// Hashes of objects by file label and durable id, quickly: the labels are hashed once.
class ElementHashes {
 public:
  /// The model must outlive this.
  explicit ElementHashes(const model::Model& model);

  [[nodiscard]] Hash128 of(std::uint32_t object) const;

 private:
  const model::Model& model_;
  std::vector<Hash128> labels_;
};

/// Returns the hash of one pair of a report: its objects, class, relation, d, witness, regions and
/// the rules that allow them. `a` and `b` are the low words of its objects' ElementHashes.
[[nodiscard]] Hash128 hash_of(const Pair& pair, const Report& report, std::uint64_t a,
                              std::uint64_t b);

/// Returns x + y and x - y, word by word: hashes of pairs are added up, so that those of pairs that
/// are gone can be taken off again.
[[nodiscard]] Hash128 sum(const Hash128& x, const Hash128& y);
[[nodiscard]] Hash128 difference(const Hash128& x, const Hash128& y);

/// Returns the sum of the hashes of all pairs of a report; `elements` are the low words of the
/// ElementHashes of its objects. Errors: cancelled.
[[nodiscard]] Result<Hash128> sum_of_hashes(const Report& report,
                                            std::span<const std::uint64_t> elements,
                                            const parallel::Context& context);

/// Returns the hexadecimal hash of a result from that sum, and the number of pairs in it.
[[nodiscard]] std::string result_hash(const Hash128& sum, std::uint64_t pairs);

}  // namespace strake::clash
