// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace strake::workbook {

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

/// Writes a zip archive from front to back: nothing is kept of it but its directory. Times are
/// those of 1980-01-01, the first that an archive can state, so that equal contents are equal
/// archives. Sizes stand behind each file, for they are not known before.
class ZipWriter {
 public:
  /// The sink must outlast the writer.
  explicit ZipWriter(report::Sink sink) : sink_(sink) {}

  /// Begins a file, whose pieces follow; names are ASCII, with '/' between folders.
  void begin(std::string_view name);
  void add(const DeflatedPiece& piece);
  /// Ends the file. Errors, here and below: output where a file or the archive has 4 GiB.
  [[nodiscard]] Status end();
  /// Adds a file whole. Errors: memory, too.
  [[nodiscard]] Status add_file(std::string_view name, std::string_view text);
  /// Writes the directory, and with it the end.
  [[nodiscard]] Status finish();

 private:
  void put(std::string_view bytes);

  report::Sink sink_;
  std::string name_;  ///< of the file that is begun
  std::uint64_t begun_ = 0, packed_ = 0, size_ = 0;
  std::uint32_t crc_ = 0;
  std::string directory_;
  std::uint64_t written_ = 0;
  std::uint16_t files_ = 0;
};

}  // namespace strake::workbook
