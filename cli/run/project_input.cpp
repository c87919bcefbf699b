// SPDX-License-Identifier: Apache-2.0
#include "cli/run/project_input.hpp"

#include <fmt/format.h>

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

Result<project::SignedModel> signed_model(Session& session, project::Project& project) {
  Result<project::SignedModel> stored = project.signed_model(session.context());
  if (!stored || !stored->model.files.empty()) return stored;
  return Error{ErrorCode::input, "has no model files", project.path().string(),
               "'strake project add' adds some"};
}

}  // namespace

void add_wait_option(CLI::App& command, std::string& wait) {
  command
      .add_option("--wait", wait,
                  "How long to wait where another process writes the project (default 0: not at "
                  "all); reading never waits")
      ->type_name("SECONDS")
      ->group("Running");
}

void add_project_option(CLI::App& command, std::string& file, const std::string& what) {
  command.add_option("-p,--project", file, what)->type_name("FILE")->group("Input");
}

void add_project_options(CLI::App& command, ProjectOptions& options, const std::string& what) {
  add_project_option(command, options.file, what);
  add_wait_option(command, options.wait);
}

void add_compared_options(CLI::App& command, ComparedOptions& options, const std::string& what,
                          const std::string& alone) {
  const auto add = [&](const char* name, std::string& file, const char* age, const char* type) {
    command.add_option(name, file, fmt::format(fmt::runtime(what), age) + ", or a project")
        ->type_name(type);
  };
  add("old", options.before, "older", "OLD");
  add("new", options.after, "newer", "NEW");
  add_project_option(command, options.project,
                     "Compare with what this project remembers (docs/project.md), as if it stood "
                     "behind the files; alone: " +
                         alone);
}

Result<std::vector<std::string>> compared_files(const ComparedOptions& options,
                                                const CLI::App& command) {
  std::vector<std::string> files;
  for (const std::string* const file : {&options.before, &options.after, &options.project})
    if (!file->empty()) files.push_back(*file);
  if (files.size() == 2 || (files.size() == 1 && project::is_project(files.front()))) return files;
  if (files.size() > 2)
    return Error{ErrorCode::usage, "there are two files to compare already", "-p",
                 "leave it or one of them out"};
  const CLI::Option* const lacking = command.get_option(files.empty() ? "old" : "new");
  return Error{ErrorCode::usage,
               lacking->get_type_name() + " is not given: " + lacking->get_description(),
               {},
               fmt::format("'strake {} {} --help' tells what there is",
                           command.get_parent()->get_name(), command.get_name())};
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
  if (input.georeference)
    return Error{ErrorCode::usage, "the files of a project were read already", "--georeference",
                 "leave it out, or name the files"};
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

Result<OpenedProject> open_project(Session& session, const std::string& file) {
  return open_project(session, ProjectOptions{file, {}}, project::Access::read);
}

Status add_model_files(Session& session, project::Project& project) {
  const Result<std::vector<project::StoredFile>> files = project.files();
  if (!files) return files.error();
  for (const project::StoredFile& file : *files)
    if (Status status = session.files().add_model(file.path, session.context()); !status)
      return status;
  return {};
}

Result<model::Model> project_model(Session& session, project::Project& project) {
  Result<project::SignedModel> stored = signed_model(session, project);
  if (!stored) return stored.error();
  return std::move(stored->model);
}

Result<std::vector<std::filesystem::path>> model_files(
    project::Project& project, const std::string& name,
    std::span<const rules::FileSettings> file_settings) {
  const Result<std::vector<project::StoredFile>> files = project.files();
  if (!files) return files.error();
  if (const Status status = check_file_settings(file_settings, *files, name); !status)
    return status.error();
  std::vector<std::filesystem::path> paths;
  for (const project::StoredFile& file : *files) paths.push_back(file.path);
  return paths;
}

Result<LoadedModel> load_project(Session& session, OpenedProject& opened,
                                 const model::SceneOptions& options,
                                 std::span<const rules::FileSettings> file_settings) {
  Result<std::vector<std::filesystem::path>> files =
      model_files(opened.project, opened.file, file_settings);
  if (!files) return files.error();
  Result<project::SignedModel> stored = [&] {
    const auto timer = session.step("load");
    return signed_model(session, opened.project);
  }();
  if (!stored) return stored.error();
  print_model_notes(session, stored->model);
  Result<LoadedModel> loaded = place(session, std::move(stored->model), options);
  if (!loaded) return loaded;
  loaded->files = std::move(*files);
  loaded->shape_hashes = std::move(stored->shape_hashes);
  loaded->names = stored->names;
  loaded->bodies = std::move(stored->bodies);
  return loaded;
}

}  // namespace strake::cli
