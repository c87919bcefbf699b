// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/packed_view.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <string_view>

#include "io/gltf/packed_attributes.hpp"

namespace strake::io::gltf {
namespace {

enum class PackedMode : std::uint8_t { attributes, triangles, indices, unknown };

PackedMode mode_of(std::string_view mode) {
  if (mode == "ATTRIBUTES") return PackedMode::attributes;
  if (mode == "TRIANGLES") return PackedMode::triangles;
  return mode == "INDICES" ? PackedMode::indices : PackedMode::unknown;
}

/// Returns how many bytes one packed byte can become at most: attributes that are all alike take
/// two bits for sixteen bytes, or since version 1 for 256, a triangle a byte for three indices, an
/// index a byte.
std::uint64_t largest_ratio(PackedMode mode, std::uint64_t stride, bool version_1) {
  if (mode == PackedMode::attributes) return version_1 ? 1024 : 64;
  return mode == PackedMode::triangles ? 3 * stride : stride;
}

/// Whether the library may be called for elements of this form; it takes for granted that it may.
bool is_sound(PackedMode mode, std::uint64_t stride, std::uint64_t count) {
  constexpr std::uint64_t kWidest = 256;
  if (mode == PackedMode::attributes) return stride > 0 && stride <= kWidest && stride % 4 == 0;
  if (mode == PackedMode::triangles && count % 3 != 0) return false;
  return mode != PackedMode::unknown && (stride == 2 || stride == 4);
}

bool is_sound_filter(std::string_view filter, std::uint64_t stride) {
  if (filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
  if (filter == "QUATERNION") return stride == 8;
  return filter.empty() || filter == "NONE" || filter == "EXPONENTIAL";
}

void apply_filter(std::string_view filter, std::vector<std::byte>& bytes, std::size_t count,
                  std::size_t stride) {
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
}

}  // namespace

PackedView packed_view_of(const JsonValue& extensions) {
  PackedView packed;
  for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const JsonValue stated = extensions[name];
    if (!stated.is_object()) continue;
    const auto [buffer, offset, length, stride, count, mode, filter] = stated.pick<7>(
        {"buffer", "byteOffset", "byteLength", "byteStride", "count", "mode", "filter"});
    packed.extension = name;
    packed.buffer = buffer.index();
    packed.offset = offset.exists() ? offset.index() : std::optional<std::uint64_t>(0);
    packed.length = length.index();
    packed.stride = stride.index();
    packed.count = count.index();
    packed.mode = mode.text_value();
    packed.filter = filter.text_value();
    break;
  }
  return packed;
}

Unpacked unpack(const PackedView& view, std::span<const std::byte> packed, std::uint64_t limit) {
  const PackedMode mode = mode_of(view.mode);
  const std::uint64_t stride = view.stride.value_or(0), count = view.count.value_or(UINT64_MAX);
  if (!is_sound(mode, stride, count) || !is_sound_filter(view.filter, stride))
    return {{},
            fmt::format("has no valid mode, filter, count or byteStride of {}", view.extension)};
  constexpr std::uint64_t kFree = 8192;  // a block that is begun
  const bool version_1 = mode == PackedMode::attributes && is_attributes_version_1(packed);
  const std::uint64_t room =
      std::min(largest_ratio(mode, stride, version_1) * packed.size() + kFree, limit);
  if (count > room / stride)
    return {
        {},
        fmt::format("states {} elements, which {} packed bytes cannot hold", count, packed.size())};
  Unpacked result;
  result.bytes.resize(count * stride);
  if (count == 0) return result;
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
  int status = 0;
  switch (mode) {
    case PackedMode::attributes:
      if (version_1)
        status = unpack_attributes_version_1(packed, stride, result.bytes) ? 0 : -1;
      else
        status =
            meshopt_decodeVertexBuffer(result.bytes.data(), count, stride, from, packed.size());
      break;
    case PackedMode::triangles:
      status = meshopt_decodeIndexBuffer(result.bytes.data(), count, stride, from, packed.size());
      break;
    case PackedMode::indices:
      status = meshopt_decodeIndexSequence(result.bytes.data(), count, stride, from, packed.size());
      break;
    case PackedMode::unknown:
      break;
  }
  if (status != 0)
    return {{},
            fmt::format("its bytes, packed by {}, are damaged or of a version that is not read",
                        view.extension)};
  if (mode == PackedMode::attributes) apply_filter(view.filter, result.bytes, count, stride);
  return result;
}

}  // namespace strake::io::gltf
