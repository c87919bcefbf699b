// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/verbs/project/project_verbs.hpp"
#include "core/output_format.hpp"
#include "io/model_writers.hpp"

namespace strake::cli {

namespace {

struct ExportOptions {
  ProjectArgument project;
  std::vector<std::string> outputs;
};

Result<ExitCode> run_export(Session& session, const ExportOptions& given) {
  const std::vector<OutputFormat> formats = formats_of(io::model_writers());
  if (given.outputs.empty())
    return Error{ErrorCode::usage, "nowhere to export to", "-o",
                 "write -o FILE" + std::string(formats.front().suffix)};
  if (const Status status = check_outputs(given.outputs, formats, {given.project.file}); !status)
    return status.error();
  Result<project::Project> project = open_argument(session, given.project, project::Access::read);
  if (!project) return project.error();
  if (const Status spares = check_spares_model_files(*project, "-o", given.outputs); !spares)
    return spares.error();
  const Result<model::Model> model = [&] {
    const auto timer = session.step("load");
    return project_model(session, *project);
  }();
  if (!model) return model.error();
  tell_of_model(session, *model);
  for (const std::string& file : given.outputs) {
    const Result<io::ModelWriter> writer = find_writer(io::model_writers(), file);
    if (!writer) return writer.error();
    session.will_write(file);
    const auto timer = session.step("write " + file);
    if (const Status status = writer->write(*model, file, {}, session.context()); !status)
      return status.error();
    session.console().note("wrote " + file);
  }
  return ExitCode::done;
}

}  // namespace

Verb add_project_export(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* const command =
      project.add_subcommand("export", "The model of a project as a file for other programs");
  add_project_argument(*command, options->project, project::Access::read);
  add_output_option(*command, options->outputs, "The model", formats_of(io::model_writers()));
  add_common_options(*command, common);
  command->footer(R"(
Clashes and decisions: 'strake clash list -p ship.strake -o decided.csv'.

Example:
  strake project export ship.strake -o ship.glb)");
  return {command, [options](Session& session) { return run_export(session, *options); }};
}

}  // namespace strake::cli
