// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_decisions.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "clash/results/reported.hpp"
#include "cli/options/options.hpp"
#include "core/output_format.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"

namespace strake::cli {

namespace {

/// Whether the file is as it was read.
bool is_unchanged(const DecisionRequest& request) {
  std::error_code ignored;
  const std::filesystem::path file = request.file.name;
  if (!request.exists) return !std::filesystem::exists(file, ignored);
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return in && text == request.file.text;
}

void print_lines(Console& console, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    console.note(std::string(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// Takes the contacts that are only counted out of findings, without those that have a row.
Status count_contacts(Session& session, const report::DecidedResults& decided,
                      clash::Findings& findings) {
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    clash::Report& test = findings.tests[t];
    test.options.engine.contacts = clash::Contacts::count;
    const Status status = clash::leave_out_contacts(
        session.context(), test,
        [&](const clash::Pair& pair) { return decided.of(t, pair) != nullptr; });
    if (!status) return status;
  }
  return {};
}

std::string rows_text(std::uint64_t rows) { return counted(rows, "row"); }

}  // namespace

void add_decision_options(CLI::App& command, DecisionInput& options) {
  constexpr const char* kGroup = "Decisions";
  CLI::Option* const file =
      command
          .add_option("--decisions", options.file,
                      "What was decided about clashes, .csv with the columns key, status (new, "
                      "active, reviewed, approved, resolved), by, date and comment: approved ones "
                      "are counted apart and stop no --fail-on, resolved ones that are found again "
                      "are told")
          ->type_name("FILE")
          ->group(kGroup);
  command
      .add_flag("--write-decisions", options.write,
                "Add the results that the file of --decisions does not have, as new; its rows "
                "and columns stay, and a file that is not there is made")
      ->group(kGroup)
      ->needs(file);
  command
      .add_option("--deeper", options.deeper,
                  "An approved clash that is deeper or nearer than it was by more than this is "
                  "listed again, as is one of a severer class (default 1mm)")
      ->type_name("LENGTH")
      ->group(kGroup);
  add_match_files_option(command, options.match_files)->group(kGroup)->needs(file);
}

Result<std::optional<DecisionRequest>> decision_request(const DecisionInput& input) {
  if (input.file.empty()) return std::optional<DecisionRequest>();
  DecisionRequest request;
  request.deeper_mm = report::DecisionRules{}.deeper_mm;
  if (const Status status = length_option(request.deeper_mm, input.deeper, "--deeper"); !status)
    return status.error();
  std::error_code ignored;
  request.exists = std::filesystem::exists(input.file, ignored);
  if (!request.exists && !input.write)
    return Error{ErrorCode::input, "cannot be read: there is no such file", input.file,
                 "check the path, or add --write-decisions, which makes it"};
  request.file.name = input.file;
  if (!request.exists) return std::optional(std::move(request));
  Result<report::DecisionFile> read = report::read_decisions(input.file);
  if (!read) return read.error();
  request.file = std::move(*read);
  return std::optional(std::move(request));
}

Result<std::optional<report::DecidedResults>> decide(Session& session, const DecisionInput& input,
                                                     const std::optional<DecisionRequest>& request,
                                                     clash::Findings& findings,
                                                     const model::Model& model,
                                                     bool counts_contacts) {
  if (!request) return std::optional<report::DecidedResults>();
  const auto timer = session.step("look up decisions");
  const report::DecisionRules rules{request->deeper_mm, input.match_files};
  Result<report::DecidedResults> decided = report::decide(findings, model, request->file, rules);
  if (!decided) return decided.error();
  if (counts_contacts) {
    if (const Status status = count_contacts(session, *decided, findings); !status)
      return status.error();
    decided = report::decide(findings, model, request->file, rules);
    if (!decided) return decided.error();
  }
  if (const std::uint64_t count = decided->count_regions_unknown(); count > 0)
    session.console().note(fmt::format(
        "{}: {} at places that this run does not count: whether the two meet at more places now is "
        "not known (--regions 0 and --narrow-phase sphere-subdivision count none)",
        input.file, counted(count, "clash is approved", "clashes are approved")));
  for (const std::string& pair : decided->renamed_before)
    session.console().note(
        fmt::format("--match-files {}: {} has the new name already", printable(pair), input.file));
  print_lines(session.console(), report::file_matches_text(decided->files));
  return std::optional(std::move(*decided));
}

Status write_decisions(Session& session, const DecisionInput& input, const DecisionRequest& request,
                       const report::ClashContents& contents) {
  if (!input.write) return {};
  const report::UpdatedDecisions updated = report::update_decisions(contents);
  if (updated.without_row > 0)
    session.console().note(fmt::format("{}: {} no row: their keys stand there for another place",
                                       input.file,
                                       counted(updated.without_row, "result has", "results have")));
  if (request.exists && updated.text == request.file.text) return {};
  const Status status = session.write(input.file, [&](Session::Sink sink) -> Status {
    if (!is_unchanged(request))
      return Error{ErrorCode::output, "was changed while the run went on, and is left as it is",
                   input.file, "run the test again"};
    sink(updated.text);
    return {};
  });
  if (!status) return status;
  session.console().note(fmt::format("{}: {} added", input.file, rows_text(updated.added)));
  if (updated.taken_out > 0)
    session.console().note(fmt::format("{}: {} without a decision replaced by decided ones",
                                       input.file, rows_text(updated.taken_out)));
  return {};
}

}  // namespace strake::cli
