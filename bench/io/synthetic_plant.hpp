// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/model/model.hpp"

namespace strake::bench {

/// `objects` tubes of `sides` facets, of which every `shared` stand on one shape.
[[nodiscard]] model::Model plant(std::uint32_t objects, std::uint32_t shared, std::uint32_t sides);

}  // namespace strake::bench
