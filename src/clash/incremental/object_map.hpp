// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/clash/incremental.hpp"
#include "strake/core/result.hpp"

namespace strake::clash {

/// Which object of one run is which of another. Objects that are unchanged are in the same order in
/// both, so that their pairs are, too: of those that changed places as few as can be count as
/// changed.
struct ObjectMap {
  std::vector<std::uint32_t> now;     ///< by object before; model::kNoObject
  std::vector<std::uint32_t> before;  ///< by object now; model::kNoObject
  std::size_t changed = 0;            ///< objects now that were not there, or not so
  bool renumbered = false;            ///< an unchanged object has another number

  /// Counts an unchanged object as changed; `object` is its number before.
  void count_as_changed(std::uint32_t object);

  /// Whether all objects are there, unchanged.
  [[nodiscard]] bool is_identity() const {
    return changed == 0 && !renumbered && now.size() == before.size();
  }
};

/// Returns the map of EarlierRun::now to so many objects. Errors: usage where numbers are beyond
/// them or repeated.
[[nodiscard]] Result<ObjectMap> map_objects(std::span<const std::uint32_t> now,
                                            std::size_t objects);

}  // namespace strake::clash
