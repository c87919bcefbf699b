// SPDX-License-Identifier: Apache-2.0
// Questions that the thesis argues in words, answered by measurement.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

#include "cli/evaluate/record.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// What a study is given: settings of the evaluation, when to stop, and whom to tell what runs.
struct StudyInput {
  const EvaluationSettings& settings;
  std::stop_token stop;
  std::function<void(const std::string&)> narrate;
};

struct StudyCase {
  std::string_view name, title, question;
  /// Fills the rows; errors are those of the engines.
  Status (*run)(const StudyInput& input, StudyRecord& study);
};

[[nodiscard]] std::span<const StudyCase> study_cases();

}  // namespace strake::cli
