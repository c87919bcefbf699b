// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/record.hpp"

namespace strake::cli {

/// Return the evaluation as one page without references to anything else, as Markdown with its
/// charts beside it (chart_file()), as one line per contender, and as one line per cell of the
/// tables of studies, which have different columns.
[[nodiscard]] std::string evaluation_html(const EvaluationRecord& record);
[[nodiscard]] std::string evaluation_markdown(const EvaluationRecord& record);
[[nodiscard]] std::string evaluation_csv(const EvaluationRecord& record);
[[nodiscard]] std::string studies_csv(const EvaluationRecord& record);

/// Returns the name of the file of a section's n-th chart, which Markdown refers to.
[[nodiscard]] std::string chart_file(const TableSection& section, std::size_t n);

}  // namespace strake::cli
