// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/model/model.hpp"

namespace strake::io::obj {

using Materials = std::map<std::string, model::Color, std::less<>>;

/// Adds the materials that a library's text defines: diffuse colour (Kd) and opacity (d, Tr).
/// The first definition of a name counts.
void parse_materials(std::string_view text, Materials& materials);

/// Adds the materials of the libraries that an `mtllib` line names, from the folder of the OBJ
/// file. A library that is missing or lies outside that folder leaves its materials at the default
/// colour and a diagnostic.
void load_materials(std::string_view names, const std::filesystem::path& obj_path,
                    Materials& materials, Diagnostics& diagnostics);

/// Returns the files that load_materials() reads, or would if they were there, for the `mtllib`
/// lines of the text of an OBJ file.
[[nodiscard]] std::vector<std::filesystem::path> named_libraries(
    std::string_view text, const std::filesystem::path& obj_path);

}  // namespace strake::io::obj
