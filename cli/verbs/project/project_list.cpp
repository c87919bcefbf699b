// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "cli/output/shown_text.hpp"
#include "cli/verbs/project/project_verbs.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "strake/project/listing.hpp"

namespace strake::cli {

namespace {

using project::Cell;
using project::Listing;

struct ListOptions {
  ProjectArgument project;
  std::string kind, rows;
};

constexpr std::uint64_t kRowsShown = 20;

bool is_number(const Cell& cell) {
  return std::holds_alternative<std::int64_t>(cell) || std::holds_alternative<double>(cell);
}

std::string cell_text(const Cell& cell) {
  if (const auto* const integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* const real = std::get_if<double>(&cell)) return fixed(*real, 3);
  if (const auto* const text = std::get_if<std::string>(&cell)) return shown_cell(*text);
  return "-";
}

std::string list_text(const Listing& list) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < list.columns.size(); ++c) {
    widths.push_back(list.columns[c].size());
    for (const std::vector<Cell>& row : list.rows)
      widths[c] = std::max(widths[c], report::columns_in(cell_text(row[c])));
  }
  std::string text, line;
  const auto add = [&](std::size_t c, const std::string& cell, bool right) {
    line += (c == 0 ? "" : "  ") + (right ? report::right_aligned(cell, widths[c])
                                          : report::left_aligned(cell, widths[c]));
  };
  for (std::size_t c = 0; c < list.columns.size(); ++c)
    add(c, list.columns[c], !list.rows.empty() && is_number(list.rows.front()[c]));
  text += report::ended(line);
  for (const std::vector<Cell>& row : list.rows) {
    line.clear();
    for (std::size_t c = 0; c < row.size(); ++c) add(c, cell_text(row[c]), is_number(row[c]));
    text += report::ended(line);
  }
  if (list.all > list.rows.size())
    text += fmt::format("… and {} more (--rows)\n", list.all - list.rows.size());
  return text;
}

void append_cell(std::string& out, const Cell& cell) {
  if (const auto* const text = std::get_if<std::string>(&cell))
    append_json_string(out, *text);
  else if (const auto* const real = std::get_if<double>(&cell))
    append_shortest(out, *real);
  else if (const auto* const integer = std::get_if<std::int64_t>(&cell))
    out += std::to_string(*integer);
  else
    out += "null";
}

std::string list_json(const Listing& list, const std::string& kind) {
  std::string out = "{\n  \"schema_version\": 1,\n  \"list\": ";
  append_json_string(out, kind);
  out += fmt::format(",\n  \"all\": {},\n  \"rows\": [", list.all);
  for (std::size_t r = 0; r < list.rows.size(); ++r) {
    out += r == 0 ? "\n    {" : ",\n    {";
    for (std::size_t c = 0; c < list.columns.size(); ++c) {
      if (c > 0) out += ", ";
      append_json_string(out, list.columns[c]);
      out += ": ";
      append_cell(out, list.rows[r][c]);
    }
    out += '}';
  }
  return out + (list.rows.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

Result<ExitCode> run_list(Session& session, const ListOptions& given) {
  std::uint64_t rows = kRowsShown;
  if (const Status s = whole_number(rows, given.rows, "--rows"); !s) return s.error();
  const std::string name = given.kind.empty() ? "files" : given.kind;
  const auto kind = std::ranges::find(project::kListNames, name);
  Result<project::Project> project = open_argument(session, given.project, project::Access::read);
  if (!project) return project.error();
  const Result<Listing> list =
      project::list(*project, static_cast<project::ListKind>(kind - project::kListNames.begin()),
                    rows, session.context());
  if (!list) return list.error();
  const Status written =
      session.write_stdout(session.json() ? list_json(*list, name) : list_text(*list));
  if (!written) return written.error();
  return ExitCode::done;
}

}  // namespace

Verb add_project_list(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* const command = project.add_subcommand("list", "What a project holds, line by line");
  add_project_argument(*command, options->project, project::Access::read);
  add_choice(*command, "what", options->kind,
             {project::kListNames.begin(), project::kListNames.end()},
             "Model files, the most used shapes, changes of the model, tests, their runs, clashes "
             "or views (default files)");
  command
      ->add_option("--rows", options->rows,
                   fmt::format("Most rows shown; 0: all (default {})", kRowsShown))
      ->type_name("N");
  add_common_options(*command, common);
  command->footer(R"(
Examples:
  strake project list ship.strake
  strake project list ship.strake shapes --rows 5
  strake project list ship.strake clashes --json)");
  return {command, [options](Session& session) { return run_list(session, *options); }};
}

}  // namespace strake::cli
