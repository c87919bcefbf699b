// SPDX-License-Identifier: Apache-2.0
// A scene as peers take it: triangles alone.
#pragma once

#include <vector>

#include "peers/peer.hpp"
#include "strake/model/scene.hpp"

namespace strake::bench {

/// Returns the triangles of a scene, as every object's own.
[[nodiscard]] std::vector<PeerObject> peer_objects(const model::Scene& scene);

/// Returns the same objects as a file of plain meshes would hold them: nothing shared, no
/// primitives.
[[nodiscard]] model::Model as_meshes(const model::Model& from,
                                     const std::vector<PeerObject>& objects);

}  // namespace strake::bench
