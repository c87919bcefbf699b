// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cli/evaluate/record.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// Returns the record as a document of schemas/evaluation.schema.json.
[[nodiscard]] std::string evaluation_json(const EvaluationRecord& record);

/// Reads such a document. `name` stands in errors. Errors: input.
[[nodiscard]] Result<EvaluationRecord> parse_evaluation(std::string_view text,
                                                        const std::string& name);

/// Reads it from a file. Errors: input.
[[nodiscard]] Result<EvaluationRecord> read_evaluation(const std::string& file);

}  // namespace strake::cli
