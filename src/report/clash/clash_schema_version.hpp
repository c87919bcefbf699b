// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake::report {

/// The version of schemas/clash.schema.json, which the writer states and the reader requires.
inline constexpr std::string_view kClashSchemaVersion = "2";

}  // namespace strake::report
