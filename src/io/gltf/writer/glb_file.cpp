// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/writer/glb_file.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/atomic_file.hpp"

namespace strake::io::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

template <class T>
void put(const ByteSink& sink, const T* numbers, std::size_t count) {
  sink({reinterpret_cast<const char*>(numbers), count * sizeof(T)});
}

template <class Index>
void put_indices(const ByteSink& sink, const StoredGeometry& piece) {
  if (piece.mesh != nullptr) {
    const bool mirrored = piece.relative.linear.determinant() < 0;
    for (const geometry::Triangle& t : piece.mesh->triangles) {
      const std::array<Index, 3> row{static_cast<Index>(t[0]),
                                     static_cast<Index>(mirrored ? t[2] : t[1]),
                                     static_cast<Index>(mirrored ? t[1] : t[2])};
      put(sink, row.data(), 3);
    }
    return;
  }
  const std::vector<std::uint32_t>& first = piece.lines->first;
  for (std::size_t chain = 0; chain + 1 < first.size(); ++chain)
    for (std::uint32_t i = first[chain]; i + 1 < first[chain + 1]; ++i) {
      const std::array<Index, 2> row{static_cast<Index>(i), static_cast<Index>(i + 1)};
      put(sink, row.data(), 2);
    }
}

bool put_binary(const ByteSink& sink, const GlbPlan& plan, const std::stop_token& stop) {
  for (const StoredGeometry& piece : plan.pieces) {
    if (stop.stop_requested()) return false;
    for (const geometry::Vec3d& vertex : piece.vertices()) {
      const std::array<float, 3> row = plan.written(piece, vertex);
      put(sink, row.data(), 3);
    }
  }
  for (const bool wide : {true, false})
    for (const StoredGeometry& piece : plan.pieces) {
      if (piece.wide != wide) continue;
      if (stop.stop_requested()) return false;
      if (wide)
        put_indices<std::uint32_t>(sink, piece);
      else
        put_indices<std::uint16_t>(sink, piece);
    }
  return true;
}

bool put_blocks(const ByteSink& sink, const GlbPlan& plan, const std::stop_token& stop) {
  constexpr std::array<char, kBlockAlignment> kZeros{};
  put(sink, kZeros.data(), static_cast<std::size_t>(plan.blocks_begin() - plan.core_bytes()));
  for (const std::span<const std::byte> block : plan.blocks) {
    if (stop.stop_requested()) return false;
    put(sink, block.data(), block.size());
    put(sink, kZeros.data(), padded(block.size(), kBlockAlignment) - block.size());
  }
  return true;
}

void put_chunk_header(const ByteSink& sink, std::uint64_t length, std::uint32_t type) {
  const std::array<std::uint32_t, 2> header{static_cast<std::uint32_t>(length), type};
  put(sink, header.data(), header.size());
}

}  // namespace

Status put_glb(ByteSink sink, std::string json, const GlbPlan& plan, const std::stop_token& stop) {
  constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  json.resize(padded(json.size(), 4), ' ');
  const std::uint64_t binary = plan.binary_bytes();
  const std::uint64_t total = 12 + 8 + json.size() + (binary == 0 ? 0 : 8 + binary);
  if (total > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::output,
                 "would be larger than the 4 GiB that a GLB may have",
                 {},
                 "write the model in parts"};
  const std::array<std::uint32_t, 3> header{kMagic, 2, static_cast<std::uint32_t>(total)};
  put(sink, header.data(), header.size());
  put_chunk_header(sink, json.size(), kJson);
  sink(json);
  if (binary != 0) {
    put_chunk_header(sink, binary, kBinary);
    if (!put_binary(sink, plan, stop) || !put_blocks(sink, plan, stop))
      return Error{ErrorCode::cancelled, "writing was cancelled", {}, ""};
  }
  return {};
}

Status write_glb_file(const std::filesystem::path& path, std::string json, const GlbPlan& plan,
                      const std::stop_token& stop) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  const auto write = [&](std::string_view bytes) { file->write(bytes); };
  if (const Status status = put_glb(write, std::move(json), plan, stop); !status) {
    Error error = status.error();
    error.where = path.string();
    return error;
  }
  return file->commit();
}

}  // namespace strake::io::gltf
