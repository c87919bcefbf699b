// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli/evaluate/compare.hpp"
#include "cli/evaluate/evaluation.hpp"
#include "cli/evaluate/machine.hpp"
#include "cli/evaluate/pages/bar_chart.hpp"
#include "cli/evaluate/pages/pages.hpp"
#include "cli/evaluate/pages/peer_table.hpp"
#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/peers/peer_runs.hpp"
#include "cli/evaluate/record_json.hpp"
#include "cli/verbs/verb.hpp"
#include "core/number.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

namespace fs = std::filesystem;

struct EvaluateOptions {
  std::string folder, scale, threads, repeat, limit, only, compare, peers, peer_limit;
  bool fresh = false;
};

/// Returns what stands between the commas of a list.
std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

/// Reads a positive number; overwrites `value` where it was given.
Status positive_number(double& value, const std::string& text, const std::string& option,
                       double maximum) {
  if (text.empty()) return {};
  const std::optional<double> number = parse_number(text);
  if (!number || !(*number > 0) || !(*number <= maximum))
    return Error{ErrorCode::usage, "'" + text + "' cannot be taken", option,
                 fmt::format("write a number above 0, {:g} at most", maximum)};
  value = *number;
  return {};
}

/// Returns the numbers of workers, ascending, one among them: by default 1, 2, 4 and so on, up to
/// the cores.
Result<std::vector<unsigned>> team_sizes(const std::string& text) {
  std::vector<unsigned> sizes{1};
  if (text.empty()) {
    const unsigned maximum = parallel::default_workers();
    for (unsigned n = 2; n < maximum; n *= 2) sizes.push_back(n);
    sizes.push_back(maximum);
  } else {
    for (const std::string& part : parts_of(text)) {
      std::uint64_t size = 0;
      if (!whole_number(size, part, "--threads") || size < 1 || size > parallel::Team::kMaxWorkers)
        return Error{ErrorCode::usage, "'" + part + "' is no number of workers", "--threads",
                     fmt::format("write numbers from 1 to {}: 1,2,4", parallel::Team::kMaxWorkers)};
      sizes.push_back(static_cast<unsigned>(size));
    }
  }
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  return sizes;
}

/// Returns the cases that are requested: without --only all that can be measured.
Result<std::vector<std::string>> chosen_cases(const std::string& only, bool has_peers) {
  const std::vector<CaseGroup> groups = case_groups();
  std::vector<std::string> chosen, known;
  for (const CaseGroup& group : groups) {
    known.push_back(group.name);
    known.insert(known.end(), group.cases.begin(), group.cases.end());
  }
  for (const std::string& part : only.empty() ? std::vector<std::string>{} : parts_of(only)) {
    if (std::ranges::find(known, part) == known.end())
      return Error{ErrorCode::usage, "there is no case '" + part + "'", "--only",
                   fmt::format("there are {}", fmt::join(known, ", "))};
    chosen.push_back(part);
  }
  std::vector<std::string> cases;
  for (const CaseGroup& group : groups) {
    const bool needs_peers = group.name == kPeersGroup && !has_peers;
    const bool whole =
        only.empty() ? !needs_peers : std::ranges::find(chosen, group.name) != chosen.end();
    for (const std::string& one : group.cases) {
      if (!whole && std::ranges::find(chosen, one) == chosen.end()) continue;
      if (needs_peers)
        return Error{ErrorCode::usage, "'" + one + "' needs programs of its own", "--only",
                     "give --peers the folder of the programs that './run bench --build' builds"};
      cases.push_back(one);
    }
  }
  return cases;
}

