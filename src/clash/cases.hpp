// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "clash/parts.hpp"
#include "strake/geometry/bvh.hpp"
#include "strake/parallel/distinct.hpp"

namespace strake::clash {

/// Which pairs of parts are the same question: equal geometry in equal relative position, judged by
/// equal settings. A ship has its frames, brackets and pipe hangers a hundred thousand times over.
using Cases = parallel::Distinct;

/// Every pair a case of its own.
[[nodiscard]] Cases each_alone(std::size_t pairs);

/// What a pair is judged by, besides its parts.
struct CaseSettings {
  std::uint32_t tolerances = 0;
  double contact_distance = 0;
  double snap = 0;
  friend bool operator==(const CaseSettings&, const CaseSettings&) = default;
};

/// `settings`: one a pair. Errors: cancelled.
[[nodiscard]] Result<Cases> find_cases(std::span<const geometry::IndexPair> pairs,
                                       const PartList& list, std::span<const CaseSettings> settings,
                                       const parallel::Context& context);

}  // namespace strake::clash
