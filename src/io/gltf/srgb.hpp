// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace strake::io::gltf {

/// Convert between linear light, in which glTF states colour factors, and 8-bit sRGB (IEC
/// 61966-2-1), which models have. Each of the 256 values comes back as itself.
[[nodiscard]] double linear_of_srgb(std::uint8_t value);
[[nodiscard]] std::uint8_t srgb_of_linear(double linear);

}  // namespace strake::io::gltf
