// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "strake/report/clash.hpp"
#include "strake/report/clash_document.hpp"

namespace strake::report {

/// One clash in two runs, told by its key, or where ids are only positions by its place.
struct DiffEntry {
  const DocumentResult* before = nullptr;  ///< absent: not a result of the old run
  const DocumentResult* after = nullptr;   ///< absent: not a result of the new run
  /// New: what else than the model may have made it one, if anything. Cannot tell: why not.
  std::string why;

  [[nodiscard]] const DocumentResult& either() const { return after != nullptr ? *after : *before; }
};

/// 1 where a result has more separate places than before, -1 where fewer; 0 where as many, or where
/// a run did not count them.
[[nodiscard]] int more_places(const DocumentResult& before, const DocumentResult& after);

struct SettingChange {
  std::string test, setting;
  std::string before, after;  ///< as in the documents; empty: absent
};

/// What changed between two runs. Refers to both documents. Each list has HITs first, then
/// CLEARANCE_VIOLATIONs, then CONTACTs, what a rule allows after what none allows, by d, then key.
struct ClashDiff {
  const ClashDocument* before = nullptr;
  const ClashDocument* after = nullptr;
  std::vector<DiffEntry> added;  ///< new
  /// Still there: another class, rule, d (by over a micrometre) or number of places.
  std::vector<DiffEntry> changed;
  std::vector<DiffEntry> same;  ///< still there
  std::vector<DiffEntry> gone;  ///< looked at again, and no result any more
  /// No result any more, but it was not looked at again; and results of either run that ids do not
  /// identify, where the other run has no such result at that place.
  std::vector<DiffEntry> cannot_tell;
  std::vector<SettingChange> settings;
  std::vector<std::string> tests_added, tests_gone;

  /// The run that either() of an entry is of.
  [[nodiscard]] const ClashDocument& run_of(const DiffEntry& entry) const {
    return entry.after != nullptr ? *after : *before;
  }

  /// Whether a result is new, or still there and worse: of a severer class, deeper or nearer by
  /// over a micrometre, or at more places. What a rule allows in the new run is neither.
  [[nodiscard]] bool has_new(bool hits_only) const;
  [[nodiscard]] bool has_worse() const;
  /// How many of `cannot_tell` would be new if they were not there before.
  [[nodiscard]] std::size_t maybe_new(bool hits_only) const;
};

/// Tests of the two documents go together by name. A result of the old run that the new one does
/// not have is `gone` only if the new run looked at the pair: both objects are in its model and in
/// opposite sets of the test, no rule exempts them, and its tolerances would report what the old
/// run measured.
///
/// Where the id of an object is only a position in its file, in either run, keys are not asked:
/// results of one class, d and point (to a micrometre) between the same objects, as far as these
/// have ids, are one clash. What has no such partner, or several, is `cannot_tell` in both runs.
[[nodiscard]] ClashDiff compare(const ClashDocument& before, const ClashDocument& after);
ClashDiff compare(ClashDocument&& before, const ClashDocument& after) = delete;
ClashDiff compare(const ClashDocument& before, ClashDocument&& after) = delete;
ClashDiff compare(ClashDocument&& before, ClashDocument&& after) = delete;

/// The document of schemas/clash-diff.schema.json.
void write_clash_diff_json(const ClashDiff& diff, Sink sink);

/// For a terminal: what is new, changed, gone and not to be told, as many of each as `rows`.
[[nodiscard]] std::string clash_diff_table(const ClashDiff& diff, const TableOptions& options);

}  // namespace strake::report
