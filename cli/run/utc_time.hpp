// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace strake::cli {

/// Returns the time of the machine's clock in UTC, as projects have it: "2026-01-31T23:59:59Z".
[[nodiscard]] std::string utc_time();

}  // namespace strake::cli
