// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/run/session.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "project/results/run_records.hpp"
#include "strake/core/result.hpp"

/// The groups of the last run of a project, as its report has them.
namespace strake::cli {

/// How clashes of a project are to be grouped, as written.
struct ClashGroupingInput {
  ClashResultInput result;
  std::string classes;

  /// Returns an option that is given; null where none is.
  [[nodiscard]] const char* first_given() const;
};

void add_grouping_options(CLI::App& command, ClashGroupingInput& options);
/// Returns an error for options that make no sense; what groups are by need not be given.
[[nodiscard]] Status check(const ClashGroupingInput& input);

/// Returns how a run groups, to be remembered.
[[nodiscard]] project::RunGrouping grouping_of(const ClashResultInput& result,
                                               const std::string& classes);

struct ProjectGroup {
  /// A hash of the keys of its clashes: what has it is the same group, whenever and however it was
  /// listed.
  std::string key;
  std::string id, name;              ///< as in the report
  std::vector<std::string> clashes;  ///< their keys
};

/// Returns the groups in the order of the report, so that the first has the number 1. They are
/// those that the run reported, whatever was decided since: what was approved then is in no group,
/// what was approved later is in its own. Where no option is given, the results are grouped as the
/// run grouped them, or by element where it did not. Errors: usage where the model is another one
/// by now; those of project::read_test().
[[nodiscard]] Result<std::vector<ProjectGroup>> groups_of_last_run(Session& session,
                                                                   OpenedProject& opened,
                                                                   const ClashGroupingInput& input);

}  // namespace strake::cli
