// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/io/reader.hpp"
#include "strake/rules/rules.hpp"

/// The [[file]] tables of a rules file, applied to the files of a command line.
namespace strake::cli {

/// Gives files the units and upward axes that rules say of them, where they have none yet: what the
/// command line says goes before the rules, and of several tables the first counts.
void apply_file_settings(std::span<const rules::FileSettings> settings,
                         std::vector<io::FileToRead>& files);

/// Warns of tables that are about no file ("rule-matches-nothing"), and of those of which all is
/// said by earlier ones ("rule-shadowed").
[[nodiscard]] Diagnostics idle_file_settings(std::span<const rules::FileSettings> settings,
                                             const std::vector<std::string>& files);

}  // namespace strake::cli
