// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/clash/pair.hpp"
#include "strake/core/hash.hpp"
#include "strake/model/model.hpp"

/// What a run keeps for detect_changes(): where a pair leaves nothing in the report but a count,
/// the pair itself, so that the count can follow when the pair is gone.
namespace strake::clash {

/// A pair that went on to the narrow phase, and a rule about allowed results that concerns it.
struct ConcernedPair {
  model::ObjectId a{}, b{};
  std::uint32_t rule = 0;  ///< index into Report::allowed
};

/// The regions of a pair that a rule allows though none allows the pair (AllowedCount::regions).
struct AllowedRegionCount {
  model::ObjectId a{}, b{};
  std::uint32_t rule = 0;  ///< index into Report::allowed
  std::uint32_t regions = 0;
};

/// A result that is not reported (Report::not_reported).
struct UnreportedPair {
  model::ObjectId a{}, b{};
  Class cls = Class::no_hit;
  bool allowed = false;    ///< a rule allows it: it counts for that, whatever its class
  bool by_volume = false;  ///< otherwise by its relation
};

/// A contact that is counted and not listed (Report::unlisted).
struct UnlistedContact {
  model::ObjectId a{}, b{};
  std::int32_t allowed = -1;  ///< as in Pair
  Hash128 hash;               ///< its share in KeptForChanges::hash_sum
};

/// All lists are by (a, b).
struct KeptForChanges {
  /// No fewer pairs of boxes than the run found, before any rule.
  std::uint64_t box_pairs = 0;
  /// Boxes along the faces of parts decided which pairs are within reach (decision 0041). That
  /// depends on all parts, so such a run is followed by a full one.
  bool framed = false;
  Hash128 hash_sum;                     ///< the sum, word by word, of the hashes of all pairs
  std::vector<std::uint64_t> elements;  ///< of each object: the hash of its file label and id
  std::vector<ExemptedPair> exempted;   ///< empty where Report::exempted_pairs has them
  std::vector<ConcernedPair> concerned;
  std::vector<AllowedRegionCount> allowed_regions;
  std::vector<UnreportedPair> unreported;
  std::vector<UnlistedContact> unlisted;
  std::vector<Pair> allowed_contacts;  ///< those of `unlisted` that a rule allows
};

}  // namespace strake::clash
