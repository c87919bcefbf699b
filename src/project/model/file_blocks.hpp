// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "project/model/blocks.hpp"
#include "project/model/columns.hpp"
#include "project/model/file_rows.hpp"
#include "strake/core/result.hpp"

/// The table of blocks.
namespace strake::project {

enum class BlockKind : std::uint8_t {
  objects,
  bodies,
  shapes,
  groups,
  group_attributes,
  diagnostics,  ///< one block
};

/// Returns how a kind is called in the table and in messages.
[[nodiscard]] std::string_view kind_name(BlockKind kind);

[[nodiscard]] inline std::size_t block_count(std::uint64_t items) {
  return static_cast<std::size_t>((items + kBlock - 1) / kBlock);
}
[[nodiscard]] inline std::size_t items_of_block(std::uint64_t items, std::size_t block) {
  return static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, items - block * kBlock));
}

/// Returns what messages call the blocks of a file: "ship.strake: the objects of a.rvm".
[[nodiscard]] std::string block_name(const Database& database, const FileRow& row, BlockKind kind);

/// Returns the blocks of a file that hold so many items. Errors: input where there are more or
/// fewer blocks, or one that is too short for its items, so that the items of all can be made room
/// for.
[[nodiscard]] Result<std::vector<Blob>> read_blocks(Database& database, std::int64_t file,
                                                    BlockKind kind, std::uint64_t items);

/// Returns the hash of what is in all blocks of a file, kind by kind; `hashes` are those of each.
[[nodiscard]] Hash128 hash_of_blocks(std::span<const Hash128> hashes);

[[nodiscard]] Status write_blocks(Database& database, std::int64_t file, BlockKind kind,
                                  std::span<const Blob> blocks);

/// Removes all blocks of a file.
[[nodiscard]] Status remove_blocks(Database& database, std::int64_t file);

}  // namespace strake::project
