// SPDX-License-Identifier: Apache-2.0
#include "cli/run/project_input.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/run/file_settings.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::cli {

namespace {

/// An hour: whoever waits longer waits for a process that hangs.
constexpr double kLongestWaitS = 3600;

}  // namespace

void add_wait_option(CLI::App& command, std::string& wait) {
  command
      .add_option("--wait", wait,
                  "How long to wait where another process writes the project (default 0: not at "
                  "all); reading never waits")
      ->type_name("SECONDS")
      ->group("Running");
}

void add_project_options(CLI::App& command, ProjectOptions& options) {
  command
      .add_option("-p,--project", options.file,
                  "Work on the model of this project (docs/project.md), in place of files, and "
                  "remember the result in it")
      ->type_name("FILE")
      ->group("Input");
  add_wait_option(command, options.wait);
}

Status check_project_options(const ProjectOptions& options, const InputOptions& input) {
  if (options.file.empty()) {
    if (options.wait.empty()) return {};
    return Error{ErrorCode::usage, "only a project is waited for", "--wait",
                 "add -p FILE, or leave it out"};
  }
  if (!input.files.empty())
    return Error{ErrorCode::usage,
                 in_quotes(input.files.front()) + " is given beside -p " + options.file,
                 {},
                 "'strake project add' adds files to a project"};
  for (const auto& [name, given] :
       {std::pair("--unit", &input.units), std::pair("--up-axis", &input.up_axes)})
    if (!given->empty())
      return Error{ErrorCode::usage, "the project knows this of its files", name,
                   "leave it out; 'strake project update' reads files of a project otherwise"};
  return {};
}

Result<double> wait_seconds(const std::string& wait) {
  if (wait.empty()) return 0.0;
  const std::optional<double> seconds = parse_number(wait);
  if (!seconds || !(*seconds >= 0 && *seconds <= kLongestWaitS))
    return Error{ErrorCode::usage, in_quotes(wait) + " is no number of seconds", "--wait",
                 "write a number from 0 to 3600"};
  return *seconds;
}

Result<OpenedProject> open_project(Session& session, const ProjectOptions& options,
                                   project::Access access) {
  const Result<double> wait = wait_seconds(options.wait);
  if (!wait) return wait.error();
  if (const Status status = session.files().add_project(options.file); !status)
    return status.error();
  const auto timer = session.step("open");
  Result<project::Project> project =
      project::Project::open(options.file, {.access = access, .wait_s = *wait});
  if (!project) return project.error();
  if (const Status status = add_model_files(session, *project); !status) return status.error();
  return OpenedProject{options.file, std::move(*project)};
}

Status add_model_files(Session& session, project::Project& project) {
  const Result<std::vector<project::StoredFile>> files = project.files();
  if (!files) return files.error();
  for (const project::StoredFile& file : *files)
    if (Status status = session.files().add_later_model(file.path, session.context()); !status)
      return status;
  return {};
}

Result<model::Model> project_model(Session& session, project::Project& project) {
  Result<model::Model> model = project.model(session.context());
  if (!model || !model->files.empty()) return model;
  return Error{ErrorCode::input, "has no model files", project.path().string(),
               "'strake project add' adds some"};
}

Result<std::vector<std::filesystem::path>> model_files(
    project::Project& project, const std::string& name,
    std::span<const rules::FileSettings> said_of_files) {
  const Result<std::vector<project::StoredFile>> files = project.files();
  if (!files) return files.error();
  if (const Status status = check_file_settings(said_of_files, *files, name); !status)
    return status.error();
  std::vector<std::filesystem::path> paths;
  for (const project::StoredFile& file : *files) paths.push_back(file.path);
  return paths;
}

Result<Loaded> load_project(Session& session, OpenedProject& opened,
                            const model::SceneOptions& options,
                            std::span<const rules::FileSettings> said_of_files) {
  Result<std::vector<std::filesystem::path>> files =
      model_files(opened.project, opened.file, said_of_files);
  if (!files) return files.error();
  Result<model::Model> model = [&] {
    const auto timer = session.step("load");
    return project_model(session, opened.project);
  }();
  if (!model) return model.error();
  tell_of_model(session, *model);
  Result<Loaded> loaded = place(session, std::move(*model), options);
  if (loaded) loaded->files = std::move(*files);
  return loaded;
}

}  // namespace strake::cli
