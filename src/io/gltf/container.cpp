// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/container.hpp"

#include <fmt/format.h>

#include <cstring>

#include "io/source/input_file.hpp"

namespace strake::io::gltf {
namespace {

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

Error broken(const FileBytes& file, std::size_t offset, std::string message) {
  return {ErrorCode::input, std::move(message),
          fmt::format("{}, byte {}", file.path.string(), offset), "copy or export the file again"};
}

Result<Container> open_glb(const FileBytes& file) {
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const std::span<const std::byte> bytes = file.bytes;
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
    return broken(file, bytes.size(), "ends within the GLB header");
  if (const std::uint32_t version = word(bytes, 4); version != 2)
    return Error{ErrorCode::input, fmt::format("is GLB version {}; only 2 is read", version),
                 fmt::format("{}, byte 4", file.path.string()), "export it as glTF 2.0"};
  const std::size_t total = word(bytes, 8);
  if (total > bytes.size())
    return broken(file, bytes.size(), fmt::format("is cut off: it should have {} bytes", total));

  Container container;
  container.binary_file = true;
  std::size_t at = kHeaderBytes;
  while (total - at >= kChunkHeaderBytes && at < total) {
    const std::size_t length = word(bytes, at), type = word(bytes, at + 4);
    const std::size_t content = at + kChunkHeaderBytes;
    if (length > total - content)
      return broken(file, at,
                    fmt::format("a chunk of {} bytes does not fit into the file", length));
    if (at == kHeaderBytes) {
      if (type != kJson) return broken(file, at, "the first chunk of a GLB must be JSON");
      container.json = as_text(bytes).substr(content, length);
      container.json_offset = content;
    } else if (type == kBinary && !container.chunk) {
      container.chunk = bytes.subspan(content, length);
    }
    at = content + length;
  }
  if (container.json_offset == 0) return broken(file, kHeaderBytes, "has no JSON chunk");
  return container;
}

}  // namespace

bool has_glb_magic(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

Result<Container> open_container(const FileBytes& file) {
  if (has_glb_magic(file.bytes)) return open_glb(file);
  Container container;
  container.json = without_byte_order_mark(as_text(file.bytes));
  container.json_offset = file.bytes.size() - container.json.size();
  return container;
}

bool may_name_files(const Container& container) {
  // A name may be written with escapes.
  return container.json.find("\"uri\"") != std::string_view::npos ||
         container.json.find("\\u") != std::string_view::npos;
}

}  // namespace strake::io::gltf
