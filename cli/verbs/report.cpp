// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cli/run/project_input.hpp"
#include "cli/verbs/clash/clash_output.hpp"
#include "cli/verbs/project_page.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "page/page.hpp"

namespace strake::cli {

namespace {

constexpr std::array<OutputFormat, 1> kPages{{{".html", " as {}, which opens in a browser"}}};

struct ReportOptions {
  ProjectOptions project;
  std::vector<std::string> outputs;
  std::string page_geometry;
};

Result<ExitCode> run_report(Session& session, const ReportOptions& given) {
  if (given.project.file.empty())
    return Error{ErrorCode::usage, "no project is given", "-p", "write -p FILE"};
  if (given.outputs.empty())
    return Error{ErrorCode::usage, "nowhere to write to", "-o", "write -o FILE.html"};
  if (const Status status = session.files().add_outputs(given.outputs, kPages); !status)
    return status.error();
  Result<OpenedProject> opened = open_project(session, given.project, project::Access::read);
  if (!opened) return opened.error();
  const Status status = make_project_page(
      session, *opened, given.page_geometry, [&](const page::PageContents& page) -> Status {
        for (const std::string& file : given.outputs) {
          const Status written = session.write(file, [&](Session::Sink sink) {
            return page::write_page(page, sink, session.context());
          });
          if (!written) return written;
        }
        return {};
      });
  if (!status) return status.error();
  return ExitCode::done;
}

}  // namespace

Verb add_report(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* const command = program.add_subcommand(
      "report", "What a project knows, as one page: results, decisions, runs, model, drawings");
  add_project_options(*command, options->project,
                      "The project that the page is about (docs/project.md)");
  add_output_option(*command, options->outputs, "The page", kPages);
  add_page_geometry_option(*command, options->page_geometry);
  add_common_options(*command, common);
  command->footer(R"(
The page has the results of the last run, with what was decided about them by now, the runs before it,
the model, and the stored views as they were drawn last. It is one file, which opens without a network
(docs/report-page.md).

Examples:
  strake report -p ship.strake -o report.html
  strake report -p ship.strake --page-geometry boxes -o small.html)");
  return {command, [options](Session& session) { return run_report(session, *options); }};
}

}  // namespace strake::cli
