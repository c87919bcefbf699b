// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/pages/pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "cli/evaluate/pages/bar_chart.hpp"
#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/statistics.hpp"
#include "report/text/csv.hpp"
#include "strake/drawing/write.hpp"

namespace strake::cli {

namespace {

constexpr std::string_view kTitle = "Evaluation of Strake beside the thesis";

constexpr std::string_view kStyle = R"(
body { font: 15px/1.5 sans-serif; margin: 2em auto; max-width: 1100px; padding: 0 1em; color: #222; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; }
th, td { padding: 3px 9px; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top; }
th:first-child, td:first-child { text-align: left; }
td { font-variant-numeric: tabular-nums; }
.wrong { color: #b00020; font-weight: bold; } .note { color: #555; }
svg { width: 100%; height: auto; }
)";

/// Says whether all results were equal.
std::string verdict(const EvaluationRecord& record) {
  const std::size_t differences = differences_of(record).size();
  if (differences > 0)
    return fmt::format("{} results differ that must be equal: see below.", differences);
  std::size_t compared = 0, unfinished = 0;
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages)
      for (const ContenderRecord& run : stage.contenders) {
        if (!run.unfinished.empty()) ++unfinished;
        if (!run.published_hash.empty() && &run != &stage.contenders.front()) ++compared;
      }
  if (compared == 0) return "No cases were measured whose results are compared.";
  return fmt::format(
      "All {} results and published documents that were compared are equal to those of "
      "the first sequential run, byte by byte.{}",
      compared,
      unfinished == 0 ? std::string()
                      : fmt::format(" {} runs were stopped before they had a result.", unfinished));
}

/// Says how far this machine can tell; nothing where nothing was measured twice.
std::string resolution(const EvaluationRecord& record) {
  double worst = 0;
  std::string where;
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages)
      if (const double noise = timing_noise(stage); noise >= worst) {
        worst = noise;
        where = one.name + ", " + stage.name;
      }
  if (where.empty()) return {};
  return fmt::format(
      "The same contender twice differed by up to {:.1f} % ({}): a speed-up that is "
      "nearer to another than that is not told from it.",
      100 * worst, where);
}

void put_table(const Table& table, std::string& out) {
  out += "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& column : table.columns)
    out += "<th>" + drawing::xml_escaped(column) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    out += "<tr>";
    for (const std::string& cell : row)
      out += (cell == "NO" || cell.starts_with("NO: ") ? "<td class=\"wrong\">" : "<td>") +
             drawing::xml_escaped(cell) + "</td>";
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
}

std::string markdown_cell(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|' || c == '\\') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

void put_row(const std::vector<std::string>& cells, std::string& out) {
  out += '|';
  for (const std::string& cell : cells) out += ' ' + markdown_cell(cell) + " |";
  out += '\n';
}

}  // namespace

std::string evaluation_html(const EvaluationRecord& record) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p{2}>{3}</p>\n<p>{4}</p>\n",
      kTitle, kStyle, differences_of(record).empty() ? "" : " class=\"wrong\"",
      drawing::xml_escaped(verdict(record)), drawing::xml_escaped(resolution(record)));
  for (const std::string& line : differences_of(record))
    out += "<p class=\"wrong\">" + drawing::xml_escaped(line) + "</p>\n";
  for (const TableSection& section : sections_of(record)) {
    out += "<h2>" + drawing::xml_escaped(section.table.title) + "</h2>\n";
    for (const BarChart& chart : section.charts)
      out += "<figure>\n" + bar_chart_svg(chart) + "</figure>\n";
    if (!section.table.note.empty())
      out += "<p class=\"note\">" + drawing::xml_escaped(section.table.note) + "</p>\n";
    put_table(section.table, out);
  }
  out += "</body>\n</html>\n";
  return out;
}

std::string chart_file(const TableSection& section, std::size_t n) {
  return fmt::format("chart-{}-{}.svg", section.id, n + 1);
}

std::string evaluation_markdown(const EvaluationRecord& record) {
  std::string out = fmt::format("# {}\n\n{}\n\n{}\n", kTitle, verdict(record), resolution(record));
  for (const std::string& line : differences_of(record)) out += "\n- " + line;
  for (const TableSection& section : sections_of(record)) {
    const auto& [id, table, charts] = section;
    out += "\n## " + table.title + "\n\n";
    for (std::size_t n = 0; n < charts.size(); ++n)
      out += fmt::format("![{}]({})\n\n", charts[n].title, chart_file(section, n));
    if (!table.note.empty()) out += table.note + "\n\n";
    put_row(table.columns, out);
    out += '|';
    for (std::size_t c = 0; c < table.columns.size(); ++c) out += c == 0 ? " --- |" : " ---: |";
    out += '\n';
    for (const std::vector<std::string>& row : table.rows) put_row(row, out);
  }
  return out;
}

std::string evaluation_csv(const EvaluationRecord& record) {
  std::string out =
      "case,objects,bodies,triangles,stage,contender,threads,rounds,median_s,least_s,cpu_s,"
      "peak_bytes,reference_s,result_hash,published_hash,unfinished\n";
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages)
      for (const ContenderRecord& run : stage.contenders) {
        const double least = run.seconds.empty() ? 0 : *std::ranges::min_element(run.seconds);
        const auto at_end = std::back_inserter(out);
        fmt::format_to(at_end, "{},{},{},{},{},", one.name, one.objects, one.bodies, one.triangles,
                       stage.name);
        report::append_csv(out, run.name);
        fmt::format_to(at_end, ",{},{},{},{},{},{},{},{},{},", run.threads, run.seconds.size(),
                       median(run.seconds), least, run.cpu_s, run.peak_bytes, stage.reference_s,
                       run.hash, run.published_hash);
        report::append_csv(out, run.unfinished);
        out += '\n';
      }
  return out;
}

std::string studies_csv(const EvaluationRecord& record) {
  std::string out = "study,row,column,value\n";
  for (const StudyRecord& study : record.studies)
    for (std::size_t r = 0; r < study.rows.size(); ++r)
      for (std::size_t c = 0; c < study.columns.size(); ++c) {
        fmt::format_to(std::back_inserter(out), "{},{},", study.name, r + 1);
        report::append_csv(out, study.columns[c]);
        out += ',';
        report::append_csv(out, study.rows[r][c]);
        out += '\n';
      }
  return out;
}

}  // namespace strake::cli
