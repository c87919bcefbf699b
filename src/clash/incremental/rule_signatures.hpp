// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "clash/results/result_hash.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/hash.hpp"
#include "strake/model/scene.hpp"

namespace strake::clash {

/// Returns the hash of all that a test asks of no single object: options, tolerances, rules by name
/// and limit, how the scene was tessellated, and the version of the program.
[[nodiscard]] Hash128 settings_signature(const model::Scene& scene, const Sets& sets,
                                         const Options& options, const Policy& policy);

/// What sets and rules say of each object, with numbers that a run chose for itself replaced by
/// names that stay the same.
class RuleSignatures {
 public:
  /// All arguments must outlive this.
  RuleSignatures(const Sets& sets, const Options& options, const Policy& policy,
                 const ElementHashes& elements);

  /// Adds what is said of one object.
  void add(std::uint32_t object, WordHash& hash) const;

 private:
  void add_linked(std::uint32_t object, const Linked& linked, const std::vector<Hash128>& names,
                  WordHash& hash) const;

  const Sets& sets_;
  const Policy& policy_;
  std::vector<const ObjectClearances*> clearances_;
  std::vector<Hash128> groups_;              ///< names of Sets::group
  std::vector<std::vector<Hash128>> names_;  ///< by exemption: those of its labels or numbers
};

}  // namespace strake::clash
