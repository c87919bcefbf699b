// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/usage_error.hpp"
#include "cli/output/console.hpp"
#include "cli/run/interrupts.hpp"
#include "cli/run/memory.hpp"
#include "cli/run/on_cluster.hpp"
#include "cli/verbs/verb.hpp"
#include "strake/core/version.hpp"

namespace strake::cli {

namespace {

constexpr const char* kFooter = R"(
Examples:
  strake info platform.rvm
  strake clash hvac.rvm steel.rvm --clearance 25mm -o clashes.json
  strake clash diff monday.json tuesday.json
  strake draw ship.glb --view iso --hidden dashed -o ship.svg
  strake draw diff monday.json tuesday.json -o changes.svg
  strake project new ship.strake hull.rvm hvac.rvm
  strake clash -p ship.strake
  strake report -p ship.strake -o report.html
  strake view -p ship.strake
  strake convert hull.rvm hull.glb
  strake generate ship --objects 20000 --seed 1 -o ship.glb --truth ship.truth.json
  strake evaluate --scale 0.02

'strake help VERB', or 'strake VERB --help', tells the options of a verb.

Exit codes: 0 done, 1 clashes found (--fail-on) or a fault found (evaluate), 2 wrong command line,
3 a file cannot be read or written, 4 something was skipped or a set is empty (--strict), 5 a fault
of the program, 6 out of memory, 130 cancelled.)";

/// Prints why the program ends, and returns the exit code.
int ended_by(const Error& error, Console& console) {
  if (error.code == ErrorCode::memory)
    print_out_of_memory();
  else
    console.error(error.text());
  return static_cast<int>(exit_code_of(error.code));
}

int run_verb(const Verb& verb, const CommonOptions& common, Console& console) {
  Interrupts interrupts(console);
  const Result<unsigned> workers = worker_count(common);
  if (!workers) return ended_by(workers.error(), console);
  Session session(common, *workers, console, interrupts);
  const Result<ExitCode> outcome = verb.run(session);
  session.finish();
  return outcome ? static_cast<int>(*outcome) : ended_by(outcome.error(), console);
}

/// Opens standard streams that were closed on nothing, and for the other direction, so that no file
/// of ours takes such a number and becomes where messages go; using it still fails.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

int run(int argc, char** argv) {
  occupy_standard_streams();
  // A file that grows beyond the limit is a failed write, which cleans up after itself.
  std::signal(SIGXFSZ, SIG_IGN);
  keep_freed_memory();
  end_well_without_memory();
  Console console;
  CLI::App program("Exact clash detection and hidden-line drawings of ship and plant models.",
                   "strake");
  program.set_version_flag("--version", std::string("strake ") + std::string(version()),
                           "Print the version and end");
  program.require_subcommand(1);
  program.footer(kFooter);
  CommonOptions common;
  const Verb clash = add_clash(program, common);
  // A verb within a verb goes first: both count as parsed.
  const Verb draw = add_draw(program, common);
  const Verb info = add_info(program, common);
  std::vector<Verb> verbs = add_project_verbs(program, common);
  for (Verb& verb : add_cache_verbs(program, common)) verbs.push_back(std::move(verb));
  verbs.insert(
      verbs.end(),
      {add_clash_diff(*clash.command, common), add_clash_set(*clash.command, common),
       add_clash_list(*clash.command, common), add_clash_history(*clash.command, common), clash,
       add_draw_diff(*draw.command, common), draw, info, add_rules_verb(program),
       add_report(program, common), add_view(program, common), add_convert(program, common),
       add_generate(program, common), add_evaluate(program, common), add_help(program),
       add_man(program), add_completion(program)});
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text;
    program.exit(wanted, text);
    const Status written = write_stdout(text.str());
    return written ? static_cast<int>(ExitCode::done) : ended_by(written.error(), console);
  } catch (const CLI::ParseError& error) {
    return ended_by(usage_error(program, error), console);
  }
  if (const Status status = check_no_empty_values(program); !status)
    return ended_by(status.error(), console);
  // No thread has begun yet, and no signal waits for one.
  if (!common.scheduler.empty())
    return ended_by(go_on_cluster(std::span(argv, static_cast<std::size_t>(argc)).subspan(1)),
                    console);
  for (const Verb& verb : verbs)
    if (verb.command->parsed()) return run_verb(verb, common, console);
  return static_cast<int>(ExitCode::internal);
}

}  // namespace strake::cli
