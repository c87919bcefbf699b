// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/run/exit_code.hpp"
#include "cli/run/load.hpp"
#include "cli/run/session.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"
#include "strake/report/decisions.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

/// The options for the result of a clash run, and its exit code.
namespace strake::cli {

/// How the result of a clash run is to be reported, as written.
struct ClashResultInput {
  std::string group_by, group_distance, sort, log_pairs, regions;
  bool volumes = false, group_contacts = false;

  [[nodiscard]] bool wants_volumes() const { return volumes || sort == "volume"; }
};

void add_result_options(CLI::App& command, ClashResultInput& options);
/// Returns an error for options that have no effect without another.
[[nodiscard]] Status check(const ClashResultInput& input);
[[nodiscard]] std::size_t terminal_width();
[[nodiscard]] clash::SortBy sort_by(const std::string& word);

/// Counts what the tests took, for --stats.
void count_work(Stats& stats, const std::vector<clash::Report>& tests);

/// Adds the pairs that cost most to --stats.
void count_costs(Stats& stats, const clash::Findings& findings, const model::Model& model);

/// Returns the groups, if any are requested, without what decisions settle.
[[nodiscard]] Result<std::optional<clash::Grouping>> group(Session& session,
                                                           const ClashResultInput& input,
                                                           const clash::Findings& findings,
                                                           const model::Model& model,
                                                           const report::DecidedResults* decided);

/// Results that stop --fail-on.
struct FailingPairs {
  std::uint64_t surely = 0;
  std::uint64_t perhaps = 0;  ///< that may be as bad, as far as is known
};

/// Counts them in findings that still have the results of all classes, without what decisions
/// settle; `fail_on` is --fail-on as written, empty if it is not given.
[[nodiscard]] FailingPairs failing_pairs(const clash::Findings& findings,
                                         const std::string& fail_on,
                                         const report::DecidedResults* decided);

/// Returns the exit code of a clash run; `fail_on` is --fail-on as written, empty if it is not
/// given. Prints on standard error those reasons that standard output does not show.
///
/// The code is `check_failed` where a result is, or may be as far as its brackets tell, of the
/// class of --fail-on or a worse one, where a pair was not compared, where a file ends early and
/// where a test compared nothing, as a set of it is empty. Else it is `partial` where --strict is
/// given and something was skipped, a set or a discipline that a matrix checks is empty, or a
/// clearance got less than its attribute requests.
[[nodiscard]] ExitCode clash_exit_code(const clash::Findings& findings, const FailingPairs& failing,
                                       const std::string& fail_on, const InputOptions& input,
                                       const LoadedModel& loaded, Console& console);

}  // namespace strake::cli
