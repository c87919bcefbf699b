// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io::gltf {

/// Where to cut a JSON text into pieces of about `piece_bytes`: offsets behind commas that stand
/// outside strings, ascending. Depends on the text and the size only, and takes a fraction of the
/// time of an index: whether a block of the text begins within a string follows from the number of
/// quotes before it. In a text that is no JSON the offsets are of no use, but do no harm.
[[nodiscard]] Result<std::vector<std::size_t>> json_cuts(std::string_view text,
                                                         std::size_t piece_bytes,
                                                         const parallel::Context& context);

}  // namespace strake::io::gltf
