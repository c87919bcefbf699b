// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/binary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "io/rvm/facet_group.hpp"

namespace strake::io::rvm {

namespace {

constexpr std::size_t kIdBytes = 16;
constexpr std::size_t kFrameBytes = 24;  // id, next, an unused word
constexpr std::size_t kHeadSearch = 65536;
constexpr std::size_t kDeepest = 10000;

enum class ChunkId { head, modl, cntb, cnte, prim, obst, insu, colr, end, unknown };

constexpr std::uint32_t pack(std::string_view id) {
  std::uint32_t packed = 0;
  for (const char c : id) packed = packed << 8 | static_cast<unsigned char>(c);
  return packed;
}

/// Returns the four letters of an id, one in the low byte of each big-endian word, as one number; 0
/// where there can be no id.
std::uint32_t id_at(Bytes bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < kFrameBytes) return 0;
  std::uint32_t id = 0;
  for (std::size_t k = 0; k < kIdBytes; k += 4) {
    const std::uint32_t word = load_u32(bytes.data() + at + k);
    if (word < 0x20 || word > 0x7E) return 0;
    id = id << 8 | word;
  }
  return id;
}

std::string letters(std::uint32_t id) {
  return {static_cast<char>(id >> 24), static_cast<char>(id >> 16 & 0xFFU),
          static_cast<char>(id >> 8 & 0xFFU), static_cast<char>(id & 0xFFU)};
}

ChunkId chunk_at(Bytes bytes, std::size_t at) {
  switch (id_at(bytes, at)) {
    case pack("HEAD"):
      return ChunkId::head;
    case pack("MODL"):
      return ChunkId::modl;
    case pack("CNTB"):
      return ChunkId::cntb;
    case pack("CNTE"):
      return ChunkId::cnte;
    case pack("PRIM"):
      return ChunkId::prim;
    case pack("OBST"):
      return ChunkId::obst;
    case pack("INSU"):
      return ChunkId::insu;
    case pack("COLR"):
      return ChunkId::colr;
    case pack("END:"):
      return ChunkId::end;
    default:
      return ChunkId::unknown;
  }
}

/// Whether a model lacks geometry, or the group that it belongs to, without the chunk.
bool holds_geometry(ChunkId chunk) {
  return chunk != ChunkId::head && chunk != ChunkId::modl && chunk != ChunkId::colr;
}

class BinaryReader {
 public:
  BinaryReader(Bytes bytes, const std::optional<TextDecoder>& stated, RvmBuilder& builder,
               DiagnosticLog& log, FileHead& head)
      : bytes_(bytes), builder_(&builder), log_(&log), head_(&head) {
    // A stated encoding aside, the field of HEAD adds nothing: names are taken as UTF-8 where
    // they are, as Windows-1252 otherwise, which also covers files that state one and hold the
    // other.
    if (stated) decode_ = *stated;
  }

  [[nodiscard]] FileRead read(const parallel::Context& context);

 private:
  void note_truncation();
  void read_chunk();
  [[nodiscard]] bool read_body(ChunkId chunk, BigEndianCursor& in);
  [[nodiscard]] bool read_head(BigEndianCursor& in);
  [[nodiscard]] bool read_model(BigEndianCursor& in);
  [[nodiscard]] bool read_group(BigEndianCursor& in);
  [[nodiscard]] bool read_color(BigEndianCursor& in);
  [[nodiscard]] bool read_primitive(ChunkId chunk, BigEndianCursor& in);
  void read_category(PrimitiveChunk& primitive, BigEndianCursor& in);
  [[nodiscard]] std::optional<std::size_t> next_of(std::size_t at) const;
  void skip_unknown(std::optional<std::size_t> next);
  void leave_chunk(std::size_t body_end, std::optional<std::size_t> next);
  [[nodiscard]] std::size_t next_chunk(std::size_t from) const;
  void resynchronise(std::size_t from);

