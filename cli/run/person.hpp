// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace strake::cli {

/// Returns who runs the program, as the machine knows them: "ann"; the number of the user where
/// they have no name.
[[nodiscard]] std::string person();

}  // namespace strake::cli
