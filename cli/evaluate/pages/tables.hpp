// SPDX-License-Identifier: Apache-2.0
// An evaluation as a reader sees it: tables and charts, without a format.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/pages/bar_chart.hpp"
#include "cli/evaluate/record.hpp"

namespace strake::cli {

struct Table {
  std::string title, note;
  std::vector<std::string> columns;  ///< the first is of text, the others of numbers
  std::vector<std::vector<std::string>> rows;
};

/// A part of the page: a chart, if there is something to show, and a table.
struct TableSection {
  std::string id;  ///< in names of files: "speed-up-local"
  Table table;
  std::vector<BarChart> charts;
};

/// Returns the sections of the page, those without rows left out.
[[nodiscard]] std::vector<TableSection> sections_of(const EvaluationRecord& record);

/// Returns the differences between what had to be equal, a line each.
[[nodiscard]] std::vector<std::string> differences_of(const EvaluationRecord& record);

}  // namespace strake::cli
