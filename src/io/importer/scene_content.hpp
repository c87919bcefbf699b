// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "strake/io/reader.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io {

/// Returns the unit of a scene in millimetres, as the scene states it.
[[nodiscard]] double unit_of_scene(const FileBytes& scene, const parallel::Context& context);

/// Returns the first file that a scene names besides itself; nothing where it holds all that it
/// shows. A scene that is kept would go stale with such a file, and could show any file of the
/// user's.
[[nodiscard]] std::optional<std::string> named_by_scene(const FileBytes& scene,
                                                        const parallel::Context& context);

}  // namespace strake::io
