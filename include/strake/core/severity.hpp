// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "strake/core/diagnostics.hpp"

namespace strake {

/// How every output spells a severity: "note", "warning", "skipped".
[[nodiscard]] std::string_view severity_name(Severity severity);

}  // namespace strake
