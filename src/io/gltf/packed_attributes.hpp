// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

/// Attributes packed by version 1 of the format of KHR_meshopt_compression, which the library of
/// Debian 12 does not know.
namespace strake::io::gltf {

/// Whether packed attributes say that they are of version 1.
[[nodiscard]] bool is_attributes_version_1(std::span<const std::byte> packed);

/// Unpacks elements of `stride` bytes, a multiple of four up to 256, until `out` is full. False
/// where the bytes are damaged; then `out` holds anything.
[[nodiscard]] bool unpack_attributes_version_1(std::span<const std::byte> packed,
                                               std::size_t stride, std::span<std::byte> out);

}  // namespace strake::io::gltf
