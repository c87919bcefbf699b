// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/run/load.hpp"
#include "strake/project/project.hpp"
#include "strake/rules/rules.hpp"

/// A project that a verb works in: -p FILE in place of model files.
namespace strake::cli {

/// The options -p and --wait, as written.
struct ProjectOptions {
  std::string file, wait;
};

/// Adds --wait alone, for verbs whose project is an argument.
void add_wait_option(CLI::App& command, std::string& wait);
/// Parses --wait as seconds; none is 0.
[[nodiscard]] Result<double> wait_seconds(const std::string& wait);
/// The help of -p where a verb works on the model of a project.
inline constexpr const char* kWorkOnProject =
    "Work on the model of this project (docs/project.md), in place of files, and remember the "
    "result "
    "in it";

/// Adds -p,--project FILE alone, for verbs that only read; `what` is its help.
void add_project_option(CLI::App& command, std::string& file, const std::string& what);
/// Adds -p,--project FILE and --wait.
void add_project_options(CLI::App& command, ProjectOptions& options, const std::string& what);

/// Checks that -p stands in place of model files, and that no option speaks of files beside it.
/// Errors: usage. All is well without -p.
[[nodiscard]] Status check_project_options(const ProjectOptions& options,
                                           const InputOptions& input);

/// What a comparison is given, as written: two files, of which each may be a project, or one
/// project; -p is one more.
struct ComparedOptions {
  std::string before, after, project;
};

/// Adds OLD, NEW and -p; `what` is what OLD and NEW are if they are no projects, as "Result of the
/// %s run, .json", and `alone` what is compared of a project alone.
void add_compared_options(CLI::App& command, ComparedOptions& options, const std::string& what,
                          const std::string& alone);

/// Returns the files that are compared, the older first: two, or one that is a project. Errors:
/// usage.
[[nodiscard]] Result<std::vector<std::string>> compared_files(const ComparedOptions& options,
                                                              const CLI::App& command);

/// A project of the command line, open.
struct OpenedProject {
  std::string file;  ///< as it was written
  project::Project project;
};

/// Opens the project that the options name. Errors: usage for --wait, and where an output is the
/// project or one of its model files; those of project::Project::open().
[[nodiscard]] Result<OpenedProject> open_project(Session& session, const ProjectOptions& options,
                                                 project::Access access);
/// Opens a project to be read. Errors: those of project::Project::open().
[[nodiscard]] Result<OpenedProject> open_project(Session& session, const std::string& file);

/// Makes known to the run which files an update of the project reads again. Errors: usage where an
/// output is one of them; those of project::Project::files().
[[nodiscard]] Status add_model_files(Session& session, project::Project& project);

/// Takes the model out of a project. Errors: input for a project without files; those of
/// project::Project::model().
[[nodiscard]] Result<model::Model> project_model(Session& session, project::Project& project);

/// Returns the paths of the files that a project was made of, which were read as rules say of them;
/// `name` is what errors call the project. Errors: those of check_file_settings() and of
/// project::Project::files().
[[nodiscard]] Result<std::vector<std::filesystem::path>> model_files(
    project::Project& project, const std::string& name,
    std::span<const rules::FileSettings> file_settings);

/// Takes the model out of the project, puts it on the grid, and prints what was noticed, as load()
/// does for files. Errors: those of project_model() and of model_files().
[[nodiscard]] Result<LoadedModel> load_project(
    Session& session, OpenedProject& opened, const model::SceneOptions& options,
    std::span<const rules::FileSettings> file_settings = {});

}  // namespace strake::cli
