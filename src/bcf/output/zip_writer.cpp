// SPDX-License-Identifier: Apache-2.0
#include "bcf/output/zip_writer.hpp"

#include <zlib.h>

#include <limits>

namespace strake::bcf {
namespace {

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostEntries = std::numeric_limits<std::uint16_t>::max();

constexpr std::uint32_t kFileMark = 0x04034b50U, kDirectoryMark = 0x02014b50U,
                        kEndMark = 0x06054b50U;
constexpr std::uint16_t kVersion = 20, kStored = 0, kDeflated = 8;
constexpr std::uint16_t kFirstDay = (1U << 5U) | 1U;  ///< the first of January of 1980
constexpr std::uint32_t kFolderAttribute = 0x10;

/// Appends numbers with their lowest byte first.
void append_u16(std::string& out, std::size_t value) {
  out += static_cast<char>(value & 0xFFU);
  out += static_cast<char>((value >> 8U) & 0xFFU);
}

void append_u32(std::string& out, std::uint64_t value) {
  append_u16(out, static_cast<std::size_t>(value & 0xFFFFU));
  append_u16(out, static_cast<std::size_t>((value >> 16U) & 0xFFFFU));
}

/// Appends what the head of a file and its line in the directory have in common.
void append_facts(std::string& out, std::string_view name, const PackedFile& file) {
  append_u16(out, kVersion);
  append_u16(out, 0);
  append_u16(out, file.deflated ? kDeflated : kStored);
  append_u16(out, 0);
  append_u16(out, kFirstDay);
  append_u32(out, file.crc);
  append_u32(out, file.bytes.size());
  append_u32(out, file.size);
  append_u16(out, name.size());
  append_u16(out, 0);
}

Error too_large() {
  return {ErrorCode::output,
          "the archive would be larger than the format allows",
          {},
          "write fewer topics with --bcf-most"};
}

/// Zlib takes bytes that it does not write to by a pointer that could.
Bytef* as_bytes(const char* text) { return reinterpret_cast<Bytef*>(const_cast<char*>(text)); }

}  // namespace

Result<PackedFile> pack(std::string_view bytes) {
  if (bytes.size() >= kMostBytes) return too_large();
  const auto size = static_cast<uInt>(bytes.size());
  PackedFile file{.bytes = {},
                  .crc = static_cast<std::uint32_t>(crc32(0, as_bytes(bytes.data()), size)),
                  .size = size,
                  .deflated = true};
  z_stream stream{};
  constexpr int kNoHeader = -15, kMemory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kNoHeader, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    return out_of_memory();
  file.bytes.resize(deflateBound(&stream, size));
  stream.next_in = as_bytes(bytes.data());
  stream.avail_in = size;
  stream.next_out = as_bytes(file.bytes.data());
  stream.avail_out = static_cast<uInt>(file.bytes.size());
  const int ended = deflate(&stream, Z_FINISH);
  file.bytes.resize(stream.total_out);
  deflateEnd(&stream);
  if (ended != Z_STREAM_END || file.bytes.size() >= bytes.size()) {
    file.bytes = bytes;
    file.deflated = false;
  }
  return file;
}

Status ZipWriter::add_folder(std::string_view name) { return add_entry(name, {}, true); }

Status ZipWriter::add(std::string_view name, const PackedFile& file) {
  return add_entry(name, file, false);
}

Status ZipWriter::add_entry(std::string_view name, const PackedFile& file, bool is_folder) {
  const std::uint64_t at = written_;
  std::string head;
  append_u32(head, kFileMark);
  append_facts(head, name, file);
  head += name;
  if (entries_ >= kMostEntries || at + head.size() + file.bytes.size() > kMostBytes)
    return too_large();
  put(head);
  put(file.bytes);
  ++entries_;
  append_u32(directory_, kDirectoryMark);
  append_u16(directory_, kVersion);
  append_facts(directory_, name, file);
  append_u16(directory_, 0);
  append_u16(directory_, 0);
  append_u16(directory_, 0);
  append_u32(directory_, is_folder ? kFolderAttribute : 0);
  append_u32(directory_, at);
  directory_ += name;
  return {};
}

Status ZipWriter::finish() {
  const std::uint64_t at = written_;
  if (at + directory_.size() > kMostBytes) return too_large();
  std::string end;
  append_u32(end, kEndMark);
  append_u32(end, 0);
  append_u16(end, entries_);
  append_u16(end, entries_);
  append_u32(end, directory_.size());
  append_u32(end, at);
  append_u16(end, 0);
  put(directory_);
  put(end);
  return {};
}

void ZipWriter::put(std::string_view bytes) {
  written_ += bytes.size();
  if (!bytes.empty()) sink_(bytes);
}

}  // namespace strake::bcf
