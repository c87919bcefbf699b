// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "project/results/remember.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

namespace strake::cli {

class Console;
class ProjectClashes;

/// What is said of BCF on the command line, as written.
struct BcfInput {
  std::string version, max_topics, date, author;
  bool contacts = false, history = false;
};

void add_bcf_options(CLI::App& command, BcfInput& options);

/// Returns the form of BCF. Errors: usage for what is misspelt, and for an option where no BCF is
/// written.
[[nodiscard]] Result<report::BcfForm> bcf_form(const BcfInput& input, bool is_written);

/// Returns what a run of a project tells of what people said.
[[nodiscard]] project::RunComments comments_of_run(const BcfInput& input, bool is_written);

/// Whether the name of a file requests BCF.
[[nodiscard]] bool is_bcf(const std::string& file);

/// Prints what a file does not have, if it is BCF, its date included.
void report_left_out(Console& console, const std::string& file,
                     const report::ClashContents& contents);

/// Returns the form with the date of the run of a project, unless one is given; `project` is null
/// where files are tested.
[[nodiscard]] report::BcfForm with_run_date(report::BcfForm form, const ProjectClashes* project);

}  // namespace strake::cli
