// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "io/gltf/json.hpp"
#include "io/gltf/node.hpp"
#include "strake/core/result.hpp"

namespace strake::io::gltf {

/// A visited node: parents come before their children.
struct Visit {
  std::uint32_t node = 0;
  std::uint32_t parent = 0;  ///< index of a visit; kNoVisit for roots
};

inline constexpr std::uint32_t kNoVisit = 0xffffffffU;

/// Nodes may be nested this deep.
inline constexpr std::uint32_t kMaxNodeDepth = 1000;

/// The nodes of the default scene, else of the first one, else all, in document order depth
/// first. Nodes with two parents, cycles, and references to nodes that do not exist are errors,
/// whose `where` is the JSON pointer alone.
[[nodiscard]] Result<std::vector<Visit>> visit_order(const Json& root,
                                                     const std::vector<Node>& nodes);

}  // namespace strake::io::gltf
