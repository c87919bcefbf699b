// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

#include "cli/verbs/project/project_verbs.hpp"

namespace strake::cli {

void add_project_argument(CLI::App& command, ProjectArgument& project, project::Access access) {
  command.add_option("project", project.file, "The project, as ship.strake")
      ->required()
      ->type_name("FILE");
  if (access == project::Access::write) add_wait_option(command, project.wait);
}

Result<project::Project> open_argument(Session& session, const ProjectArgument& project,
                                       project::Access access) {
  Result<OpenedProject> opened = open_project(session, {project.file, project.wait}, access);
  if (!opened) return opened.error();
  return std::move(opened->project);
}

std::vector<Verb> add_project_verbs(CLI::App& program, CommonOptions& common) {
  CLI::App* const project = program.add_subcommand(
      "project", "Projects: models, views, tests and decisions that a file remembers");
  project->require_subcommand(1);
  project->footer(R"(
Other verbs take a project in place of model files, or work in it by -p: what they find is remembered,
and the next run costs what changed.

Examples:
  strake project new ship.strake hull.rvm hvac.rvm
  strake clash -p ship.strake
  strake project update ship.strake

'strake project VERB --help' tells the options of a verb.)");
  return {add_project_new(*project, common),    add_project_add(*project, common),
          add_project_update(*project, common), add_project_remove(*project, common),
          add_project_list(*project, common),   add_project_info(*project, common),
          add_project_check(*project, common),  add_project_export(*project, common)};
}

}  // namespace strake::cli
