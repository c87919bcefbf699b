// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/interrupts.hpp"
#include "cli/verb.hpp"
#include "strake/core/version.hpp"

namespace strake::cli {

namespace {

constexpr const char* kFooter = R"(
Examples:
  strake info platform.rvm
  strake clash hvac.rvm steel.rvm --clearance 25mm -o clashes.json
  strake draw ship.glb --view iso --hidden dashed -o ship.svg
  strake generate ship --objects 20000 --seed 1 -o ship.glb --truth ship.truth.json

'strake VERB --help' tells the options of a verb.

Exit codes: 0 done, 1 clashes found (--fail-on), 2 wrong command line, 3 a file cannot be read or
written, 4 something was skipped (--strict), 5 a fault of the program, 130 cancelled.)";

int run_verb(const Verb& verb, const CommonOptions& common, Console& console) {
  Interrupts interrupts(console);
  const Result<unsigned> workers = worker_count(common);
  if (!workers) {
    console.error(workers.error().text());
    return static_cast<int>(ExitCode::usage);
  }
  Session session(common, *workers, console, interrupts);
  const Result<ExitCode> outcome = verb.run(session);
  session.finish();
  if (outcome) return static_cast<int>(*outcome);
  console.error(outcome.error().text());
  return static_cast<int>(exit_code_of(outcome.error().code));
}

int run(int argc, char** argv) {
  Console console;
  CLI::App program("Exact clash detection and hidden-line drawings of ship and plant models.",
                   "strake");
  program.set_version_flag("--version", std::string("strake ") + std::string(version()),
                           "Print the version and end");
  program.require_subcommand(1);
  program.footer(kFooter);
  CommonOptions common;
  const std::vector<Verb> verbs{add_info(program, common), add_clash(program, common),
                                add_draw(program, common), add_generate(program, common)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return program.exit(wanted);
  } catch (const CLI::ParseError& error) {
    const auto used = program.get_subcommands();
    const std::string verb = used.empty() ? "" : " " + used.front()->get_name();
    const std::vector<std::string> strange = program.remaining();
    const std::string what = used.empty() && !strange.empty()
                                 ? "there is no verb '" + strange.front() + "'"
                                 : std::string(error.what());
    console.error(what + " ('strake" + verb + " --help' tells what there is)");
    return static_cast<int>(ExitCode::usage);
  }
  for (const Verb& verb : verbs)
    if (verb.command->parsed()) return run_verb(verb, common, console);
  return static_cast<int>(ExitCode::internal);
}

}  // namespace

}  // namespace strake::cli

int main(int argc, char** argv) {
  try {
    return strake::cli::run(argc, argv);
  } catch (const std::exception& error) {
    strake::cli::Console().error(std::string("internal fault: ") + error.what() +
                                 " (please report it with the command line)");
    return static_cast<int>(strake::cli::ExitCode::internal);
  }
}
