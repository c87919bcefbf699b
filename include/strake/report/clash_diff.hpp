// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/clash_document.hpp"
#include "strake/report/file_match.hpp"

namespace strake::report {

/// One clash in two runs, identified by its key, or by its place where ids are only positions.
struct DiffEntry {
  const DocumentResult* before = nullptr;  ///< null: not a result of the old run
  const DocumentResult* after = nullptr;   ///< null: not a result of the new run
  /// For a new clash: what else than the model may have made it one, if anything. For one that
  /// cannot be known: why not.
  std::string why;

  [[nodiscard]] const DocumentResult& either() const { return after != nullptr ? *after : *before; }
};

/// Returns 1 where a result has more separate regions than before, -1 where it has fewer, 0 where
/// it has as many or a run did not count them.
[[nodiscard]] int compare_region_counts(const DocumentResult& before, const DocumentResult& after);

struct SettingChange {
  std::string test, setting;
  std::string before, after;  ///< as in the documents; empty: absent
};

/// What changed between two runs; it refers to both documents. Each list has HITs first, then
/// CLEARANCE_VIOLATIONs, then CONTACTs, what a rule allows after what none allows, by d, then key.
struct ClashDiff {
  const ClashDocument* before = nullptr;
  const ClashDocument* after = nullptr;
  FileMatches files;             ///< which file of one run was taken for which of the other
  std::vector<DiffEntry> added;  ///< new
  /// Clashes that are still there, with another class, rule, d (by over a micrometre) or number of
  /// regions.
  std::vector<DiffEntry> changed;
  std::vector<DiffEntry> same;  ///< still there
  std::vector<DiffEntry> gone;  ///< checked again, and no result any more
  /// Clashes that are no result any more, but were not checked again; and results of either run
  /// that ids do not identify, where the other run has no such result at that place.
  std::vector<DiffEntry> cannot_tell;
  std::vector<SettingChange> settings;
  std::vector<std::string> tests_added, tests_gone;

  /// Returns the run that either() of an entry is from.
  [[nodiscard]] const ClashDocument& run_of(const DiffEntry& entry) const {
    return entry.after != nullptr ? *after : *before;
  }

  /// Whether a result is new, or still there and worse: of a severer class, deeper or nearer by
  /// over a micrometre, or in more regions. What a rule allows in the new run is neither.
  [[nodiscard]] bool has_new(bool hits_only) const;
  [[nodiscard]] bool has_worse() const;
  /// Returns how many of `cannot_tell` would be new if they were not there before.
  [[nodiscard]] std::size_t maybe_new(bool hits_only) const;

  /// Adds a clash of both runs to `changed` or to `same`; `before` and `after` are there.
  void add_still_there(DiffEntry entry);
  /// Puts all lists into their order.
  void sort();
};

/// Tells which file of one run is which of the other, by the ids that the results name, and by the
/// places of results where there are only ids that are positions. What `given_pairs` says, as
/// OLD=NEW, comes first. Errors: usage, as of match_files() of RunFiles and parse_file_pairs().
[[nodiscard]] Result<FileMatches> match_files(const ClashDocument& before,
                                              const ClashDocument& after,
                                              std::span<const std::string> given_pairs = {});

/// Compares two runs. Tests of the two documents go together by name. A result of the old run that
/// the new one does not have is `gone` only if the new run checked the pair: both objects are in
/// its model and in opposite sets of the test, no rule exempts them, and its tolerances would
/// report what the old run measured.
///
/// Where the id of an object is only a position in its file, in either run, keys are not used:
/// results of one class, d and point (to a micrometre) between the same objects, as far as these
/// have ids, are one clash. What has no such partner, or several, is `cannot_tell` in both runs.
///
/// An object of a file that is another in the new run, by `files`, is the one of the same id there.
[[nodiscard]] ClashDiff compare(const ClashDocument& before, const ClashDocument& after,
                                FileMatches files = {});
ClashDiff compare(ClashDocument&& before, const ClashDocument& after,
                  FileMatches files = {}) = delete;
ClashDiff compare(const ClashDocument& before, ClashDocument&& after,
                  FileMatches files = {}) = delete;
ClashDiff compare(ClashDocument&& before, ClashDocument&& after, FileMatches files = {}) = delete;

/// Writes the document of schemas/clash-diff.schema.json.
void write_clash_diff_json(const ClashDiff& diff, Sink sink);

/// Returns a table for a terminal of what is new, changed, gone and undecided, as many of each as
/// `rows`.
[[nodiscard]] std::string clash_diff_table(const ClashDiff& diff, const TableOptions& options);

}  // namespace strake::report
