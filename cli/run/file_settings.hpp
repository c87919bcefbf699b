// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/project/project.hpp"
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
                                             const std::vector<std::filesystem::path>& files);

/// Checks that files of a project were read as rules say of them. Errors: usage for the first that
/// was read otherwise, with the command that reads it so.
[[nodiscard]] Status check_file_settings(std::span<const rules::FileSettings> settings,
                                         const std::vector<project::StoredFile>& files,
                                         const std::string& project);

}  // namespace strake::cli
