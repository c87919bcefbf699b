// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "cli/run/authorship.hpp"
#include "cli/run/project_input.hpp"
#include "cli/verbs/clash/clash_output.hpp"
#include "cli/verbs/project_page.hpp"
#include "cli/verbs/verb.hpp"
#include "page/page.hpp"
#include "project/review/decide_if_unchanged.hpp"
#include "serve/gate/gate.hpp"
#include "serve/gate/secret.hpp"
#include "serve/http/server.hpp"
#include "serve/site/site.hpp"

namespace strake::cli {

namespace {

struct ViewOptions {
  ProjectOptions project;
  std::string port, by, page_geometry;
};

Result<std::uint16_t> port_of(const ViewOptions& given) {
  std::uint64_t port = 0;
  if (const Status status = whole_number(port, given.port, "--port"); !status)
    return status.error();
  if (port > std::numeric_limits<std::uint16_t>::max())
    return Error{ErrorCode::usage, "there is no port " + given.port, "--port",
                 "choose one from 1024 to 65535"};
  return static_cast<std::uint16_t>(port);
}

/// Makes the page, with what it knows of the project at that moment.
Result<serve::ServedPage> served_page(Session& session, OpenedProject& opened,
                                      const std::string& geometry, const std::string& by) {
  project::Database& database = opened.project.database();
  const Result<project::ReadScope> scope = project::ReadScope::begin(database);
  if (!scope) return scope.error();
  const Result<project::KnownState> state = project::current_state(database);
  if (!state) return state.error();
  std::string html;
  const Status status = make_project_page(session, opened, geometry, [&](page::PageContents& page) {
    page.served = {state->run, state->event, by};
    return page::write_page(page, [&](std::string_view text) { html += text; }, session.context());
  });
  if (!status) return status.error();
  return serve::ServedPage{std::make_shared<const std::string>(std::move(html)),
                           page::served_policy(), *state};
}

Result<serve::Gate> gate_of(std::uint16_t port) {
  Result<std::string> token = serve::make_secret();
  if (!token) return token.error();
  Result<std::string> cookie = serve::make_secret();
  if (!cookie) return cookie.error();
  return serve::Gate(port, std::move(*token), std::move(*cookie));
}

Result<ExitCode> run_view(Session& session, const ViewOptions& given) {
  if (given.project.file.empty())
    return Error{ErrorCode::usage, "no project is given", "-p", "write -p FILE"};
  const Result<std::uint16_t> port = port_of(given);
  if (!port) return port.error();
  Result<OpenedProject> opened = open_project(session, given.project, project::Access::write);
  if (!opened) return opened.error();
  // A port that is not to be had is told before the page is made.
  Result<serve::Server> server = serve::Server::listen(*port);
  if (!server) return server.error();
  const Result<serve::Gate> gate = gate_of(server->port());
  if (!gate) return gate.error();
  const std::string by = given.by.empty() ? person() : given.by;
  serve::Site site(*gate, {opened->project.database(),
                           [&] { return served_page(session, *opened, given.page_geometry, by); },
                           by, utc_time});
  if (const Status status = site.prepare(); !status) return status.error();
  if (const Status status = session.write_stdout(gate->address() + "\n"); !status)
    return status.error();
  session.console().note(
      fmt::format("{}: open this address in a browser; Ctrl-C ends it", opened->file));
  session.begin_serving();
  if (const Status status = server->serve(site, session.context().stop); !status)
    return status.error();
  return ExitCode::done;
}

}  // namespace

Verb add_view(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* const command = program.add_subcommand(
      "view", "Look at a project in a browser, and decide about its clashes there");
  add_project_options(*command, options->project,
                      "The project that is looked at and decided about (docs/project.md)");
  command
      ->add_option("--port", options->port,
                   "The port on this machine that the page is served on (default: one that is "
                   "free)")
      ->type_name("N");
  command->add_option("--by", options->by, "Who decides (default: the user)")->type_name("NAME");
  add_page_geometry_option(*command, options->page_geometry);
  add_common_options(*command, common);
  command->footer(R"(
The page is that of 'strake report', in which statuses, comments and assignees can be set as by
'strake clash set' (docs/view.md). It is served on 127.0.0.1, which no other machine reaches, and to who knows
the address that is printed: it has a token, another one each time. Ctrl-C ends it, with exit code 0.

Examples:
  strake view -p ship.strake
  strake view -p ship.strake --port 8123 --by Ann)");
  return {command, [options](Session& session) { return run_view(session, *options); }};
}

}  // namespace strake::cli
