// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "project/results/stored_tests.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// A result of the earlier run, and the one about the same two objects now.
struct PairMatch {
  std::optional<std::size_t> before, now;  ///< one of the two may be absent
};

/// What differs between the results of two runs of one test.
struct ReportMatch {
  std::vector<std::uint32_t>
      now_of;  ///< of each object of the earlier run; model::kNoObject: not there
  std::vector<std::uint32_t> before_of;  ///< of each object now; model::kNoObject: it was not there
  std::vector<std::int64_t> rows;        ///< of each result now; 0: it had none
  std::vector<PairMatch> different;      ///< results that measure something else, came or went
};

/// Compares the results of a run with those stored. Errors: cancelled.
[[nodiscard]] Result<ReportMatch> match_reports(const StoredTest& before, const Snapshot& now,
                                                const clash::Report& report,
                                                const parallel::Context& context);

}  // namespace strake::project
