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
#include "tiles/blob_file.hpp"
#include "tiles/outline.hpp"

/// Tiles of a model on the disk: each has all that its task needs to know of some objects, and
/// nothing else. A tile is one file with what is asked of it, and one for the geometry that it has
/// of each model file.
namespace strake::tiles {

/// Objects [first, last) of a tile are of one model file.
struct Section {
  std::uint32_t file = 0, first = 0, last = 0;
  std::uint64_t bodies = 0, shapes = 0;
  Hash128 hash;  ///< of what it holds
};

struct Tile {
  clash::Cell cell;
  model::SceneOptions scene;
  std::vector<std::uint32_t> objects;  ///< their numbers in the whole model, ascending
  std::vector<Blob> tasks;             ///< what is asked of it, encoded by who asks
  std::vector<Section> sections;
  /// Its objects with their ids, and of the files their labels: no names, groups and attributes.
  model::Model model;
};

/// Writes the part that some objects of a model file, which is alone in its model, have in a tile;
/// `objects` are their numbers there. Errors: output, memory.
[[nodiscard]] Result<Section> write_section(const std::filesystem::path& tile, std::uint32_t file,
                                            const model::Model& model,
                                            std::span<const std::uint32_t> objects);

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

/// Writes tiles, reading the model's files again, one at a time. Errors: input for one that changed
/// meanwhile; those of io::read_models(); output.
[[nodiscard]] Status write_tiles(const TilesToWrite& what, const parallel::Context& context);

/// Reads a tile. Errors: input for one of which a file is not what was written (kLost).
[[nodiscard]] Result<Tile> read_tile(const std::filesystem::path& file,
                                     const parallel::Context& context);

}  // namespace strake::tiles
