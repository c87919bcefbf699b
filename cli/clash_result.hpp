// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cli/session.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

namespace strake::cli {

/// How the result of a clash run is to be told, as written.
struct ClashResultInput {
  std::string group_by, group_distance, sort, log_pairs, regions;
  bool volumes = false, group_contacts = false;

  [[nodiscard]] bool wants_volumes() const { return volumes || sort == "volume"; }
};

void add_result_options(CLI::App& command, ClashResultInput& options);
/// An error for options that say nothing without another.
[[nodiscard]] Status check(const ClashResultInput& input);
[[nodiscard]] std::size_t terminal_width();
[[nodiscard]] clash::SortBy sort_by(const std::string& word);

/// Tells --stats which pairs cost most.
void count_costs(Stats& stats, const clash::Findings& findings, const model::Model& model);

/// The groups, if any are asked for.
[[nodiscard]] Result<std::optional<clash::Grouping>> group(Session& session,
                                                           const ClashResultInput& input,
                                                           const clash::Findings& findings,
                                                           const model::Model& model);

}  // namespace strake::cli
