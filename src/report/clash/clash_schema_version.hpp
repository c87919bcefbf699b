// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake::report {

/// Of schemas/clash.schema.json, as the writer says it and the reader wants it.
inline constexpr std::string_view kClashSchemaVersion = "2";

}  // namespace strake::report
