// SPDX-License-Identifier: Apache-2.0
#include "workbook/zip/zip_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace strake::workbook {
namespace {

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();
/// The last piece of every file: a block without bytes that says that it is the last.
constexpr std::string_view kLastPiece("\x03\x00", 2);
/// What the archive states of every file: version 2.0 reads it; sizes stand behind the file and
/// names are UTF-8; deflated; the date 1980-01-01.
constexpr std::string_view kFileFacts("\x14\x00\x08\x08\x08\x00\x00\x00\x21\x00", 10);

/// Appends a number in so many bytes, the lowest first.
void append_little(std::string& out, std::uint64_t number, int bytes) {
  for (int i = 0; i < bytes; ++i, number >>= 8U) out += static_cast<char>(number & 0xFFU);
}

/// Returns such a number from the front of a text.
std::uint64_t parse_little(std::string_view text, std::size_t bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = bytes; i > 0; --i)
    number = (number << 8U) | static_cast<unsigned char>(text[i - 1]);
  return number;
}

Error too_large() {
  return {ErrorCode::output,
          "a workbook cannot have 4 GiB",
          {},
          "write .csv, or leave results out with --class"};
}

Error no_memory() { return {ErrorCode::memory, "no memory to pack a workbook with", {}, {}}; }

}  // namespace

Result<DeflatedPiece> deflate_piece(std::string_view text) {
  // On rows of results the next level takes two thirds longer for a twentieth fewer bytes, the
  // third a third less time for an eighth more.
  constexpr int kLevel = 5, kRaw = -15, kMemory = 8;
  constexpr std::size_t kMostAtOnce = std::size_t{1} << 30U;
  DeflatedPiece piece;
  piece.size = text.size();
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    return no_memory();
  uLong crc = crc32(0, nullptr, 0);
  std::string room(std::min<std::size_t>(text.size() / 4 + 1024, kMostAtOnce), '\0');
  do {
    const std::string_view taken = text.substr(0, kMostAtOnce);
    text.remove_prefix(taken.size());
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast,cppcoreguidelines-pro-type-const-cast):
    // zlib's own word for bytes, which it reads through a pointer that is not const.
    auto* const bytes = reinterpret_cast<Bytef*>(const_cast<char*>(taken.data()));
    crc = crc32(crc, bytes, static_cast<uInt>(taken.size()));
    stream.next_in = bytes;
    stream.avail_in = static_cast<uInt>(taken.size());
    do {
      stream.next_out = reinterpret_cast<Bytef*>(room.data());
      stream.avail_out = static_cast<uInt>(room.size());
      // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast,cppcoreguidelines-pro-type-const-cast)
      deflate(&stream, text.empty() ? Z_SYNC_FLUSH : Z_NO_FLUSH);
      piece.bytes.append(room, 0, room.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  } while (!text.empty());
  deflateEnd(&stream);
  piece.crc = static_cast<std::uint32_t>(crc);
  return piece;
}

void append_piece(std::string& out, const DeflatedPiece& piece) {
  append_little(out, piece.crc, 4);
  append_little(out, piece.size, 8);
  out += piece.bytes;
}

DeflatedPiece parse_piece(std::string_view text) {
  constexpr std::size_t kHead = 12;
  return {std::string(text.substr(kHead)), static_cast<std::uint32_t>(parse_little(text, 4)),
          parse_little(text.substr(4), 8)};
}

void ZipWriter::put(std::string_view bytes) {
  sink_(bytes);
  written_ += bytes.size();
}

void ZipWriter::begin(std::string_view name) {
  name_ = name;
  begun_ = written_;
  packed_ = size_ = 0;
  crc_ = 0;
  std::string head("PK\x03\x04");
  head += kFileFacts;
  append_little(head, 0, 12);  // the checksum and both sizes come later
  append_little(head, name.size(), 2);
  append_little(head, 0, 2);
  put(head.append(name));
}

void ZipWriter::add(const DeflatedPiece& piece) {
  crc_ =
      static_cast<std::uint32_t>(crc32_combine(crc_, piece.crc, static_cast<z_off_t>(piece.size)));
  size_ += piece.size;
  packed_ += piece.bytes.size();
  put(piece.bytes);
}

Status ZipWriter::end() {
  put(kLastPiece);
  packed_ += kLastPiece.size();
  if (size_ >= kMostBytes || written_ >= kMostBytes) return too_large();
  std::string facts;
  append_little(facts, crc_, 4);
  append_little(facts, packed_, 4);
  append_little(facts, size_, 4);
  put("PK\x07\x08");
  put(facts);
  directory_ += "PK\x01\x02";
  append_little(directory_, 20, 2);
  directory_ += kFileFacts;
  directory_ += facts;
  append_little(directory_, name_.size(), 2);
  append_little(directory_, 0, 12);  // nothing more of it: no comment, no attributes
  append_little(directory_, begun_, 4);
  directory_ += name_;
  ++files_;
  return {};
}

Status ZipWriter::add_file(std::string_view name, std::string_view text) {
  const Result<DeflatedPiece> piece = deflate_piece(text);
  if (!piece) return piece.error();
  begin(name);
  add(*piece);
  return end();
}

Status ZipWriter::finish() {
  const std::uint64_t at = written_;
  if (at + directory_.size() >= kMostBytes) return too_large();
  std::string last("PK\x05\x06");
  append_little(last, 0, 4);
  append_little(last, files_, 2);
  append_little(last, files_, 2);
  append_little(last, directory_.size(), 4);
  append_little(last, at, 4);
  append_little(last, 0, 2);
  put(directory_);
  put(last);
  return {};
}

}  // namespace strake::workbook
