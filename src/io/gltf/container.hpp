// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"

namespace strake::io::gltf {

/// The JSON text of a glTF file and, in a GLB, its binary chunk.
struct Container {
  bool binary_file = false;
  std::string_view json;
  std::size_t json_offset = 0;  ///< the offset of the text within the file, for messages
  std::optional<std::span<const std::byte>> chunk;
};

[[nodiscard]] bool has_glb_magic(std::span<const std::byte> bytes);

/// Splits a GLB into its chunks; any other file is JSON as a whole.
[[nodiscard]] Result<Container> open_container(const FileBytes& file);

/// Whether the text may name other files. Most name none, and their text is long.
[[nodiscard]] bool may_name_files(const Container& container);

}  // namespace strake::io::gltf
