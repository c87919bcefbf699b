// SPDX-License-Identifier: Apache-2.0
// The members of a row as JSON: of the document of a peer program, and of an evaluation's.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/evaluate/peers/peer_row.hpp"

namespace strake::cli {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PeerRow, scene, objects, triangles, threads, who, version,
                                   answers, cpu_s, wall_s, ours_cpu_s, ours_wall_s, outcome, result)

}  // namespace strake::cli
