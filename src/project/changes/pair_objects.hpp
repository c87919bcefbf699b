// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "project/changes/fingerprints.hpp"
#include "strake/model/model.hpp"
#include "strake/report/file_match.hpp"

namespace strake::project {

/// A model and what its objects are.
struct PrintedModel {
  const model::Model& model;
  std::span<const Fingerprint> prints;
};

/// No object of the other model.
inline constexpr std::uint32_t kNoPartner = 0xffffffffU;

/// Which object of one model is which of the other.
struct ObjectPairs {
  std::vector<std::uint32_t> of_then, of_now;  ///< partners, an entry for each object
};

/// Pairs the objects of files that are matched: by lasting ids, then by shapes and places, then by
/// ids that only count. Files that are matched as a whole go before parts of files.
[[nodiscard]] ObjectPairs pair_objects(const PrintedModel& then, const PrintedModel& now,
                                       const report::FileMatches& files);

}  // namespace strake::project
