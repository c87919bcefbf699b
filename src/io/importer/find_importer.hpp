// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/io/reader.hpp"

namespace strake::io {

/// A program that makes scenes.
struct ImporterProgram {
  std::filesystem::path file;
  std::string suffix;  ///< of the model file, without the point: "ifc"
};

/// Returns the suffix that a name ends in as importers are named by it: small letters and digits,
/// twelve at most; empty where it has none such.
[[nodiscard]] std::string importer_suffix(const std::filesystem::path& file);

/// Returns the suffixes by which an importer of a file may be called: what its content says, then
/// what its name says. None where one of our readers has the suffix.
[[nodiscard]] std::vector<std::string> importer_suffixes(const FileBytes& file);

/// Returns the program that imports a file.
[[nodiscard]] std::optional<ImporterProgram> find_importer(
    const FileBytes& file, std::span<const std::filesystem::path> folders);

/// Returns the program beside an importer that does for several files what it does for one; empty
/// where there is none.
[[nodiscard]] std::filesystem::path program_for_several(const ImporterProgram& importer);

/// Returns all importers in these folders, the first of each suffix, in the order of suffixes;
/// strake-import, which knows more, has none and comes last.
[[nodiscard]] std::vector<ImporterProgram> all_importers(
    std::span<const std::filesystem::path> folders);

}  // namespace strake::io
