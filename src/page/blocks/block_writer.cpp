// SPDX-License-Identifier: Apache-2.0
#include "page/blocks/block_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::page {
namespace {

/// Rows of a section.
struct RowRange {
  std::size_t section = 0, begin = 0, end = 0;
};

/// What one worker makes and compresses at a time.
using Batch = std::vector<RowRange>;

/// A batch, compressed so that the next one may follow it in one stream.
struct Packed {
  std::string deflated;
  std::uint32_t crc = 0;
  std::uint64_t bytes = 0;  ///< before it was compressed
};

/// Cuts a block into batches, which depend on the block alone.
class Batches {
 public:
  explicit Batches(const Block& block) : block_(block) {}

  std::optional<Batch> next() {
    Batch batch;
    std::uint64_t bytes = 0;
    while (section_ < block_.sections.size() && bytes < kBatchBytes) {
      const RowSource& section = block_.sections[section_];
      if (row_ >= section.rows) {
        ++section_;
        row_ = 0;
        continue;
      }
      // Rows of texts and shapes are of different lengths: they are cut as if all were the same.
      const std::uint64_t each = std::max<std::uint64_t>(section.bytes / section.rows, 1);
      const std::uint64_t fitting = std::max<std::uint64_t>((kBatchBytes - bytes) / each, 1);
      const std::size_t rows = std::min(section.rows - row_, static_cast<std::size_t>(fitting));
      batch.push_back({section_, row_, row_ + rows});
      row_ += rows;
      bytes += rows * each;
    }
    if (batch.empty()) return std::nullopt;
    return batch;
  }

 private:
  static constexpr std::uint64_t kBatchBytes = std::uint64_t{1} << 18U;
  const Block& block_;
  std::size_t section_ = 0, row_ = 0;
};

Error no_memory_to_pack() { return out_of_memory(); }

/// A stream of zlib, which is ended with it.
class Deflater {
 public:
  Deflater()
      : ready_(deflateInit2(&stream_, kLevel, Z_DEFLATED, kRaw, 8, Z_DEFAULT_STRATEGY) == Z_OK) {}
  ~Deflater() {
    if (ready_) (void)deflateEnd(&stream_);
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  Deflater(Deflater&&) = delete;
  Deflater& operator=(Deflater&&) = delete;

  /// Returns the text compressed up to the end of a byte, as a stream that does not end.
  Result<std::string> pack(std::string& text) {
    if (!ready_) return no_memory_to_pack();
    constexpr std::size_t kFlush = 64;  // what a flush may take besides
    std::string packed(deflateBound(&stream_, static_cast<uLong>(text.size())) + kFlush, '\0');
    stream_.next_in = reinterpret_cast<Bytef*>(text.data());
    stream_.avail_in = static_cast<uInt>(text.size());
    stream_.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream_.avail_out = static_cast<uInt>(packed.size());
    if (deflate(&stream_, Z_SYNC_FLUSH) != Z_OK || stream_.avail_in != 0)
      return no_memory_to_pack();
    packed.resize(packed.size() - stream_.avail_out);
    return packed;
  }

 private:
  static constexpr int kLevel = 6, kRaw = -15;
  z_stream stream_{};
  bool ready_;
};

Result<Packed> pack(const Block& block, const Batch& batch) {
  std::string text;
  for (const RowRange& piece : batch)
    block.sections[piece.section].append(piece.begin, piece.end, text);
  Packed packed;
  packed.bytes = text.size();
  packed.crc = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
  Result<std::string> deflated = Deflater().pack(text);
  if (!deflated) return deflated.error();
  packed.deflated = std::move(*deflated);
  return packed;
}

/// Hands bytes on as base64, in whole groups of three but for the last.
class Base64Writer {
 public:
  explicit Base64Writer(report::Sink sink) : sink_(sink) {}

  void write(std::string_view bytes) {
    held_ += bytes;
    put(held_.size() - held_.size() % 3);
  }
  void finish() { put(held_.size()); }

 private:
  void put(std::size_t count) {
    std::string text;
    append_base64(text, std::span(reinterpret_cast<const std::uint8_t*>(held_.data()), count));
    held_.erase(0, count);
    if (!text.empty()) sink_(text);
  }
  report::Sink sink_;
  std::string held_;
};

void append_word(std::string& out, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    out += static_cast<char>((word >> shift) & 0xffU);
}

/// The head of a gzip file: deflate, no flags, no time, best known as made anywhere.
constexpr std::string_view kGzipHead("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\xff", 10);
/// A block of deflate that is empty and the last.
constexpr std::string_view kLastOfStream("\x03\x00", 2);

}  // namespace

Status write_block(const Block& block, report::Sink sink, const parallel::Context& context) {
  sink("<script type=\"application/octet-stream+gzip\" id=\"" + block.id + "\">");
  Base64Writer base64(sink);
  base64.write(kGzipHead);
  const parallel::ProgressPhase phase(context.progress, "page", block.bytes());
  Batches batches(block);
  std::uint32_t crc = 0;
  std::uint64_t bytes = 0;
  std::exception_ptr thrown;
  const Status status = parallel::pipeline(
      context, {.name = "page"}, [&] { return batches.next(); },
      [&](const Batch& batch) { return pack(block, batch); },
      [&](const Packed& packed) -> Status {
        try {
          base64.write(packed.deflated);
        } catch (...) {
          thrown = std::current_exception();
          return Error{ErrorCode::internal, "the sink threw", {}, {}};
        }
        crc = static_cast<std::uint32_t>(
            crc32_combine(crc, packed.crc, static_cast<z_off_t>(packed.bytes)));
        bytes += packed.bytes;
        phase.add(packed.bytes);
        return {};
      });
  if (thrown) std::rethrow_exception(thrown);
  if (!status) return status;
  std::string end(kLastOfStream);
  append_word(end, crc);
  append_word(end, static_cast<std::uint32_t>(bytes & 0xffffffffU));
  base64.write(end);
  base64.finish();
  sink("</script>\n");
  return {};
}

}  // namespace strake::page
