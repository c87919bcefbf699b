// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>

#include "cli/output/shown_text.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/columns.hpp"
#include "report/text/csv.hpp"
#include "report/text/formatting.hpp"

namespace strake::cli {

namespace {

using Cell = ClashLines::Cell;

Cell text_or_nothing(const std::string& text) { return text.empty() ? Cell() : Cell(text); }

Cell count(std::uint64_t n) { return static_cast<std::int64_t>(n); }

std::string cell_text(const Cell& cell) {
  if (const auto* const text = std::get_if<std::string>(&cell)) return shown_cell(*text);
  if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  if (const auto* const real = std::get_if<double>(&cell)) return fmt::format("{:.3f}", *real);
  return {};
}

bool is_number(const Cell& cell) {
  return std::holds_alternative<std::int64_t>(cell) || std::holds_alternative<double>(cell);
}

void append_cell(std::string& out, const Cell& cell) {
  if (const auto* const text = std::get_if<std::string>(&cell))
    report::append_json(out, *text);
  else if (const auto* const whole = std::get_if<std::int64_t>(&cell))
    out += std::to_string(*whole);
  else if (const auto* const real = std::get_if<double>(&cell))
    report::append_mm(out, *real);
  else
    out += "null";
}

}  // namespace

std::string ClashLines::csv() const {
  std::string out;
  const report::CsvForm form;
  report::CsvRow head(out, form);
  for (const std::string_view column : columns) head.word(column);
  head.end();
  for (const std::vector<Cell>& cells : rows) {
    report::CsvRow row(out, form);
    for (const Cell& cell : cells) {
      if (const auto* const text = std::get_if<std::string>(&cell))
        row.text(*text);
      else if (const auto* const real = std::get_if<double>(&cell))
        row.number(*real, report::append_mm);
      else
        row.word(cell_text(cell));
    }
    row.end();
  }
  return out;
}

std::string ClashLines::json() const {
  std::string out = "{\"schema_version\": 1, ";
  report::append_list(
      out, kind, rows,
      [&](const std::vector<Cell>& cells) {
        out += '{';
        for (std::size_t c = 0; c < cells.size(); ++c) {
          if (c > 0) out += ", ";
          report::append_key(out, columns[c]);
          append_cell(out, cells[c]);
        }
        out += '}';
      },
      "\n");
  return out + "}\n";
}

std::string ClashLines::table() const {
  std::vector<std::vector<std::string>> texts;
  std::vector<std::string> head;
  for (const std::size_t c : shown) head.emplace_back(columns[c]);
  texts.push_back(std::move(head));
  for (const std::vector<Cell>& cells : rows) {
    std::vector<std::string>& line = texts.emplace_back();
    for (const std::size_t c : shown) line.push_back(cell_text(cells[c]));
  }
  std::vector<std::size_t> widths(shown.size());
  for (const std::vector<std::string>& line : texts)
    for (std::size_t c = 0; c < line.size(); ++c)
      widths[c] = std::max(widths[c], report::columns_in(line[c]));
  std::string out;
  for (const std::vector<std::string>& line : texts) {
    std::string text;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const bool right = !rows.empty() && is_number(rows.front()[shown[c]]);
      text += (right ? report::right_aligned(line[c], widths[c])
                     : report::left_aligned(line[c], widths[c])) +
              "  ";
    }
    out += report::ended(std::move(text));
  }
  return out;
}

namespace {

/// Adds the number and the key of the group of each clash, whose key is in the first column.
void add_groups(ClashLines& lines, const std::vector<ProjectGroup>& groups) {
  std::map<std::string_view, std::size_t> group_of;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::string& key : groups[g].clashes) group_of.emplace(key, g);
  lines.shown.push_back(lines.columns.size());
  lines.shown.push_back(lines.columns.size() + 1);
  lines.columns.insert(lines.columns.end(), {"group", "group_key"});
  for (std::vector<Cell>& cells : lines.rows) {
    const auto at = group_of.find(std::get<std::string>(cells.front()));
    const bool has_group = at != group_of.end();
    cells.push_back(has_group ? count(at->second + 1) : Cell());
    cells.push_back(has_group ? Cell(groups[at->second].key) : Cell());
  }
}

}  // namespace

