// SPDX-License-Identifier: Apache-2.0
// Who changes a project, and when.
#pragma once

#include <string>

namespace strake::cli {

/// Returns the time of the machine's clock in UTC, as projects have it: "2026-01-31T23:59:59Z".
[[nodiscard]] std::string utc_time();

/// Returns who runs the program, as the machine knows them: "ann"; the number of the user where
/// they have no name.
[[nodiscard]] std::string person();

}  // namespace strake::cli
