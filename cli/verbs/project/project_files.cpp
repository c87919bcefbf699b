// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/run/authorship.hpp"
#include "cli/run/load.hpp"
#include "cli/run/write_files.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/project/project_verbs.hpp"
#include "core/output_format.hpp"
#include "project/changes/change_writers.hpp"
#include "strake/project/update.hpp"

namespace strake::cli {

namespace {

struct FileOptions {
  ProjectArgument project;
  InputOptions input;
  std::vector<std::string> labels, match_files, outputs;
};

/// Prints what was read of files, as load() does.
Status print_file_notes(Session& session, project::Project& project, const project::Update& done) {
  const Result<std::vector<project::StoredFile>> files = project.files();
  if (!files) return files.error();
  for (const project::StoredFile& file : *files)
    for (const std::string& label : done.read)
      if (label == file.source.label)
        session.console().note(fmt::format("{}: {}, {} objects, unit {}, {} up", label,
                                           file.source.format, file.objects, file.source.unit,
                                           file.source.up_axis));
  print_diagnostics(session.console(), done.noticed);
  return {};
}

Status write_outputs(Session& session, const FileOptions& given, const project::Changes& changes) {
  if (const Status status = write_files(session, given.outputs, project::change_writers(), changes);
      !status)
    return status;
  if (!session.json())
    return session.write_stdout(project::changes_text(changes, {.width = terminal_width()}));
  return session.write_stdout([&](Session::Sink sink) {
    project::write_changes_json(changes, sink);
    return Status{};
  });
}

/// Tells what became of the project, and returns the exit code.
Result<ExitCode> print_update(Session& session, const FileOptions& given, project::Project& project,
                              const project::Update& done) {
  if (const Status status = print_file_notes(session, project, done); !status)
    return status.error();
  if (const Status status = write_outputs(session, given, done.changes); !status)
    return status.error();
  return given.input.strict && done.noticed.skipped() > 0 ? ExitCode::partial : ExitCode::done;
}

project::RevisionNote note_of_now() { return {.when = utc_time()}; }

/// Refuses projects among model files: they are no source of a project.
Status check_model_files(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (project::is_project(file))
      return Error{ErrorCode::usage, "is a project, no model file", file,
                   "give the model files themselves"};
  return {};
}

/// Returns the files to read, which no output may be.
Result<std::vector<io::FileToRead>> model_files(Session& session, const FileOptions& given) {
  if (const Status status = check_model_files(given.input.files); !status) return status.error();
  if (const Status status =
          session.files().add_outputs(given.outputs, formats_of(project::change_writers()));
      !status)
    return status.error();
  for (const std::string& file : given.input.files)
    if (const Status status = session.files().add_model(file, session.context()); !status)
      return status.error();
  return files_to_read(given.input);
}

Result<project::Update> add_files(Session& session, project::Project& project,
                                  const std::vector<io::FileToRead>& files) {
  const auto timer = session.step("load");
  return project::add_model_files(project, files, note_of_now(), session.context());
}

/// Removes a project that could not be filled.
void remove_project(const std::string& file) {
  std::error_code ignored;
  for (const char* const suffix : {"", "-wal", "-shm"})
    std::filesystem::remove(file + suffix, ignored);
}

Result<ExitCode> run_new(Session& session, const FileOptions& given) {
  const Result<std::vector<io::FileToRead>> files = model_files(session, given);
  if (!files) return files.error();
  std::optional<Result<project::Project>> project(project::Project::create(given.project.file));
  if (!*project) return project->error();
  if (files->empty()) {
    session.console().note("wrote " + given.project.file);
    return ExitCode::done;
  }
  const Result<project::Update> done = add_files(session, project->value(), *files);
  if (!done) {
    project.reset();
    remove_project(given.project.file);
    return done.error();
  }
  session.console().note("wrote " + given.project.file);
  return print_update(session, given, project->value(), *done);
}

Result<ExitCode> run_add(Session& session, const FileOptions& given) {
  if (given.input.files.empty())
    return Error{ErrorCode::usage,
                 "no model file is given",
                 {},
                 "'strake project add --help' tells what there is"};
  const Result<std::vector<io::FileToRead>> files = model_files(session, given);
  if (!files) return files.error();
  Result<project::Project> project = open_argument(session, given.project, project::Access::write);
  if (!project) return project.error();
  const Result<project::Update> done = add_files(session, *project, *files);
  if (!done) return done.error();
  return print_update(session, given, *project, *done);
}

Result<ExitCode> run_update(Session& session, const FileOptions& given) {
  const Result<std::vector<io::FileToRead>> files = model_files(session, given);
  if (!files) return files.error();
  Result<project::Project> project = open_argument(session, given.project, project::Access::write);
  if (!project) return project.error();
  const Result<project::Update> done = [&] {
    const auto timer = session.step("load");
    return project::update(*project, {*files, given.match_files}, note_of_now(), session.context());
  }();
  if (!done) return done.error();
  return print_update(session, given, *project, *done);
}

Result<ExitCode> run_remove(Session& session, const FileOptions& given) {
  Result<project::Project> project = open_argument(session, given.project, project::Access::write);
  if (!project) return project.error();
  const Result<project::Update> done =
      project::remove_model_files(*project, given.labels, note_of_now(), session.context());
  if (!done) return done.error();
  return print_update(session, given, *project, *done);
}

}  // namespace

Verb add_project_new(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<FileOptions>();
  CLI::App* const command =
      project.add_subcommand("new", "A new project, with what model files hold");
  command->add_option("project", options->project.file, "The project, which is not there yet")
      ->required()
      ->type_name("FILE");
  add_input_options(*command, options->input);
  command->get_option("files")->required(false);
  add_common_options(*command, common);
  command->footer(R"(
The project keeps the models as they were read: the files are not needed any more, except for
'strake project update', which looks for them where they lay.

Examples:
  strake project new ship.strake hull.rvm hvac.rvm piping.rvm
  strake project new plant.strake plant.stl --unit m)");
  return {command, [options](Session& session) { return run_new(session, *options); }};
}

Verb add_project_add(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<FileOptions>();
  CLI::App* const command = project.add_subcommand("add", "Adds model files to a project");
  add_project_argument(*command, options->project, project::Access::write);
  add_input_options(*command, options->input);
  command->get_option("files")->required(false);
  add_common_options(*command, common);
  command->footer(R"(
Example:
  strake project add ship.strake electrical.rvm)");
  return {command, [options](Session& session) { return run_add(session, *options); }};
}

Verb add_project_update(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<FileOptions>();
  CLI::App* const command = project.add_subcommand(
      "update", "Reads again what changed, and tells what became of the objects");
  add_project_argument(*command, options->project, project::Access::write);
  add_input_options(*command, options->input);
  command->get_option("files")->required(false);
  command->get_option("files")->description(
      "Model files that take the place of those that they match (default: all of the project, "
      "where they lie)");
  add_match_files_option(*command, options->match_files);
  add_output_option(*command, options->outputs, "What changed,",
                    formats_of(project::change_writers()));
  add_common_options(*command, common);
  command->footer(R"(
Files whose bytes are the same are not read again. Objects are told as added, removed, moved (the same
shapes elsewhere), reshaped, reattributed (attributes, name, path, colour, category) or renamed (the
same shapes at the same place under another id). A file of another name takes the place of the one that
has most of its objects; which, is told first. After an error the project is as it was.

Examples:
  strake project update ship.strake
  strake project update ship.strake -o changes.json -o changes.csv
  strake project update ship.strake hvac_revB.rvm
  strake project update ship.strake new/hvac.rvm --match-files hvac_old.rvm=hvac.rvm)");
  return {command, [options](Session& session) { return run_update(session, *options); }};
}

Verb add_project_remove(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<FileOptions>();
  CLI::App* const command = project.add_subcommand("remove", "Takes model files out of a project");
  add_project_argument(*command, options->project, project::Access::write);
  command
      ->add_option("labels", options->labels,
                   "Files by their labels, as 'strake project list' shows them")
      ->required()
      ->type_name("LABEL");
  add_common_options(*command, common);
  command->footer(R"(
Example:
  strake project remove ship.strake hvac.rvm)");
  return {command, [options](Session& session) { return run_remove(session, *options); }};
}

}  // namespace strake::cli
