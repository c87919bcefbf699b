// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace strake {

/// Returns how many letters must be put in, taken out, replaced or swapped with the next to make
/// one word of the other (the optimal string alignment distance). It takes time and memory by the
/// product of the lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace strake
