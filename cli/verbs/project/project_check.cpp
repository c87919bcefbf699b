// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/verbs/project/project_verbs.hpp"
#include "core/text_encoding.hpp"
#include "strake/project/check.hpp"

namespace strake::cli {

namespace {

std::string faults_text(const std::vector<project::Fault>& faults) {
  if (faults.empty()) return "no faults\n";
  std::string text;
  for (const project::Fault& fault : faults)
    text += fmt::format("{}: {}\n", printable(fault.where), printable(fault.what));
  return text + fmt::format("{} fault{}\n", faults.size(), faults.size() == 1 ? "" : "s");
}

std::string faults_json(const std::vector<project::Fault>& faults) {
  std::string out = "{\n  \"schema_version\": 1,\n  \"faults\": [";
  for (const project::Fault& fault : faults) {
    out += &fault == &faults.front() ? "\n    {\"where\": " : ",\n    {\"where\": ";
    append_json_string(out, fault.where);
    out += ", \"what\": ";
    append_json_string(out, fault.what);
    out += '}';
  }
  return out + (faults.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

Result<ExitCode> run_check(Session& session, const ProjectArgument& given) {
  Result<project::Project> project = open_argument(session, given, project::Access::read);
  if (!project) return project.error();
  const Result<std::vector<project::Fault>> faults = [&] {
    const auto timer = session.step("check");
    return project::check(*project, session.context());
  }();
  if (!faults) return faults.error();
  const Status written =
      session.write_stdout(session.json() ? faults_json(*faults) : faults_text(*faults));
  if (!written) return written.error();
  return faults->empty() ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace

Verb add_project_check(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<ProjectArgument>();
  CLI::App* const command =
      project.add_subcommand("check", "Whether all of a project can be read and fits together");
  add_project_argument(*command, *options, project::Access::read);
  add_common_options(*command, common);
  command->footer(R"(
It looks at the database and its references, at every block of the model, at the results of each test
and at the drawing of each view. Exit code 1 where there is a fault.

Example:
  strake project check ship.strake)");
  return {command, [options](Session& session) { return run_check(session, *options); }};
}

}  // namespace strake::cli
