// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/pages/peer_table.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/number.hpp"
#include "report/text/csv.hpp"

namespace strake::cli {

namespace {

std::string seconds_text(double value) { return value > 0 ? fmt::format("{:.3f}", value) : "-"; }

/// Returns the ratio with two digits that count; "-" without a time.
std::string ratio_text(double theirs, double ours) {
  if (theirs <= 0 || ours <= 0) return "-";
  const double ratio = theirs / ours;
  return fmt::format("{:.{}f}", ratio, ratio < 1 ? 2 : ratio < 10 ? 1 : 0);
}

std::string count_text(std::uint64_t value) { return value > 0 ? std::to_string(value) : "-"; }

/// Returns how the results compare, or why there is none; what is an error begins with "NO: ".
std::string result_text(const PeerRow& row) {
  if (row.outcome == kMeasured) return row.result;
  if (row.outcome == kDisagrees) return "NO: " + row.result;
  return fmt::format("{}: {}", row.outcome, row.result);
}

std::vector<std::string> cells_of(const PeerRow& row) {
  return {row.scene,
          count_text(row.objects),
          count_text(row.triangles),
          row.who,
          row.version,
          count_text(row.threads),
          row.answers,
          seconds_text(row.cpu_s),
          seconds_text(row.wall_s),
          seconds_text(row.ours_cpu_s),
          ratio_text(row.cpu_s, row.ours_cpu_s),
          result_text(row)};
}

}  // namespace

TableSection peer_section(const EvaluationRecord& record) {
  TableSection section;
  section.id = "peers";
  section.table = {
      "Peers",
      "Other programs on the same triangles, each beside Strake in the same run. Results are "
      "compared before times: one that is not Strake's, but for what stands with it, has no time. "
      "Seconds are without reading files. Strake's are of its whole answer: of pairs, class, "
      "distance or depth and witness; of a drawing, the kinds of lines that the peer draws.",
      {"Scene", "Objects", "Triangles", "Who", "Version", "Threads", "Answers", "CPU s", "Wall s",
       "Strake CPU s", "Times ours (CPU)", "Result"},
      {}};
  for (const PeerRecord& peer : record.peers)
    for (const PeerRow& row : peer.rows) section.table.rows.push_back(cells_of(row));
  return section;
}

std::string peers_csv(const EvaluationRecord& record) {
  constexpr std::array kColumns{"case",       "scene",       "objects", "triangles", "who",
                                "version",    "threads",     "answers", "cpu_s",     "wall_s",
                                "ours_cpu_s", "ours_wall_s", "outcome", "result"};
  const report::CsvForm form;
  std::string out;
  report::CsvRow head(out, form);
  for (const char* const column : kColumns) head.word(column);
  head.end();
  for (const PeerRecord& peer : record.peers)
    for (const PeerRow& one : peer.rows) {
      report::CsvRow row(out, form);
      row.text(peer.name).text(one.scene).count(one.objects).count(one.triangles);
      row.text(one.who).text(one.version).count(one.threads).text(one.answers);
      for (const double seconds : {one.cpu_s, one.wall_s, one.ours_cpu_s, one.ours_wall_s})
        row.number(seconds, append_shortest);
      row.text(one.outcome).text(one.result).end();
    }
  return out;
}

}  // namespace strake::cli