  Bytes bytes_;
  TextDecoder decode_;
  RvmBuilder* builder_;
  DiagnosticLog* log_;
  FileHead* head_;
  std::size_t at_ = 0;
  bool ended_ = false;
  std::size_t flattened_ = 0;  ///< groups open beyond the depth limit
  std::unordered_set<std::uint32_t> unknown_ids_;
  bool bounded_ = false;  ///< the body being read ends where the next chunk begins
};

/// Returns where the chunk says that the next one begins: 32 bits that wrap in files beyond 4 GiB.
/// Nothing is returned when that lies before the end of this chunk's frame or after the file's end.
std::optional<std::size_t> BinaryReader::next_of(std::size_t at) const {
  constexpr std::size_t kWrap = std::size_t{1} << 32;
  std::size_t next = (at & ~(kWrap - 1)) | load_u32(bytes_.data() + at + kIdBytes);
  if (next < at) next += kWrap;
  if (next < at + kFrameBytes || next > bytes_.size()) return std::nullopt;
  return next;
}

FileRead BinaryReader::read(const parallel::Context& context) {
  at_ = find_head(bytes_).value_or(0);
  if (at_ > 0)
    log_->warn("rvm-leading-bytes", fmt::format("{} bytes before the HEAD chunk", at_), 0);
  for (std::size_t chunks = 0; !ended_; ++chunks) {
    if (chunks % 1024 == 0 && context.stop.stop_requested()) return {.cancelled = true};
    if (bytes_.size() - at_ < kFrameBytes) {
      note_truncation();
      break;
    }
    read_chunk();
  }
  if (builder_->depth() > 0 && ended_)
    log_->warn("rvm-unclosed-group",
               fmt::format("{} groups are still open at the end", builder_->depth()), at_);
  return {.ends_early = !ended_};
}

/// Marks the group in which the file ends as incomplete; what else is missing cannot be known.
void BinaryReader::note_truncation() {
  if (builder_->depth() > 0) builder_->note_loss(at_);
  log_->skip("rvm-truncated",
             "the file ends without an END chunk; what came before it is kept, the rest is unknown",
             at_);
}

void BinaryReader::read_chunk() {
  const ChunkId chunk = chunk_at(bytes_, at_);
  const auto next = next_of(at_);
  if (chunk == ChunkId::unknown) {
    skip_unknown(next);
    return;
  }
  if (chunk == ChunkId::end) {
    ended_ = true;
    return;
  }
  // A chunk must not be read beyond the next one, whatever its counts say: not in a file that
  // states where that is, nor in one that does not, where each chunk might claim all that follows.
  bounded_ = next && chunk_at(bytes_, *next) != ChunkId::unknown;
  const std::size_t end = bounded_ ? *next : next_chunk(at_ + kIdBytes);
  BigEndianCursor in(bytes_.first(end), at_ + kFrameBytes);
  if (read_body(chunk, in)) {
    leave_chunk(in.at(), next);
    return;
  }
  if (holds_geometry(chunk)) builder_->note_loss(at_);
  log_->skip("rvm-damaged-chunk",
             fmt::format("a {} chunk does not hold all that it must", letters(id_at(bytes_, at_))),
             at_);
  if (bounded_)
    at_ = *next;
  else
    resynchronise(at_ + kIdBytes);
}

/// Goes on after a chunk whose body ended at `body_end`, trusting what is in the file more
/// than the stated address, which rewritten files leave stale.
void BinaryReader::leave_chunk(std::size_t body_end, std::optional<std::size_t> next) {
  if (next == body_end) {
    at_ = body_end;
    return;
  }
  if (chunk_at(bytes_, body_end) != ChunkId::unknown) {
    log_->warn("rvm-stale-address", "the stated address of the next chunk is wrong", at_);
    at_ = body_end;
  } else if (next && *next > body_end && chunk_at(bytes_, *next) != ChunkId::unknown) {
    log_->warn("rvm-extra-bytes",
               fmt::format("{} bytes more than expected in a chunk", *next - body_end), at_);
    at_ = *next;
  } else {
    resynchronise(body_end);
  }
}

void BinaryReader::skip_unknown(std::optional<std::size_t> next) {
  const std::uint32_t id = id_at(bytes_, at_);
  if (id == 0 || !next || chunk_at(bytes_, *next) == ChunkId::unknown) {
    resynchronise(at_);
    return;
  }
  constexpr std::size_t kMaxIds = 64;
  if (unknown_ids_.size() < kMaxIds && unknown_ids_.insert(id).second)
    log_->skip("rvm-unknown-chunk", fmt::format("chunks \"{}\" are not known", letters(id)), at_);
  builder_->note_loss(at_);
  at_ = *next;
}

/// Returns the first chunk id at or after `from`, at any alignment: bytes may be missing.
std::size_t BinaryReader::next_chunk(std::size_t from) const {
  for (std::size_t at = from; at + kFrameBytes <= bytes_.size(); ++at) {
    // The first word of an id: three zero bytes and a capital letter.
    if (bytes_[at] != std::byte{0} || bytes_[at + 3] < std::byte{'A'}) continue;
    if (chunk_at(bytes_, at) != ChunkId::unknown) return at;
  }
  return bytes_.size();
}

void BinaryReader::resynchronise(std::size_t from) {
  const std::size_t found = next_chunk(from);
  builder_->note_loss(from);
  log_->skip("rvm-lost-bytes", fmt::format("{} bytes are not readable as chunks", found - from),
             from);
  at_ = found;
}

bool BinaryReader::read_body(ChunkId chunk, BigEndianCursor& in) {
  switch (chunk) {
    case ChunkId::head:
      return read_head(in);
    case ChunkId::modl:
      return read_model(in);
    case ChunkId::cntb:
      return read_group(in);
    case ChunkId::cnte:
      in.skip(4);
      if (in.failed()) return false;
      if (flattened_ > 0)
        --flattened_;
      else if (!builder_->end_group())
        log_->warn("rvm-stray-end", "a CNTE chunk closes no group", at_);
      return true;
    case ChunkId::colr:
      return read_color(in);
    case ChunkId::prim:
    case ChunkId::obst:
    case ChunkId::insu:
      return read_primitive(chunk, in);
    case ChunkId::end:
    case ChunkId::unknown:
      break;
  }
  return false;
}

bool BinaryReader::read_head(BigEndianCursor& in) {
  FileHead head;
  head.version = in.u32();
  std::array<Bytes, 4> fields;
  for (Bytes& field : fields) field = in.string();
  Bytes encoding;
  if (head.version >= 2) encoding = in.string();
  if (in.failed()) return false;
  head.encoding = TextDecoder()(encoding);
  head.info = decode_(fields[0]);
  head.note = decode_(fields[1]);
  head.date = decode_(fields[2]);
  head.user = decode_(fields[3]);
  head.project = std::move(head_->project);
  head.name = std::move(head_->name);
  *head_ = std::move(head);
  return true;
}

bool BinaryReader::read_model(BigEndianCursor& in) {
  in.skip(4);
  const Bytes project = in.string(), name = in.string();
  if (in.failed()) return false;
  head_->project = decode_(project);
  head_->name = decode_(name);
  builder_->set_root_name(head_->name);
  return true;
}

bool BinaryReader::read_group(BigEndianCursor& in) {
  const std::uint32_t version = in.u32();
  const Bytes name = in.string();
  in.skip(12);  // a reference point, informative only
  const std::uint32_t material = in.u32();
  std::uint8_t transparency = 0;
  if (version >= 3) {
    transparency = in.u8();
    in.skip(3);
  }
  if (version == 4) in.skip(24);
  if (in.failed()) return false;
  if (builder_->depth() >= kDeepest) {
    ++flattened_;
    log_->warn(
        "rvm-too-deep",
        fmt::format("a group nested deeper than {} levels is merged into its parent", kDeepest),
        at_);
    return true;
  }
  builder_->begin_group(decode_(name), material, transparency, at_);
  return true;
}

bool BinaryReader::read_color(BigEndianCursor& in) {
  in.skip(4);
  const std::uint32_t index = in.u32();
  const std::uint8_t red = in.u8(), green = in.u8(), blue = in.u8();
  in.skip(1);
  if (in.failed()) return false;
  builder_->redefine_color(index, {red, green, blue, 255});
  return true;
}

/// Reads one more word of obstruction and insulation volumes, whose place the known readers do not
/// agree about: it is taken after the box unless only the other place makes the matrix a frame.
void BinaryReader::read_category(PrimitiveChunk& primitive, BigEndianCursor& in) {
  const auto read_floats = [](BigEndianCursor& cursor, auto& values) {
    for (float& value : values) value = cursor.f32();
  };
  BigEndianCursor shifted = in;
  read_floats(in, primitive.matrix);
  read_floats(in, primitive.box);
  if (primitive.category == model::Category::physical) return;
  primitive.transparency = in.u8();
  in.skip(3);
  if (is_plausible_frame(primitive.matrix)) return;
  PrimitiveChunk other = primitive;
  other.transparency = shifted.u8();
  shifted.skip(3);
  read_floats(shifted, other.matrix);
  read_floats(shifted, other.box);
  if (shifted.failed() || !is_plausible_frame(other.matrix)) return;
  log_->warn("rvm-shifted-matrix", "the transparency stands before the matrix", at_);
  primitive = other;
  in = shifted;
}

bool BinaryReader::read_primitive(ChunkId chunk, BigEndianCursor& in) {
  PrimitiveChunk primitive;
  primitive.offset = at_;
  if (chunk == ChunkId::obst) primitive.category = model::Category::obstruction;
  if (chunk == ChunkId::insu) primitive.category = model::Category::insulation;
  in.skip(4);
  primitive.kind = in.u32();
  read_category(primitive, in);
  if (in.failed()) return false;
  if (primitive.kind == kFacetKind) {
    const auto facets = take_facet_bytes(in, bytes_);
    if (!facets) return false;
    primitive.parameters = *facets;
  } else {
    const std::size_t count = parameter_count(primitive.kind);
    if (count == 0) {
      builder_->note_loss(at_);
      log_->skip("rvm-unknown-kind",
                 fmt::format("primitives of kind {} are not known", primitive.kind), at_);
      if (bounded_) in.skip(in.left());
      return true;
    }
    primitive.parameters = in.take(count * 4);
  }
  if (in.failed()) return false;
  builder_->add(primitive);
  return true;
}

}  // namespace

std::optional<std::size_t> find_head(Bytes bytes) {
  for (std::size_t at = 0; at + kFrameBytes <= bytes.size() && at < kHeadSearch; ++at)
    if (bytes[at] == std::byte{0} && chunk_at(bytes, at) == ChunkId::head) return at;
  return std::nullopt;
}

bool is_byte_swapped(Bytes bytes) {
  static constexpr std::string_view kSwapped("H\0\0\0E\0\0\0A\0\0\0D\0\0\0", 16);
  return bytes.size() >= kSwapped.size() &&
         std::memcmp(bytes.data(), kSwapped.data(), kSwapped.size()) == 0;
}

FileRead read_binary(Bytes bytes, const std::optional<TextDecoder>& stated_encoding,
                     RvmBuilder& builder, DiagnosticLog& log, FileHead& head,
                     const parallel::Context& context) {
  return BinaryReader(bytes, stated_encoding, builder, log, head).read(context);
}

}  // namespace strake::io::rvm
