// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace strake::bcf {

/// A file as it lies in an archive: deflated where that makes it smaller.
struct PackedFile {
  std::string bytes;
  std::uint32_t crc = 0, size = 0;  ///< of what it unpacks to
  bool deflated = false;
};

/// Packs a file; the same bytes give the same ones with the same zlib. Errors: output for one of 4
/// GiB, out of memory.
[[nodiscard]] Result<PackedFile> pack(std::string_view bytes);

/// Writes a zip archive from front to back: nothing is kept of it but its directory. Times are
/// those of 1980-01-01, the first that an archive can state, so that equal contents are equal
/// archives.
class ZipWriter {
 public:
  explicit ZipWriter(report::Sink sink) : sink_(sink) {}

  /// Adds an entry for a folder, whose name ends with '/': readers of some programs ask for it.
  [[nodiscard]] Status add_folder(std::string_view name);
  /// Adds a file; names are ASCII, with '/' between folders.
  [[nodiscard]] Status add(std::string_view name, const PackedFile& file);
  /// Writes the directory, and with it the end. Errors, here and above: output where the archive
  /// has more than 65,535 entries or 4 GiB.
  [[nodiscard]] Status finish();

 private:
  Status add_entry(std::string_view name, const PackedFile& file, bool is_folder);
  void put(std::string_view bytes);

  report::Sink sink_;
  std::string directory_;
  std::uint64_t written_ = 0;
  std::size_t entries_ = 0;
};

}  // namespace strake::bcf
