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
  Hash128 rules;  ///< of options, rules and the program's version: what is said of no single object
  /// Of each object: its bodies on the grid, and what sets and rules say of it; not its file label
  /// and id, which tell whose signature it is. Equal signatures of two runs say nothing where their
  /// `rules` differ.
  std::vector<Hash128> objects;
};

/// Returns the signatures of one test. The numbers of objects, shapes and labels do not show in
/// them; what stays the same of a label is its name (SameLabel::names), without which another first
/// object of a label changes all that carry it.
///
/// `shape_hashes` are those that somebody has of the model's shapes, so that meshes are not hashed
/// again: equal ones stand for equal shapes, zeros for one that is not known. Runs with and without
/// them have other signatures. Errors: those of detect() for its inputs; usage for another number
/// of hashes than of shapes; cancelled.
[[nodiscard]] Result<Signatures> signatures(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            const parallel::Context& context,
                                            std::span<const Hash128> shape_hashes = {});

/// A run whose rules had the same signature, as detect() or detect_changes() reported it: nothing
/// may have been taken out of the report since. With KeptForChanges all its numbers are within the
/// lists that they refer to.
struct EarlierRun {
  Report report;
  /// For each object of that run, its number now; model::kNoObject where there is none with the
  /// same identity and signature. Files may have other labels.
  std::span<const std::uint32_t> now;
};

/// Whether all objects of an earlier run, which has KeptForChanges, have the file labels and ids of
/// these, in their order. Errors: cancelled.
[[nodiscard]] Result<bool> have_same_names(const Report& earlier, const model::Model& model,
                                           const parallel::Context& context);

/// Returns the report that detect() returns, but evaluates only pairs of objects that changed,
/// where both runs have EngineOptions::keep_for_changes.
///
/// 1. All but Report::counters and Report::log is equal bit for bit; these tell what this run did.
///    KeptForChanges::box_pairs may be more than a full run counts.
/// 2. Where very many pairs are near each other, or a quarter of the objects changed, it is a full
///    run.
/// 3. The cost is that of the changed pairs, one pass over the bodies and one over the pairs of the
///    report; where nothing changed it is none.
///
/// Errors: those of detect(); usage for a mapping or a report that does not fit.
[[nodiscard]] Result<Report> detect_changes(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            EarlierRun earlier, const parallel::Context& context);

}  // namespace strake::clash
