// SPDX-License-Identifier: Apache-2.0
// Scenes that are hard to see through.
#pragma once

#include <cstdint>

#include "strake/model/model.hpp"

namespace strake::bench {

/// side x side stacks of `deep` boxes along z, a box an object. Each box reaches over its
/// neighbours' stacks, so that at most places on the plan about 2·deep boxes lie over each other.
[[nodiscard]] model::Model stacked_boxes(std::uint32_t side, std::uint32_t deep);

/// side x side bundles along x of three hollow tubes, one in another, in `lengths` lengths end to
/// end, a tube an object. Seen along x all but the annular ends are edge-on, and what lies behind
/// one another has the same outlines.
[[nodiscard]] model::Model pipe_bundle(std::uint32_t side, std::uint32_t lengths);

}  // namespace strake::bench
