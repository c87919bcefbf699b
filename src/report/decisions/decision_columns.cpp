// SPDX-License-Identifier: Apache-2.0
#include "report/decisions/decision_columns.hpp"

#include <algorithm>

#include "core/text_encoding.hpp"
#include "report/text/csv.hpp"

namespace strake::report {
namespace {

Error column_error(const std::string& message, const std::string& name) {
  return {ErrorCode::input, message, name + ", line 1",
          "write the headings in the first line, at least key and status, as in key,status,by,date,"
          "comment"};
}

/// Returns the headings of a file, for a person.
std::string headings_of(const CsvRecord& head) {
  constexpr std::size_t kMaxNamed = 8;
  std::string text;
  for (std::size_t c = 0; c < std::min(head.cells.size(), kMaxNamed); ++c)
    text += (c > 0 ? ", " : "") + in_quotes_cut(cell_text(head.cells[c]));
  return head.cells.size() > kMaxNamed ? text + " …" : text;
}

}  // namespace

std::string in_quotes_cut(std::string_view text) {
  constexpr std::size_t kMaxBytes = 60;
  std::string_view rest = text;
  while (!rest.empty() && text.size() - rest.size() < kMaxBytes) (void)decode_character(rest);
  const std::string_view shown = text.substr(0, text.size() - rest.size());
  return rest.empty() ? in_quotes(text) : in_quotes(std::string(shown) + "…");
}

Result<DecisionColumns> DecisionColumns::read(const CsvTable& table, const std::string& name) {
  DecisionColumns columns;
  if (table.records.empty()) return column_error("is empty", name);
  const CsvRecord& head = table.records.front();
  for (std::size_t c = 0; c < head.cells.size(); ++c) {
    const std::string heading = lowered(cell_text(head.cells[c]));
    const auto known = std::ranges::find(kDecisionColumns, heading);
    if (known == kDecisionColumns.end()) continue;
    const auto column = static_cast<DecisionColumn>(known - kDecisionColumns.begin());
    if (columns.has(column)) return column_error("has the column '" + heading + "' twice", name);
    columns.set(column, c);
  }
  for (const DecisionColumn needed : {DecisionColumn::key, DecisionColumn::status})
    if (!columns.has(needed))
      return column_error("has no column '" +
                              std::string(kDecisionColumns[static_cast<std::size_t>(needed)]) +
                              "' but " + headings_of(head),
                          name);
  return columns;
}

std::string DecisionColumns::name(const CsvRecord& record, DecisionColumn column) const {
  if (!has(column) || at(column) >= record.cells.size()) return {};
  return std::string(without_apostrophe(untrimmed_cell_text(record.cells[at(column)])));
}

bool DecisionColumns::all_blank(const CsvRecord& record) const {
  for (std::size_t c = 0; c < kDecisionColumns.size(); ++c)
    if (!text(record, static_cast<DecisionColumn>(c)).empty()) return false;
  return true;
}

}  // namespace strake::report
