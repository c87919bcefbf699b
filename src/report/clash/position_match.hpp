// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/files/file_map.hpp"
#include "strake/report/clash_diff.hpp"
#include "strake/report/clash_document.hpp"

namespace strake::report {

/// A difference of d or of a coordinate below this, in millimetres, is that of the grid.
inline constexpr double kSameMm = 1e-3;

/// The results of a run that keys do not identify: the id of one of the objects is only a position
/// in its file, in this run or in the other.
class PositionalResults {
 public:
  /// `side` says which run of the map `run` is.
  PositionalResults(const ClashDocument& run, const ClashDocument& other, const FileMap& files,
                    RunSide side);

  [[nodiscard]] const ClashDocument& run() const { return run_; }
  /// Returns the file of an object as it is called for both runs.
  [[nodiscard]] std::string file_of(const DocumentObject& o) const {
    return files_.group_of(side_, o.file);
  }
  /// Whether the id of an object of the run is only a position.
  [[nodiscard]] bool has(std::uint32_t object) const {
    return !positional_.empty() && positional_[object];
  }
  [[nodiscard]] bool has(const DocumentResult& r) const { return has(r.a) || has(r.b); }

 private:
  const ClashDocument& run_;
  const FileMap& files_;
  RunSide side_;
  std::vector<bool> positional_;  ///< one per object of the run; empty: none is
};

/// Pairs positional results of two runs by what does not move: the test, the class, the objects as
/// far as ids say which they are, d and the point. Every result of either run that
/// PositionalResults::has() is in one entry: with its partner, or alone with the reason why it has
/// none.
///
/// Results that are alike, and no farther apart than the grid, are one cluster; it is paired where
/// both runs have as many of them and it makes no difference how. So the pairing does not depend on
/// any number in an id.
[[nodiscard]] std::vector<DiffEntry> match_by_position(const PositionalResults& before,
                                                       const PositionalResults& after);

}  // namespace strake::report
