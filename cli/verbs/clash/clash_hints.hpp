// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"

namespace strake::cli {

/// Returns what helps with a result of which most hits are of one kind, in models from AVEVA: a
/// line where most are within equipment, structures and branches, and one where most are between
/// the same two of them.
[[nodiscard]] std::vector<std::string> clash_hints(const clash::Findings& findings,
                                                   const model::Model& model);

}  // namespace strake::cli
