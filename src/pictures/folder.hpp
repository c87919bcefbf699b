// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "pictures/clash_picture.hpp"

/// A folder of pictures: one of each group of clashes, or of each clash where there are no groups.
namespace strake::pictures {

enum class PictureFormat : std::uint8_t { svg, png };

struct FolderOptions {
  PictureFormat format = PictureFormat::svg;
  std::size_t max_pictures = 50;  ///< pictures, the worst first
  PictureOptions picture;
  std::uint32_t width_px = 1280;  ///< of a PNG
};

/// What a folder shows.
struct FolderCount {
  std::size_t drawn = 0, left_out = 0;
  std::size_t cut_open = 0;  ///< pictures in which something had to be cut away
};

/// Checks that a folder may be written: it is not there, empty, or holds nothing but such pictures.
/// Errors: output.
[[nodiscard]] Status check_picture_folder(const std::filesystem::path& folder);

/// Writes the folder, whole or not at all: pictures are drawn beside it, then it takes the place of
/// one that is there. A picture is called by the id of its group or the key of its clash, so that
/// its name stays while the clash does; index.html shows them in order, the worst first. Results
/// that a rule allows have none, and contacts only where groups have them or nothing else is asked
/// for. Errors: output, cancelled, out of memory; usage where the contents have no scene.
[[nodiscard]] Result<FolderCount> write_picture_folder(const report::ClashContents& contents,
                                                       const std::filesystem::path& folder,
                                                       const FolderOptions& options,
                                                       const parallel::Context& context);

}  // namespace strake::pictures
