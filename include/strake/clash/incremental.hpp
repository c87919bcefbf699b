// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// Clash detection that follows what changed since an earlier run.
namespace strake::clash {

/// Hashes of all that detect() sees. Two runs agree on a pair where `rules` and the signatures of
/// its two objects are equal.
struct Signatures {
  Hash128 rules;                 ///< of the options, and of what rules say of no single object
  std::vector<Hash128> objects;  ///< of each object: its bodies on the grid, sets, labels, levels
};

/// Returns the signatures of one test. The numbers of objects do not show in them. Errors:
/// cancelled.
[[nodiscard]] Result<Signatures> signatures(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            const parallel::Context& context);

/// An object that is gone, or has another signature now.
inline constexpr std::uint32_t kChanged = 0xffffffffU;

/// The report of an earlier run whose rules had the same signature.
struct EarlierRun {
  const Report* report = nullptr;
  /// For each object of that run, its number now; kChanged where there is none with the same
  /// identity and signature.
  std::span<const std::uint32_t> now;
};

/// Returns the report that detect() returns, but evaluates only pairs of objects that changed.
/// Errors: those of detect(); usage for a mapping that does not fit.
[[nodiscard]] Result<Report> detect_changes(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            const EarlierRun& earlier,
                                            const parallel::Context& context);

}  // namespace strake::clash
