// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/record.hpp"

namespace strake::cli {

/// Returns what other programs did, a row for each and each scene.
[[nodiscard]] TableSection peer_section(const EvaluationRecord& record);

/// Returns the same as one line per row, with all digits.
[[nodiscard]] std::string peers_csv(const EvaluationRecord& record);

}  // namespace strake::cli
