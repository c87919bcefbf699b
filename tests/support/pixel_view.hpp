// SPDX-License-Identifier: Apache-2.0
// A view as pixels: which object is in front, how near, and where its surface goes from there. By
// doubles and pixel centres, and none of the engine's code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

/// What the pixels said of a drawing; tolerances are those of pixel_view.cpp.
struct PixelCheck {
  std::uint64_t line_pixels = 0;   ///< pixels of visible lines that were requested
  std::uint64_t magnified = 0;     ///< of these: decided by a finer rendering of the place only
  std::uint64_t covered = 0;       ///< of these: behind something nearer all round
  std::uint64_t jumps = 0;         ///< neighbouring pixels of which the surface jumps
  std::uint64_t borders = 0;       ///< neighbouring pixels of different objects
  std::uint64_t without_line = 0;  ///< of both: no visible line near
  std::string first;               ///< the first that does not agree
};

/// Renders the opaque bodies of a scene, `width` pixels wide, and compares with the visible lines
/// of an orthographic drawing of all of it without limits and sections.
[[nodiscard]] PixelCheck check_by_pixels(const model::Scene& scene, const hlr::Drawing& drawing,
                                         int width);

}  // namespace strake::test
