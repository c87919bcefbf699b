// SPDX-License-Identifier: Apache-2.0
#include "tiles/kept/blob_file.hpp"

#include <cstdint>
#include <cstring>

#include "io/source/input_file.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::tiles {

Error lost(const std::filesystem::path& file) {
  return {ErrorCode::input, kLost, file.string(), "run the test again, in an empty folder"};
}

Status write_blobs(const std::filesystem::path& file, std::span<const Blob> blobs) {
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  for (const Blob& blob : blobs) {
    const std::uint64_t size = blob.size();
    out->write(std::as_bytes(std::span(&size, 1)));
    out->write(std::span<const std::byte>(blob));
  }
  return out->commit_soon();
}

Result<std::vector<Blob>> read_blobs(const std::filesystem::path& file, std::size_t at_least,
                                     const parallel::Context& context) {
  const Result<io::FileContent> content = io::FileContent::read(file, context);
  if (!content) return content.error().code == ErrorCode::input ? lost(file) : content.error();
  std::vector<Blob> blobs;
  std::span<const std::byte> rest = content->bytes();
  while (!rest.empty()) {
    std::uint64_t size = 0;
    if (rest.size() < sizeof size) return lost(file);
    std::memcpy(&size, rest.data(), sizeof size);
    rest = rest.subspan(sizeof size);
    if (size > rest.size()) return lost(file);
    const auto blob = rest.first(static_cast<std::size_t>(size));
    blobs.emplace_back(blob.begin(), blob.end());
    rest = rest.subspan(blob.size());
  }
  if (blobs.size() < at_least) return lost(file);
  return blobs;
}

}  // namespace strake::tiles
