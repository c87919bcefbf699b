// SPDX-License-Identifier: Apache-2.0
#include "project/results/positional_rows.hpp"

#include <string_view>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "report/decisions/decision_files.hpp"
#include "report/decisions/decision_match.hpp"

namespace strake::project {

report::Decision decision_of(const ClashRow& row, const std::string& test) {
  report::Decision decision;
  decision.key =
      clash::parse_key(std::string_view(row.key).substr(0, row.key.find('~'))).value_or(Hash128{});
  decision.status = row.decision;
  decision.by = row.decided_by;
  decision.date = row.decided_at.substr(0, row.decided_at.find('T'));
  decision.comment = row.comment;
  decision.cls = row.now.cls;
  decision.d_mm = row.now.d_mm;
  decision.point_mm = row.point_mm;
  decision.regions = row.now.regions;
  decision.test = test;
  decision.a = {row.a.file, row.a.id, row.a.name};
  decision.b = {row.b.file, row.b.id, row.b.name};
  decision.assignee = row.assignee;
  decision.at = row.decided_at;
  return decision;
}

std::vector<std::optional<std::size_t>> match_positional(const model::Model& model,
                                                         const clash::Report& report,
                                                         std::span<const std::size_t> results,
                                                         std::span<const ClashRow> rows) {
  std::vector<std::optional<std::size_t>> found(results.size());
  if (results.empty() || rows.empty()) return found;
  clash::Findings sought;
  clash::Report& test = sought.tests.emplace_back();
  test.name = report.name;
  for (const std::size_t at : results) test.pairs.push_back(report.pairs[at]);
  report::DecisionFile file;
  for (const ClashRow& row : rows) file.decisions.push_back(decision_of(row, report.name));
  const report::FileMatches by_label;
  const report::MatchedRows matched =
      report::match_rows(sought, model, file, report::DecidedKeys(by_label, model, file));
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const report::Decision* const row = matched.tests[0][i]; row != nullptr)
      found[i] = static_cast<std::size_t>(row - file.decisions.data());
  return found;
}

}  // namespace strake::project
