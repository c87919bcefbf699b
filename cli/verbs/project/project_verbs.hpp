// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/run/project_input.hpp"
#include "cli/verbs/verb.hpp"
#include "strake/project/project.hpp"

/// The verbs of 'strake project'. Each function adds one to it.
namespace strake::cli {

/// The project that a verb is about, as its first argument.
struct ProjectArgument {
  std::string file, wait;
};

/// Adds the argument, and --wait for verbs that write.
void add_project_argument(CLI::App& command, ProjectArgument& project, project::Access access);
[[nodiscard]] Result<project::Project> open_argument(Session& session,
                                                     const ProjectArgument& project,
                                                     project::Access access);

[[nodiscard]] Verb add_project_new(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_add(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_update(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_remove(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_list(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_info(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_check(CLI::App& project, CommonOptions& common);
[[nodiscard]] Verb add_project_export(CLI::App& project, CommonOptions& common);

}  // namespace strake::cli