ClashLines lines_of(const std::vector<project::ListedClash>& clashes,
                    const std::vector<ProjectGroup>* groups) {
  ClashLines lines;
  lines.kind = "clashes";
  lines.columns = {"key",      "status",   "by",        "date",     "comment",  "class",
                   "d_mm",     "x_mm",     "y_mm",      "z_mm",     "regions",  "test",
                   "a_file",   "a_id",     "a_name",    "b_file",   "b_id",     "b_name",
                   "relation", "assignee", "first_run", "last_run", "gone_run", "cannot_tell"};
  lines.shown = {0, 1, 5, 6, 14, 17, 2, 19, 4};
  const auto has_other_test = [&](const project::ListedClash& clash) {
    return clash.test != clashes.front().test;
  };
  if (std::ranges::any_of(clashes, has_other_test)) lines.shown.insert(lines.shown.begin() + 2, 11);
  const auto is_unknown = [](const project::ListedClash& clash) {
    return !clash.row.unknown.empty();
  };
  if (std::ranges::any_of(clashes, is_unknown)) lines.shown.push_back(23);
  for (const auto& [row, test, status, last_run] : clashes) {
    std::vector<Cell>& cells = lines.rows.emplace_back();
    const auto add = [&](auto... values) { (cells.emplace_back(std::move(values)), ...); };
    add(row.key, std::string(name(status)), text_or_nothing(row.decided_by),
        text_or_nothing(row.decided_at.substr(0, row.decided_at.find('T'))),
        text_or_nothing(row.comment), std::string(name(row.now.cls)), row.now.d_mm, row.point_mm.x,
        row.point_mm.y, row.point_mm.z);
    add(row.now.regions == 0 ? Cell() : count(row.now.regions), test);
    for (const project::ClashSide* const side : {&row.a, &row.b})
      add(side->file, side->id, side->name);
    add(std::string(name(row.relation)), text_or_nothing(row.assignee), row.first_run);
    const bool is_there = !row.gone_run && row.unknown.empty();
    add(is_there ? Cell(last_run) : Cell(), row.gone_run ? Cell(*row.gone_run) : Cell(),
        text_or_nothing(row.unknown));
  }
  if (groups != nullptr) add_groups(lines, *groups);
  return lines;
}

ClashLines lines_of(const std::vector<project::TrendRow>& runs) {
  ClashLines lines;
  lines.kind = "runs";
  lines.columns = {"run",
                   "started",
                   "program",
                   "who",
                   "test",
                   "how",
                   "seconds",
                   "objects",
                   "changed_objects",
                   "tested_pairs",
                   "kept_results",
                   "hit",
                   "contact",
                   "clearance_violation",
                   "allowed",
                   "appeared",
                   "gone",
                   "new",
                   "active",
                   "reviewed",
                   "approved",
                   "resolved",
                   "cannot_tell"};
  lines.shown = {0, 1, 3, 4, 5, 8, 11, 12, 13, 15, 16, 17, 18, 19, 20, 21, 22};
  for (const project::TrendRow& r : runs) {
    std::vector<Cell>& cells = lines.rows.emplace_back();
    cells = {r.run, r.started, r.program, r.who, r.test, r.how, r.seconds};
    for (const std::uint64_t n :
         {r.objects, r.changed_objects, r.tested_pairs, r.kept_results, r.hit, r.contact,
          r.clearance_violation, r.allowed, r.appeared, r.gone, r.fresh, r.active, r.reviewed,
          r.approved, r.resolved, r.cannot_tell})
      cells.push_back(count(n));
  }
  return lines;
}

ClashLines lines_of(const std::vector<project::ClashEvent>& events) {
  ClashLines lines;
  lines.kind = "events";
  lines.columns = {"at", "who", "run", "before", "after", "comment"};
  lines.shown = {0, 1, 2, 3, 4, 5};
  for (const project::ClashEvent& e : events)
    lines.rows.push_back({e.at, e.who, e.run ? Cell(*e.run) : Cell(), std::string(name(e.before)),
                          std::string(name(e.after)), text_or_nothing(e.comment)});
  return lines;
}

}  // namespace strake::cli
