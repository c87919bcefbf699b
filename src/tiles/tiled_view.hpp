// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "hlr/incremental/extents.hpp"
#include "hlr/parts/split_view.hpp"
#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "tiles/outline.hpp"
#include "tiles/tile.hpp"

/// Drawings by tiles: cut here, solve anywhere, join here (decision 0107).
///
/// The lines are those of hlr::draw() over the whole model, bit for bit but for Drawing::counters
/// of the work.
namespace strake::tiles {

/// A view of a model that is cut.
struct CutView {
  Outline outline;            ///< with places, and of what the sections cut the triangles
  model::SceneOptions scene;  ///< what is placed
  hlr::View view;
  hlr::Options options;
  std::vector<bool> drawn;  ///< by object
  hlr::WholeExtent whole;
  std::optional<hlr::WholeSections> sections;  ///< of views with sections
  std::vector<hlr::ViewPart> parts;            ///< a tile each
};

/// Returns what outlines keep for a view. Errors: usage for sections that make no sense.
[[nodiscard]] Result<Keep> kept_for(const hlr::View& view);

/// Returns why a view cannot be drawn by tiles. Errors: usage.
[[nodiscard]] Status check_tiled_view(const hlr::Options& options);

/// Cuts a view, of which all but whole, sections and parts is there, into tiles of which a worker
/// takes no more than so many bytes. Errors: those of hlr::draw(); cancelled.
[[nodiscard]] Status cut_view(CutView& cut, std::uint64_t max_bytes,
                              const parallel::Context& context);

/// Writes some of the tiles, as write_tiles() does.
[[nodiscard]] Status write_view_tiles(const CutView& cut, FileReader& reader,
                                      const std::filesystem::path& folder,
                                      std::span<const std::size_t> tiles,
                                      const parallel::Context& context);

/// Solves one tile and writes the lines that are its own: a function of the tile alone. Errors:
/// input for a tile that is missing or damaged (kLost); those of hlr::draw(); output.
[[nodiscard]] Status solve_tile(const std::filesystem::path& tile,
                                const std::filesystem::path& solved,
                                const parallel::Context& context);

/// Puts together what was solved in all tiles, in their order. Errors: input for a file that is
/// missing or damaged, or of another tile (kLost); cancelled, memory.
[[nodiscard]] Result<hlr::Drawing> join_solved(const CutView& cut,
                                               std::span<const std::filesystem::path> solved,
                                               const parallel::Context& context);

}  // namespace strake::tiles
