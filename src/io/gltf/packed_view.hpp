// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/json/json.hpp"

/// Buffer views that EXT_meshopt_compression packs.
namespace strake::io::gltf {

/// What a buffer view states of its packed bytes.
struct PackedView {
  const char* extension = nullptr;  ///< its name; null: the view is not packed
  std::optional<std::uint64_t> buffer, offset, length, stride, count;
  std::string mode, filter;
};

/// Returns what the extensions of a buffer view say of packed bytes.
[[nodiscard]] PackedView packed_view_of(const JsonValue& extensions);

/// Bytes, or why there are none.
struct Unpacked {
  std::vector<std::byte> bytes;
  std::string fault;
};

/// Unpacks the bytes of a view. What few bytes cannot hold is refused before memory is requested;
/// `limit` bounds it as well.
[[nodiscard]] Unpacked unpack(const PackedView& view, std::span<const std::byte> packed,
                              std::uint64_t limit);

}  // namespace strake::io::gltf
