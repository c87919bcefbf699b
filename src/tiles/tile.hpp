// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "tiles/kept/blob_file.hpp"
#include "tiles/kept/file_reader.hpp"
#include "tiles/kept/section.hpp"
#include "tiles/outline.hpp"

/// Tiles of a model on the disk: each has all that its task needs to know of some objects, and
/// nothing else. A tile is one file with what is asked of it, and one for the geometry that it has
/// of each model file.
namespace strake::tiles {

struct Tile {
  clash::Cell cell;
  model::SceneOptions scene;
  std::vector<std::uint32_t> objects;  ///< their numbers in the whole model, ascending
  std::vector<Blob> tasks;             ///< what is asked of it, encoded by who asks
  std::vector<Section> sections;
  /// Its objects with their ids, and of the files their labels: no names, groups and attributes.
  model::Model model;
};

/// Writes the rest of a tile, all but its model's geometry. Errors: output, memory.
[[nodiscard]] Status write_head(const std::filesystem::path& file, const Tile& tile);

/// Returns the file of a tile.
[[nodiscard]] std::filesystem::path tile_file(const std::filesystem::path& folder,
                                              std::size_t tile);

/// Returns the hash by which results are known to be of a tile.
[[nodiscard]] Hash128 hash_of(std::span<const std::uint32_t> objects);

/// What is to be written of a model that is cut.
struct TilesToWrite {
  const Outline& outline;
  FileReader& reader;
  const std::filesystem::path& folder;
  std::span<const std::size_t> tiles;  ///< their numbers
  /// The objects of a tile, ascending.
  parallel::FunctionRef<std::span<const std::uint32_t>(std::size_t tile)> objects_of;
  /// The rest of a tile, but for its sections and files.
  parallel::FunctionRef<Result<Tile>(std::size_t tile)> head_of;
};

/// Writes tiles, one model file after the other, as FileReader::read_again() has it. Errors: input
/// for a file that had to be read again and changed meanwhile; those of io::read_models(); output.
[[nodiscard]] Status write_tiles(const TilesToWrite& what, const parallel::Context& context);

/// Reads a tile. Errors: input for one of which a file is not what was written (kLost).
[[nodiscard]] Result<Tile> read_tile(const std::filesystem::path& file,
                                     const parallel::Context& context);

}  // namespace strake::tiles
