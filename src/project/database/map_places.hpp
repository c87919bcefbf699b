// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "io/importer/map_place.hpp"
#include "project/database/database.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"

/// Where files lie on a map, in rows of the database.
namespace strake::project {

/// Returns the place that a row of the table `map_place` says; nothing where it cannot be one that
/// an importer says.
[[nodiscard]] std::optional<io::MapPlace> map_place_of(std::string_view crs,
                                                       std::span<const std::byte> to_map);

/// Writes where a file lies, or that it does not say so.
[[nodiscard]] Status write_map_place(Database& database, std::int64_t file,
                                     const std::optional<io::MapPlace>& place);

/// Adds a place to the hash of all that rows say.
void add_to(Hasher& hasher, const io::MapPlace& place);

}  // namespace strake::project
