// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/run/write_files.hpp"
#include "cli/verbs/clash/clash_lines.hpp"
#include "cli/verbs/project/project_verbs.hpp"
#include "core/output_format.hpp"
#include "io/model_writers.hpp"
#include "project/results/clash_queries.hpp"

namespace strake::cli {

namespace {

struct ExportOptions {
  ProjectArgument project;
  std::vector<std::string> outputs;
};

constexpr std::string_view kDecisions = ".csv";

/// The formats of models, and that of clashes.
std::vector<OutputFormat> export_formats() {
  std::vector<OutputFormat> formats = formats_of(io::model_writers());
  formats.push_back({kDecisions, ", or clashes and decisions as {}"});
  return formats;
}

/// Writes what is known of clashes, as 'strake clash list' does.
Status write_decisions(Session& session, project::Project& project, const std::string& file) {
  const Result<std::vector<project::ListedClash>> clashes =
      project::list_clashes(project.database(), {});
  if (!clashes) return clashes.error();
  return session.write(file, [&](Session::Sink sink) {
    sink(lines_of(*clashes).csv());
    return Status{};
  });
}

Status write_models(Session& session, project::Project& project,
                    const std::vector<std::string>& files) {
  const Result<model::Model> model = [&] {
    const auto timer = session.step("load");
    return project_model(session, project);
  }();
  if (!model) return model.error();
  print_model_notes(session, *model);
  for (const std::string& file : files)
    if (const Status status = write_model(session, *model, file); !status) return status;
  return {};
}

Result<ExitCode> run_export(Session& session, const ExportOptions& given) {
  const std::vector<OutputFormat> formats = export_formats();
  if (given.outputs.empty())
    return Error{ErrorCode::usage, "nowhere to export to", "-o",
                 "write -o FILE" + std::string(formats.front().suffix)};
  if (const Status status = session.files().add_outputs(given.outputs, formats); !status)
    return status.error();
  Result<project::Project> project = open_argument(session, given.project, project::Access::read);
  if (!project) return project.error();
  std::vector<std::string> models;
  for (const std::string& file : given.outputs) {
    if (suffix_of(file) != kDecisions) {
      models.push_back(file);
      continue;
    }
    if (const Status status = write_decisions(session, *project, file); !status)
      return status.error();
  }
  if (!models.empty())
    if (const Status status = write_models(session, *project, models); !status)
      return status.error();
  return ExitCode::done;
}

}  // namespace

Verb add_project_export(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* const command = project.add_subcommand(
      "export", "The model or the decisions of a project as a file for others");
  add_project_argument(*command, options->project, project::Access::read);
  add_output_option(*command, options->outputs, "The model", export_formats());
  add_common_options(*command, common);
  command->footer(R"(
The CSV is a file of decisions, as 'strake clash --decisions' takes it; 'strake clash list' writes some
of them.

Examples:
  strake project export ship.strake -o ship.glb
  strake project export ship.strake -o decisions.csv)");
  return {command, [options](Session& session) { return run_export(session, *options); }};
}

}  // namespace strake::cli
