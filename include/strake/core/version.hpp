// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake {

/// Returns the version, such as "0.1.0".
[[nodiscard]] std::string_view version();

}  // namespace strake
