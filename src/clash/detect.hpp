// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"

namespace strake::clash {

/// What a run over changed objects is about.
struct ChangedObjects {
  std::span<const Change> change;         ///< an entry per object
  std::span<const std::uint32_t> tested;  ///< the objects that changed or are near, ascending
  std::uint64_t max_box_pairs = 0;        ///< more are too many for a run without the others
};

/// Returns an error where sets, options and rules do not fit a scene.
[[nodiscard]] Status check_inputs(const model::Scene& scene, const Sets& sets,
                                  const Options& options, const Policy& policy);

/// Returns the report of detect() about the pairs of which one object changed, and of it what is
/// about pairs: sets and disciplines are those of all objects, what is said of single objects is of
/// those asked about. Nothing where there are too many pairs. The inputs are checked already.
[[nodiscard]] Result<std::optional<Report>> detect_among(const model::Scene& scene,
                                                         const Sets& sets, const Options& options,
                                                         const Policy& policy,
                                                         const ChangedObjects& changed,
                                                         const parallel::Context& context);

/// What detect() finds of the pairs that belong to a cell.
struct TileReport {
  /// Of it what is about pairs; sets, disciplines and what is said of single objects are of those
  /// of the scene.
  Report report;
  Hash128 hash_sum;             ///< the sum, word by word, of the hashes of its pairs
  std::uint64_t hashed = 0;     ///< how many pairs that are: listed ones and others
  std::uint64_t box_pairs = 0;  ///< pairs of boxes, before any rule
  std::uint64_t parts = 0;      ///< parts of objects whose box has its lower corner in the cell
  std::vector<std::uint8_t>
      unknown_sag;  ///< of each file, other than 0: it has parts of unknown sag
};

/// Finds clashes as detect() does, of the pairs of find_pairs_of_cell(). The scene holds all
/// objects that reach into the cell, and may hold more. Errors: those of detect().
[[nodiscard]] Result<TileReport> detect_tile(const model::Scene& scene, const Sets& sets,
                                             const Options& options, const Policy& policy,
                                             const Cell& cell, const parallel::Context& context);

/// Reports how many objects the sets have, and that one has none.
void describe_sets(Report& report);

}  // namespace strake::clash
