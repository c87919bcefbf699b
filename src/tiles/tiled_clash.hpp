// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/rules/rules.hpp"
#include "tiles/outline.hpp"
#include "tiles/split.hpp"
#include "tiles/tile.hpp"

/// Clash detection by tiles: cut here, find anywhere, join here (decision 0077).
///
/// What is found is what the tests find over the whole model, bit for bit but for Report::counters.
namespace strake::tiles {

/// A run of tests over a model that is cut.
struct CutRun {
  Outline outline;
  model::SceneOptions scene;  ///< what is placed
  rules::Plan plan;           ///< over all objects
  std::vector<CutCell> cells;
};

/// Cuts the model into cells of which a worker takes no more than so many bytes: each has the
/// objects that come within reach of it in any of the tests.
void cut(CutRun& run, std::uint64_t max_bytes);

/// Writes some of the tiles, reading the model's files again, one at a time. Errors: input for one
/// that changed meanwhile; those of io::read_models(); output.
[[nodiscard]] Status write_tiles(const CutRun& run, FileReader& reader,
                                 const std::filesystem::path& folder,
                                 std::span<const std::size_t> tiles,
                                 const parallel::Context& context);

/// Runs the tests over one tile and writes what they find: a function of the tile alone. Errors:
/// input for a tile that is missing or damaged (kLost); those of clash::detect(); output.
[[nodiscard]] Status find_in_tile(const std::filesystem::path& tile,
                                  const std::filesystem::path& found,
                                  const parallel::Context& context);

/// Puts together what was found in all tiles, in their order. Errors: input for a file that is
/// missing or damaged, or of another tile (kLost); those of clash::TileJoin.
[[nodiscard]] Result<clash::Findings> join_found(const CutRun& run,
                                                 std::span<const std::filesystem::path> found,
                                                 const parallel::Context& context);

}  // namespace strake::tiles