/// Returns "views (plan-lower, ...), ships (...)".
std::string described_groups() {
  std::vector<std::string> texts;
  for (const CaseGroup& group : case_groups())
    texts.push_back(fmt::format("{} ({})", group.name, fmt::join(group.cases, ", ")));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Result<EvaluationSettings> settings_of(const EvaluateOptions& given) {
  constexpr double kLargestScale = 4, kLongestLimitSeconds = 1e6, kLimitAtFullScaleSeconds = 60;
  EvaluationSettings settings;
  if (const Status s = positive_number(settings.scale, given.scale, "--scale", kLargestScale); !s)
    return s.error();
  settings.limit_s = std::max(2.0, kLimitAtFullScaleSeconds * settings.scale);
  if (const Status s =
          positive_number(settings.limit_s, given.limit, "--limit", kLongestLimitSeconds);
      !s)
    return s.error();
  constexpr std::uint64_t kMaxRounds = 1000;
  if (!whole_number(settings.repeat, given.repeat, "--repeat") || settings.repeat < 1 ||
      settings.repeat > kMaxRounds)
    return Error{ErrorCode::usage, "'" + given.repeat + "' is no number of rounds", "--repeat",
                 fmt::format("write a number from 1 to {}", kMaxRounds)};
  const Result<std::vector<unsigned>> threads = team_sizes(given.threads);
  if (!threads) return threads.error();
  settings.threads = *threads;
  return settings;
}

/// Returns where peers are, if they are requested.
Result<std::optional<PeerPrograms>> peer_programs(const EvaluateOptions& given,
                                                  const EvaluationSettings& settings,
                                                  const fs::path& folder) {
  constexpr double kLongestLimitSeconds = 1e6, kLimitAtFullScaleSeconds = 900, kMinSeconds = 60;
  PeerPrograms programs{given.peers, folder / kPeersGroup,
                        std::max(kMinSeconds, kLimitAtFullScaleSeconds * settings.scale)};
  if (const Status s =
          positive_number(programs.limit_s, given.peer_limit, "--peer-limit", kLongestLimitSeconds);
      !s)
    return s.error();
  if (given.peers.empty()) return std::optional<PeerPrograms>();
  std::error_code failure;
  if (!fs::is_directory(programs.folder, failure))
    return Error{ErrorCode::usage, "there is no such folder", given.peers,
                 "give --peers the folder of the programs that './run bench --build' builds"};
  return std::optional(std::move(programs));
}

bool is_of(const Machine& x, const Machine& y) {
  return x.processor == y.processor && x.system == y.system && x.compiler == y.compiler &&
         x.version == y.version && x.program == y.program &&
         x.hardware_threads == y.hardware_threads;
}

/// Returns what the folder holds already of this evaluation, or an empty one; with --fresh without
/// the cases that are to be measured.
Result<EvaluationRecord> begun_record(const EvaluateOptions& given, const fs::path& file,
                                      const std::vector<std::string>& names,
                                      const EvaluationSettings& settings) {
  EvaluationRecord empty;
  empty.machine = this_machine();
  empty.settings = settings;
  std::error_code failure;
  if (!fs::exists(file, failure)) return empty;
  Result<EvaluationRecord> record = read_evaluation(file.string());
  const bool goes_on =
      record && record->settings == settings && is_of(record->machine, empty.machine);
  if (!given.fresh) {
    if (!record) return record.error();
    if (goes_on) return record;
    return Error{ErrorCode::usage,
                 "it was made with other settings, by another build or on another machine",
                 file.string(), "give --fresh to begin again, or another -o"};
  }
  if (!goes_on) return empty;
  const auto is_requested = [&](const auto& one) {
    return std::ranges::find(names, one.name) != names.end();
  };
  std::erase_if(record->cases, is_requested);
  std::erase_if(record->studies, is_requested);
  std::erase_if(record->peers, is_requested);
  return record;
}

/// Returns the evaluation to compare with, if one is named.
Result<std::optional<EvaluationRecord>> earlier_record(Session& session,
                                                       const EvaluateOptions& given,
                                                       const fs::path& state,
                                                       const EvaluationSettings& settings) {
  if (given.compare.empty()) return std::optional<EvaluationRecord>();
  std::error_code failure;
  const bool is_replaced = fs::equivalent(given.compare, state, failure);
  if (is_replaced && !given.fresh)
    return Error{ErrorCode::usage, "it is the evaluation that is gone on with", given.compare,
                 "keep a copy of the earlier one, or give another -o"};
  // With --fresh it may be what this run replaces, as asked, once it is read.
  if (!is_replaced)
    if (const Status status = session.files().add_input(given.compare); !status)
      return status.error();
  Result<EvaluationRecord> record = read_evaluation(given.compare);
  if (!record) return record.error();
  if (const Status status = check_comparable(record->settings, settings); !status)
    return status.error();
  return std::optional(std::move(*record));
}

Status write_pages(Session& session, const fs::path& folder, const EvaluationRecord& record) {
  const auto write = [&](const std::string& name, const std::string& text) {
    return session.write(folder / name, [&](Session::Sink sink) {
      sink(text);
      return Status{};
    });
  };
  for (const TableSection& section : sections_of(record))
    for (std::size_t n = 0; n < section.charts.size(); ++n) {
      const fs::path file = folder / chart_file(section, n);
      if (const Status status = session.will_write(file); !status) return status;
      if (const Status status = write_file(file, bar_chart_svg(section.charts[n])); !status)
        return status;
    }
  if (const Status status = write("evaluation.csv", evaluation_csv(record)); !status) return status;
  if (!record.studies.empty())
    if (const Status status = write("evaluation-studies.csv", studies_csv(record)); !status)
      return status;
  if (!record.peers.empty())
    if (const Status status = write("evaluation-peers.csv", peers_csv(record)); !status)
      return status;
  if (const Status status = write("evaluation.md", evaluation_markdown(record)); !status)
    return status;
  return write("evaluation.html", evaluation_html(record));
}

/// Prints what became of an earlier evaluation; false where work grew, or nothing was compared.
bool print_comparison(Console& console, const Comparison& comparison, const std::string& file) {
  console.note(fmt::format(
      "{} counters of work compared with {}: {} grew by more than 1 %, {} "
      "shrank",
      comparison.compared, file, comparison.more_work.size(), comparison.less_work.size()));
  for (const std::string& line : comparison.less_work) console.note("less work: " + line);
  for (const std::string& line : comparison.slower) console.note("slower: " + line);
  for (const std::string& line : comparison.missing) console.note("not measured here: " + line);
  for (const std::string& line : comparison.other_results)
    console.warn("another result than before: " + line);
  for (const std::string& line : comparison.more_work) console.warn("more work: " + line);
  if (comparison.compared == 0) console.warn("nothing could be compared with " + file);
  return comparison.more_work.empty() && comparison.other_results.empty() &&
         comparison.compared > 0;
}

Result<ExitCode> run_evaluate(Session& session, const EvaluateOptions& given) {
  const Result<EvaluationSettings> settings = settings_of(given);
  if (!settings) return settings.error();
  const Result<std::vector<std::string>> names = chosen_cases(given.only, !given.peers.empty());
  if (!names) return names.error();
  const fs::path folder = given.folder.empty() ? "evaluation" : given.folder;
  const Result<std::optional<PeerPrograms>> peers = peer_programs(given, *settings, folder);
  if (!peers) return peers.error();
  const fs::path state = folder / "evaluation.json";
  const Result<std::optional<EvaluationRecord>> before =
      earlier_record(session, given, state, *settings);
  if (!before) return before.error();
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure)
    return Error{ErrorCode::output, "the folder cannot be made: " + failure.message(),
                 folder.string(), "give -o another folder"};
  Result<EvaluationRecord> record = begun_record(given, state, *names, *settings);
  if (!record) return record.error();
  if (!record->cases.empty())
    session.console().note(fmt::format("{} holds {} cases, which are not measured again",
                                       state.string(), record->cases.size()));
  const EvaluationHooks hooks{[&](const std::string& what) { (void)session.step(what); },
                              [&](const std::string& done, const EvaluationRecord& now) {
                                session.console().note(done);
                                if (Status s = session.will_write(state); !s) return s;
                                return write_file(state, evaluation_json(now));
                              },
                              *peers};
  if (const Status status = evaluate(*names, *record, session.context().stop, hooks); !status)
    return status.error();
  if (const Status status = write_pages(session, folder, *record); !status) return status.error();
  if (session.json())
    if (const Status status = session.write_stdout(evaluation_json(*record)); !status)
      return status.error();
  bool good = true;
  for (const std::string& line : differences_of(*record)) {
    session.console().warn("different: " + line);
    good = false;
  }
  if (*before) {
    const Result<Comparison> comparison = compare_evaluations(**before, *record);
    if (!comparison) return comparison.error();
    good = print_comparison(session.console(), *comparison, given.compare) && good;
  }
  return good ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace

Verb add_evaluate(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* const command = program.add_subcommand(
      "evaluate",
      "Speed-ups, equality and work on 13 views and 4 ships, beside the thesis's figures");
  command
      ->add_option("-o,--output", options->folder,
                   "The folder for the page (.html), its parts (.md, .svg), the figures (.csv) and "
                   "all of it (.json); what it holds already is not measured again (default "
                   "evaluation)")
      ->type_name("FOLDER")
      ->group("Output");
  command
      ->add_option("--scale", options->scale,
                   "Size of the ships: 1 is 100,000 objects for views and more than a million for "
                   "clashes, 0.02 takes a minute (default 1)")
      ->type_name("NUMBER");
  command
      ->add_option("--only", options->only,
                   "The cases to measure, or groups of them: " + described_groups())
      ->type_name("NAMES");
  command
      ->add_option("--threads", options->threads,
                   "Numbers of workers to measure besides 1 (default: 2, 4 and so on, up to the "
                   "cores)")
      ->type_name("N,N,...");
  command
      ->add_option("--repeat", options->repeat,
                   "Rounds at least; up to three times as many on a noisy machine (default 3)")
      ->type_name("N");
  command
      ->add_option(
          "--limit", options->limit,
          "Seconds after which a run of the thesis's own way is stopped (default 60 at scale 1, "
          "less at smaller ones)")
      ->type_name("SECONDS");
  command
      ->add_option("--peers", options->peers,
                   "The folder of bench_clash_peers and bench_hidden_lines_peers, which run other "
                   "programs on the same triangles; scenes stay in the output folder's 'peers'")
      ->type_name("FOLDER");
  command
      ->add_option("--peer-limit", options->peer_limit,
                   "Seconds after which a peer is stopped (default 900 at scale 1, less at smaller "
                   "ones, 60 at least)")
      ->type_name("SECONDS");
  command
      ->add_option("--compare", options->compare,
                   "An evaluation.json from before: says what takes more work or time since, and "
                   "which results are others; exit code 1 for work and results")
      ->type_name("FILE");
  command->add_flag("--fresh", options->fresh, "Measure again what the folder holds already");
  command->add_flag("--quiet", common.quiet, "No narration and no progress, errors only")
      ->group("Running");
  command->add_flag("--json", common.json, "The evaluation on standard output as JSON")
      ->group("Output");
  command->footer(R"(
Every result is compared with that of the sequential run, byte by byte; a difference is exit code 1.
So is a peer whose result is not Strake's, but for what is stated of it.
An interrupted evaluation goes on where it was. docs/evaluation.md explains the tables.

Examples:
  strake evaluate --scale 0.02
  strake evaluate --threads 1,2,4,8,16 -o sixteen
  strake evaluate --scale 0.02 --only iso,dense --compare before/evaluation.json
  strake evaluate --scale 0.02 --only peers --peers build/bench/bin)");
  return {command, [options](Session& session) { return run_evaluate(session, *options); }};
}

}  // namespace strake::cli
