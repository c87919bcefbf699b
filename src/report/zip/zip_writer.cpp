// SPDX-License-Identifier: Apache-2.0
#include "report/zip/zip_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace strake::report {
namespace {

constexpr std::uint64_t kMaxBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxEntries = std::numeric_limits<std::uint16_t>::max();
/// The last piece of every file: a block without bytes that says that it is the last.
constexpr std::string_view kLastPiece("\x03\x00", 2);

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

Error no_memory_to_deflate() {
  return {ErrorCode::memory, "no memory to pack a file with", {}, {}};
}

}  // namespace

Result<DeflatedPiece> deflate_piece(std::string_view text) {
  // On rows of results the next level takes two thirds longer for a twentieth fewer bytes, the
  // third a third less time for an eighth more.
  constexpr int kLevel = 5, kRaw = -15, kMemory = 8;
  constexpr std::size_t kMaxAtOnce = std::size_t{1} << 30U;
  DeflatedPiece piece;
  piece.size = text.size();
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    return no_memory_to_deflate();
  uLong crc = crc32(0, nullptr, 0);
  std::string room(std::min<std::size_t>(text.size() / 4 + 1024, kMaxAtOnce), '\0');
  do {
    const std::string_view taken = text.substr(0, kMaxAtOnce);
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

Result<PackedFile> pack(std::string_view bytes) {
  Result<DeflatedPiece> piece = deflate_piece(bytes);
  if (!piece) return piece.error();
  piece->bytes += kLastPiece;
  PackedFile file{std::move(piece->bytes), piece->crc, piece->size, true};
  if (file.bytes.size() < bytes.size()) return file;
  file.bytes = bytes;
  file.deflated = false;
  return file;
}

void ZipWriter::put(std::string_view bytes) {
  if (!bytes.empty()) sink_(bytes);
  written_ += bytes.size();
}

Error ZipWriter::too_large() const {
  return {ErrorCode::output, "the file would be larger than its format allows", {}, mend_};
}

/// Appends what stands before an entry and in the directory: the version that reads it, what is
/// special of it, how it is packed, the date 1980-01-01, checksum and sizes.
void ZipWriter::append_facts(std::string& out, std::string_view name, const Entry& entry,
                             bool sizes_known) {
  constexpr std::uint64_t kVersion = 20, kSizesBehind = 8, kDeflated = 8, kFirstDay = 33;
  append_little(out, kVersion, 2);
  append_little(out, entry.sizes_behind ? kSizesBehind : 0, 2);
  append_little(out, entry.deflated ? kDeflated : 0, 2);
  append_little(out, 0, 2);
  append_little(out, kFirstDay, 2);
  append_little(out, sizes_known ? entry.crc : 0, 4);
  append_little(out, sizes_known ? entry.packed : 0, 4);
  append_little(out, sizes_known ? entry.size : 0, 4);
  append_little(out, name.size(), 2);
  append_little(out, 0, 2);
}

/// Puts an entry that began there into the directory.
Status ZipWriter::enter(std::string_view name, const Entry& entry, std::uint64_t at) {
  constexpr std::uint64_t kFolder = 16;
  if (entry.size >= kMaxBytes || written_ >= kMaxBytes || entries_ >= kMaxEntries)
    return too_large();
  directory_ += "PK\x01\x02";
  append_little(directory_, 20, 2);
  append_facts(directory_, name, entry, true);
  append_little(directory_, 0, 6);  // no comment, one disk, bytes rather than text
  append_little(directory_, entry.is_folder ? kFolder : 0, 4);
  append_little(directory_, at, 4);
  directory_ += name;
  ++entries_;
  return {};
}

void ZipWriter::begin(std::string_view name) {
  name_ = name;
  begun_ = written_;
  entry_ = {.sizes_behind = true};
  std::string head("PK\x03\x04");
  append_facts(head, name, entry_, false);
  put(head.append(name));
}

void ZipWriter::add(const DeflatedPiece& piece) {
  entry_.crc = static_cast<std::uint32_t>(
      crc32_combine(entry_.crc, piece.crc, static_cast<z_off_t>(piece.size)));
  entry_.size += piece.size;
  entry_.packed += piece.bytes.size();
  put(piece.bytes);
}

Status ZipWriter::end() {
  put(kLastPiece);
  entry_.packed += kLastPiece.size();
  std::string facts("PK\x07\x08");
  append_little(facts, entry_.crc, 4);
  append_little(facts, entry_.packed, 4);
  append_little(facts, entry_.size, 4);
  put(facts);
  return enter(name_, entry_, begun_);
}

Status ZipWriter::add_whole(std::string_view name, const Entry& entry, std::string_view bytes) {
  const std::uint64_t at = written_;
  std::string head("PK\x03\x04");
  append_facts(head, name, entry, true);
  put(head.append(name));
  put(bytes);
  return enter(name, entry, at);
}

Status ZipWriter::add_file(std::string_view name, const PackedFile& file) {
  return add_whole(
      name,
      {.crc = file.crc, .packed = file.bytes.size(), .size = file.size, .deflated = file.deflated},
      file.bytes);
}

Status ZipWriter::add_file(std::string_view name, std::string_view bytes) {
  const Result<PackedFile> file = pack(bytes);
  if (!file) return file.error();
  return add_file(name, *file);
}

Status ZipWriter::add_folder(std::string_view name) {
  return add_whole(name, {.deflated = false, .is_folder = true}, {});
}

Status ZipWriter::finish() {
  const std::uint64_t at = written_;
  if (at + directory_.size() >= kMaxBytes) return too_large();
  std::string last("PK\x05\x06");
  append_little(last, 0, 4);
  append_little(last, entries_, 2);
  append_little(last, entries_, 2);
  append_little(last, directory_.size(), 4);
  append_little(last, at, 4);
  append_little(last, 0, 2);
  put(directory_);
  put(last);
  return {};
}

}  // namespace strake::report
