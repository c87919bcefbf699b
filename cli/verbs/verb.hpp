// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/run/exit_code.hpp"
#include "cli/run/session.hpp"

namespace strake::cli {

/// A command of the program: its options are bound on the CLI::App, and `run` does the work.
struct Verb {
  CLI::App* command = nullptr;
  std::function<Result<ExitCode>(Session&)> run;
};

// Each function adds its command to the program. What the options are bound to lives as long as
// `run`.
[[nodiscard]] Verb add_info(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_clash(CLI::App& program, CommonOptions& common);
/// `clash` is the command of add_clash().
[[nodiscard]] Verb add_clash_diff(CLI::App& clash, CommonOptions& common);
[[nodiscard]] Verb add_clash_set(CLI::App& clash, CommonOptions& common);
[[nodiscard]] Verb add_clash_list(CLI::App& clash, CommonOptions& common);
[[nodiscard]] Verb add_clash_history(CLI::App& clash, CommonOptions& common);
[[nodiscard]] Verb add_draw(CLI::App& program, CommonOptions& common);
/// `draw` is the command of add_draw().
[[nodiscard]] Verb add_draw_diff(CLI::App& draw, CommonOptions& common);
/// 'rules list' and 'rules show' are options of one verb.
[[nodiscard]] Verb add_rules_verb(CLI::App& program);
/// The verbs of 'strake project'; it has no run of its own.
[[nodiscard]] std::vector<Verb> add_project_verbs(CLI::App& program, CommonOptions& common);
/// The verbs of 'strake cache'; it has no run of its own.
[[nodiscard]] std::vector<Verb> add_cache_verbs(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_report(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_view(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_convert(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_generate(CLI::App& program, CommonOptions& common);
[[nodiscard]] Verb add_evaluate(CLI::App& program, CommonOptions& common);
/// The three commands describe all that was added to the program by the time that they run.
[[nodiscard]] Verb add_help(CLI::App& program);
[[nodiscard]] Verb add_man(CLI::App& program);
[[nodiscard]] Verb add_completion(CLI::App& program);

}  // namespace strake::cli
