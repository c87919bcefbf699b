// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "settings/table_reader.hpp"
#include "strake/rules/rules.hpp"

namespace strake::rules {

/// Reads the [[file]] tables of a rules file.
[[nodiscard]] std::vector<FileSettings> read_file_settings(settings::ParseContext& reading,
                                                           settings::TableReader& top);

}  // namespace strake::rules
