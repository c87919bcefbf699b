// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pictures/clash_picture.hpp"
#include "pictures/viewpoint/window.hpp"

namespace strake::pictures {

/// Returns what the faces of a window look like: the two of a clash in light tones of their
/// colours, what is cut open in full tones, all else nearly white.
[[nodiscard]] Shade shade_of(Window window, const NearTriangles& triangles);

}  // namespace strake::pictures
