// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_content.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/fault.hpp"
#include "io/gltf/json.hpp"

namespace strake::io::gltf {

/// The bytes of a data: URI's base64, nothing when it is not valid.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

/// A relative URI with its percent escapes decoded.
[[nodiscard]] std::string decode_uri(std::string_view uri);

/// The buffers and buffer views of a document. All is checked here: a view that was given out lies
/// within its buffer.
class Buffers {
 public:
  struct View {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;  ///< 0: tightly packed
  };

  /// Loads what the document names: the GLB's own chunk, data: URIs, and files in the model's
  /// folder or below it. What cannot be had is a fault of its views.
  Buffers(const Json& root, const Container& container, const std::filesystem::path& file);

  [[nodiscard]] Checked<View> view(std::size_t index) const;
  [[nodiscard]] std::size_t total_bytes() const { return total_bytes_; }

 private:
  struct Buffer {
    std::span<const std::byte> bytes;
    std::optional<FileContent> file;
    std::vector<std::byte> decoded;
    std::optional<Fault> fault;
  };

  /// What the document states of a view, read once for all accessors that share it.
  struct Stated {
    std::optional<std::uint64_t> buffer, offset, length, stride;
    const char* packed = nullptr;  ///< the extension without which it holds nothing
  };

  void load(Buffer& buffer, std::size_t index, const Json& json, const Container& container,
            const std::filesystem::path& file);
  void load_uri(Buffer& buffer, const std::string& pointer, const Json& uri,
                const std::filesystem::path& file);

  std::vector<Buffer> buffers_;
  std::vector<Stated> views_;
  std::size_t total_bytes_ = 0;
};

}  // namespace strake::io::gltf
