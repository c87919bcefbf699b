// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
  /// So many objects have one hash of `ranges`. One that changes has all of them signed again,
  /// which takes 0.2 ms.
  static constexpr std::size_t kObjectsPerRange = 4096;

  Hash128 rules;  ///< of options, rules and the program's version: what is said of no single object
  /// Hashes of each object: its bodies on the grid, and what sets and rules say of it; not its file
  /// label and id, which tell whose signature it is. Equal signatures of two runs say nothing where
  /// their `rules` differ.
  std::vector<Hash128> objects;
  /// Of kObjectsPerRange objects each, all that their signatures were made from; none where not all
  /// of it was known of the model.
  std::vector<Hash128> ranges = {};
};

/// A hash of some bodies of a model: of those from `first` on, up to the next.
struct HashedBodies {
  std::uint32_t first = 0;
  Hash128 hash;
};

/// What somebody knows of a model without looking at all of it: hashes that are equal only where
/// what they are of is.
struct KnownModel {
  /// Hashes of each shape, so that meshes are not hashed again; zeros for one that is not known.
  /// Runs with and without them have other signatures.
  std::span<const Hash128> shapes = {};
  /// Hashes of all bodies, with the numbers of the shapes that they refer to, ascending.
  std::span<const HashedBodies> bodies = {};
  /// The hash of all that objects are but their bodies, in their order; zeros: not known.
  Hash128 objects = {};
};

/// The signatures of an earlier run of the test.
struct EarlierSignatures {
  std::span<const Hash128> objects = {}, ranges = {};  ///< as in Signatures
};

/// Returns the signatures of one test. The numbers of objects, shapes and labels do not show in
/// them; what stays the same of a label is its name (SameLabel::names), without which another first
/// object of a label changes all that carry it.
///
/// Where all of `known` is there, objects are looked at only where their numbers, places or source
/// differ from those of `earlier`: a pass over the scene's bodies says where.
///
/// Errors: those of detect() for its inputs; usage for another number of hashes than of shapes;
/// cancelled.
[[nodiscard]] Result<Signatures> signatures(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            const parallel::Context& context,
                                            const KnownModel& known = {},
                                            const EarlierSignatures& earlier = {});

/// Returns a hash of all that a test asks of the objects of a scene by their numbers. Two tests of
/// equal scenes with equal ones have equal signatures, which then need not be made again; equal
/// signatures may have other ones.
[[nodiscard]] Hash128 hash_of_inputs(const model::Scene& scene, const Sets& sets,
                                     const Options& options, const Policy& policy);

/// Which objects the results of a report are of, block by block: by it the results of few objects
/// are found without a look at all.
struct PartnerBlocks {
  static constexpr std::uint32_t kObjects = 1024;  ///< in a block, by their numbers
  /// Of each block, as the a of results, the blocks of their b, ascending, each below of.size().
  std::vector<std::vector<std::uint32_t>> of;
};

/// Returns the blocks of the b of some results, ascending.
[[nodiscard]] std::vector<std::uint32_t> partners_of(std::span<const Pair> pairs);

/// A run whose rules had the same signature, as detect() or detect_changes() reported it: nothing
/// may have been taken out of the report since. With KeptForChanges all its numbers are within the
/// lists that they refer to.
struct EarlierRun {
  Report report;
  /// For each object of that run, its number now; model::kNoObject where there is none with the
  /// same identity and signature. Files may have other labels.
  std::span<const std::uint32_t> now;
  /// The caller knows that there are as many objects now, each with the id that the one of its
  /// number had, ordered by the labels of their files, which may be other ones than they were, but
  /// no two of them one: then ids need not be read again.
  bool same_ids = false;
  /// Of the report; null: not known, so that all of its results are looked at.
  const PartnerBlocks* partners = nullptr;
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
/// 3. The cost is that of the changed pairs and one pass over the bodies, without
///    EarlierRun::partners one over the pairs of the report; where nothing changed it is none.
///
/// Errors: those of detect(); usage for a mapping or a report that does not fit.
[[nodiscard]] Result<Report> detect_changes(const model::Scene& scene, const Sets& sets,
                                            const Options& options, const Policy& policy,
                                            EarlierRun earlier, const parallel::Context& context);

/// Which results of a run are not those of the run before it. All others are the same, bit for bit
/// and in the same order, but for where their regions lie.
struct PairChanges {
  std::vector<Pair> gone;              ///< results that were taken out, by (a, b)
  std::vector<std::size_t> gone_from;  ///< their numbers in the earlier report
  std::vector<std::size_t> put_in;     ///< the numbers that those put in have now
};

/// A report that follows changes, and what it is to be compared with.
struct FollowedRun {
  Report report;
  /// The earlier report; where `changes` are there, without pairs, regions and what it kept.
  Report earlier;
  /// Nothing where the run was a full one, or where objects have other numbers than before.
  std::optional<PairChanges> changes;
};

/// Returns the report that detect_changes() returns, for a caller that compares the two runs: of a
/// small change it need not look at all results. Errors: those of detect_changes().
[[nodiscard]] Result<FollowedRun> follow_changes(const model::Scene& scene, const Sets& sets,
                                                 const Options& options, const Policy& policy,
                                                 EarlierRun earlier,
                                                 const parallel::Context& context);

}  // namespace strake::clash
