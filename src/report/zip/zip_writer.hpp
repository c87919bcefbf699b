// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

/// A piece of a file, deflated by itself: pieces are made by many workers and put together in
/// order. It ends at a byte and is not the last of its file.
struct DeflatedPiece {
  std::string bytes;
  std::uint32_t crc = 0;   ///< of what it unpacks to
  std::uint64_t size = 0;  ///< of what it unpacks to
};

/// Deflates a piece; the same text gives the same bytes with the same zlib. Errors: memory.
[[nodiscard]] Result<DeflatedPiece> deflate_piece(std::string_view text);

/// Append a piece to a text and take it off again, for those who hand texts on.
void append_piece(std::string& out, const DeflatedPiece& piece);
[[nodiscard]] DeflatedPiece parse_piece(std::string_view text);

/// A whole file as it lies in an archive: deflated where that makes it smaller.
struct PackedFile {
  std::string bytes;
  std::uint32_t crc = 0;   ///< of what it unpacks to
  std::uint64_t size = 0;  ///< of what it unpacks to
  bool deflated = false;
};

/// Packs a file; the same bytes give the same ones with the same zlib. Errors: memory.
[[nodiscard]] Result<PackedFile> pack(std::string_view bytes);

/// Writes a zip archive from front to back: nothing is kept of it but its directory. Times are
/// those of 1980-01-01, the first that an archive can state, so that equal contents are equal
/// archives.
class ZipWriter {
 public:
  /// The sink must outlast the writer. `mend` is what errors advise where the archive gets too
  /// large.
  ZipWriter(report::Sink sink, std::string mend) : sink_(sink), mend_(std::move(mend)) {}

  /// Begins a file, whose pieces follow; names are ASCII, with '/' between folders. Its sizes stand
  /// behind it, for they are not known before.
  void begin(std::string_view name);
  void add(const DeflatedPiece& piece);
  /// Ends the file. Errors, here and below: output where a file or the archive has 4 GiB, or the
  /// archive 65,536 entries.
  [[nodiscard]] Status end();
  /// Adds a file whole, with its sizes in front of it.
  [[nodiscard]] Status add_file(std::string_view name, const PackedFile& file);
  /// Packs a file and adds it. Errors: memory, too.
  [[nodiscard]] Status add_file(std::string_view name, std::string_view bytes);
  /// Adds an entry for a folder, whose name ends with '/': readers of some programs request it.
  [[nodiscard]] Status add_folder(std::string_view name);
  /// Writes the directory, and with it the end.
  [[nodiscard]] Status finish();

 private:
  /// What the archive states of an entry, before it and in the directory.
  struct Entry {
    std::uint32_t crc = 0;
    std::uint64_t packed = 0, size = 0;
    bool deflated = true, sizes_behind = false, is_folder = false;
  };
  static void append_facts(std::string& out, std::string_view name, const Entry& entry,
                           bool sizes_known);
  [[nodiscard]] Status add_whole(std::string_view name, const Entry& entry, std::string_view bytes);
  [[nodiscard]] Status enter(std::string_view name, const Entry& entry, std::uint64_t at);
  [[nodiscard]] Error too_large() const;
  void put(std::string_view bytes);

  report::Sink sink_;
  std::string mend_;
  std::string name_;  ///< of the file that is begun
  std::uint64_t begun_ = 0;
  Entry entry_;  ///< of the file that is begun
  std::string directory_;
  std::uint64_t written_ = 0;
  std::size_t entries_ = 0;
};

}  // namespace strake::report
