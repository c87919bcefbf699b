// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/evaluate/record.hpp"

namespace strake::cli {

/// Return the evaluation as one page without references to anything else, as Markdown with its
/// charts beside it (chart_files()), and as one line per contender.
[[nodiscard]] std::string evaluation_html(const EvaluationRecord& record);
[[nodiscard]] std::string evaluation_markdown(const EvaluationRecord& record);
[[nodiscard]] std::string evaluation_csv(const EvaluationRecord& record);

/// Returns the name of the n-th chart of a section, which Markdown refers to.
[[nodiscard]] std::string chart_file(std::size_t section, std::size_t n);

}  // namespace strake::cli
