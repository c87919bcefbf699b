// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "strake/core/diagnostics.hpp"

namespace strake::cli {

/// Appends how many diagnostics of each code there are to `counts`, and those that are kept to
/// `messages`.
void add_diagnostics(nlohmann::ordered_json& counts, nlohmann::ordered_json& messages,
                     const Diagnostics& diagnostics);

}  // namespace strake::cli
