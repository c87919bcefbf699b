// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "project/results/stored_tests.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// A result of the earlier run, and its row.
struct FormerResult {
  const clash::Pair* pair = nullptr;
  std::int64_t row = 0;
};

/// A result of the earlier run, and the one about the same two objects now.
struct PairMatch {
  std::optional<FormerResult> before;  ///< one of the two may be absent
  std::optional<std::size_t> now;
};

/// What differs between the results of two runs of one test.
struct ReportMatch {
  std::vector<std::int64_t> rows;    ///< of each result now; 0: it had none
  std::vector<PairMatch> different;  ///< results that measure something else, came or went
};

/// Compares the results of a run with those stored, which have to outlive what is returned. Errors:
/// cancelled.
[[nodiscard]] Result<ReportMatch> match_reports(const StoredTest& before, const Snapshot& now,
                                                const clash::Report& report,
                                                const parallel::Context& context);

/// The same where a run that followed changes says what it did to the results. Errors: internal
/// where it did that to other ones.
[[nodiscard]] Result<ReportMatch> match_changes(const StoredTest& before,
                                                const clash::PairChanges& changes,
                                                const clash::Report& report);

}  // namespace strake::project
