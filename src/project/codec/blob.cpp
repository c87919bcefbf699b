// SPDX-License-Identifier: Apache-2.0
#include "project/codec/blob.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

namespace strake::project {
namespace {

// Columns are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 4> kMagic{'S', 'K', 'B', '1'};

enum class Packing : std::uint32_t { none, zstd };

/// What stands before the values.
struct BlobHead {
  std::array<char, 4> magic = kMagic;
  Packing packing = Packing::none;
  std::uint64_t raw_size = 0;
  Hash128 hash;  ///< of the values, before they are compressed
};
static_assert(sizeof(BlobHead) == 32);

/// Returns the most that so many bytes may become, so that a small file cannot fill the memory.
/// What compresses better is stored as it is.
constexpr std::uint64_t max_raw_size(std::uint64_t stored) {
  constexpr std::uint64_t kAlways = 1U << 16U, kTimes = 256;
  constexpr std::uint64_t kMax = std::uint64_t{1} << 40U;
  return kAlways + std::min(stored, kMax / kTimes) * kTimes;
}

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

/// Returns the head of a blob; nothing where it, or what it says of the rest, cannot be.
std::optional<BlobHead> head_of(std::span<const std::byte> blob) {
  BlobHead head;
  if (blob.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, blob.data(), sizeof head);
  const std::span<const std::byte> packed = blob.subspan(sizeof head);
  const bool stored = head.packing == Packing::none && head.raw_size == packed.size();
  const bool compressed = head.packing == Packing::zstd &&
                          head.raw_size <= max_raw_size(packed.size()) &&
                          head.raw_size == ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (head.magic != kMagic || (!stored && !compressed)) return std::nullopt;
  return head;
}

/// Puts all first bytes before all second ones, and so on: neighbours are alike in their high
/// bytes, and numbers that come from floats have zeros in the low ones. Word is as wide as a value.
template <class Word>
void to_planes(std::span<const std::byte> values, std::span<std::byte> planes) {
  const std::size_t n = values.size() / sizeof(Word);
  for (std::size_t i = 0; i < n; ++i) {
    Word word = 0;
    std::memcpy(&word, values.data() + i * sizeof word, sizeof word);
    for (std::size_t b = 0; b < sizeof word; ++b)
      planes[b * n + i] = static_cast<std::byte>(word >> (8 * b) & 0xffU);
  }
}

template <class Word>
void from_planes(std::span<const std::byte> planes, std::span<std::byte> values) {
  const std::size_t n = values.size() / sizeof(Word);
  for (std::size_t i = 0; i < n; ++i) {
    Word word = 0;
    for (std::size_t b = 0; b < sizeof word; ++b)
      word |= static_cast<Word>(std::to_integer<Word>(planes[b * n + i]) << (8 * b));
    std::memcpy(values.data() + i * sizeof word, &word, sizeof word);
  }
}

}  // namespace

void BlobWriter::raw(std::span<const std::byte> bytes) {
  bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void BlobWriter::number(std::uint64_t value) { raw(bytes_of(value)); }
void BlobWriter::integer(std::int64_t value) { raw(bytes_of(value)); }
void BlobWriter::real(double value) { raw(bytes_of(value)); }

void BlobWriter::text(std::string_view value) {
  number(value.size());
  bytes_ += value;
}

void BlobWriter::hash(const Hash128& value) {
  number(value.high);
  number(value.low);
}

void BlobWriter::reals(std::span<const double> values) {
  number(values.size());
  raw(std::as_bytes(values));
}

void BlobWriter::reals(std::span<const float> values) {
  number(values.size());
  raw(std::as_bytes(values));
}

void BlobWriter::planes(std::span<const double> values) {
  number(values.size());
  raw_planes(std::as_bytes(values), sizeof(double));
}

void BlobWriter::planes(std::span<const std::uint32_t> values) {
  number(values.size());
  raw_planes(std::as_bytes(values), sizeof(std::uint32_t));
}

void BlobWriter::raw_planes(std::span<const std::byte> values, std::size_t width) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + values.size());
  const auto planes = std::as_writable_bytes(std::span(bytes_).subspan(at));
  width == sizeof(std::uint64_t) ? to_planes<std::uint64_t>(values, planes)
                                 : to_planes<std::uint32_t>(values, planes);
}

void BlobWriter::flags(const std::vector<bool>& values) {
  number(values.size());
  std::vector<std::uint8_t> bits((values.size() + 7) / 8);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i]) bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | 1U << i % 8);
  raw(std::as_bytes(std::span(bits)));
}

void BlobWriter::texts(std::span<const std::string> values) {
  std::vector<std::uint64_t> ends;
  ends.reserve(values.size());
  std::uint64_t end = 0;
  for (const std::string& value : values) ends.push_back(end += value.size());
  column<std::uint64_t>(ends);
  bytes_.reserve(bytes_.size() + end);
  for (const std::string& value : values) bytes_ += value;
}

Hash128 BlobWriter::raw_hash() const { return hash_bytes(std::as_bytes(std::span(bytes_))); }

Result<std::vector<std::byte>> BlobWriter::finish(int level) {
  const auto values = std::as_bytes(std::span(bytes_));
  BlobHead head;
  head.raw_size = values.size();
  head.hash = hash_bytes(values);
  try {
    std::vector<std::byte> out(sizeof head + ZSTD_compressBound(values.size()));
    const std::size_t size = ZSTD_compress(out.data() + sizeof head, out.size() - sizeof head,
                                           values.data(), values.size(), level);
    if (ZSTD_isError(size) != 0U) return out_of_memory();  // it fails for nothing else
    if (size < values.size() && values.size() <= max_raw_size(size)) {
      head.packing = Packing::zstd;
      out.resize(sizeof head + size);
    } else {
      out.resize(sizeof head + values.size());
      std::ranges::copy(values, out.begin() + sizeof head);
    }
    std::memcpy(out.data(), &head, sizeof head);
    out.shrink_to_fit();
    return out;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

std::uint64_t BlobReader::raw_size(std::span<const std::byte> blob) {
  const auto head = head_of(blob);
  return head ? head->raw_size : 0;
}

Hash128 BlobReader::raw_hash(std::span<const std::byte> blob) {
  const auto head = head_of(blob);
  return head ? head->hash : Hash128();
}

Result<BlobReader> BlobReader::open(std::span<const std::byte> blob, std::string what) {
  BlobReader reader;
  reader.what_ = std::move(what);
  const auto found = head_of(blob);
  if (!found) {
    reader.refuse("it does not begin as it should");
    return reader.finish().error();
  }
  const BlobHead& head = *found;
  const std::span<const std::byte> packed = blob.subspan(sizeof head);
  try {
    if (head.packing == Packing::none) {
      reader.bytes_.assign(packed.begin(), packed.end());
    } else {
      reader.bytes_.resize(head.raw_size);
      const std::size_t size =
          ZSTD_decompress(reader.bytes_.data(), reader.bytes_.size(), packed.data(), packed.size());
      if (ZSTD_isError(size) != 0U || size != head.raw_size) reader.refuse("it does not unpack");
    }
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
  if (!reader.failed() && hash_bytes(reader.bytes_) != head.hash)
    reader.refuse("its bytes are not those that were stored");
  if (reader.failed()) return reader.finish().error();
  return reader;
}

void BlobReader::copy(std::span<std::byte> into) {
  if (into.size() > bytes_.size() - at_) refuse("it ends too early");
  if (failed()) {
    std::ranges::fill(into, std::byte{});
    return;
  }
  if (into.empty()) return;
  std::memcpy(into.data(), bytes_.data() + at_, into.size());
  at_ += into.size();
}

std::uint64_t BlobReader::number() {
  std::uint64_t value = 0;
  copy(std::as_writable_bytes(std::span(&value, 1)));
  return value;
}

std::int64_t BlobReader::integer() { return static_cast<std::int64_t>(number()); }
double BlobReader::real() { return std::bit_cast<double>(number()); }

std::size_t BlobReader::count(std::size_t size_of_each) {
  const std::uint64_t n = number();
  if (n > (bytes_.size() - at_) / size_of_each) refuse("it counts more than it holds");
  return failed() ? 0 : static_cast<std::size_t>(n);
}

std::string BlobReader::text() {
  std::string value(count(1), '\0');
  copy(std::as_writable_bytes(std::span(value)));
  return value;
}

Hash128 BlobReader::hash() {
  Hash128 value;
  value.high = number();
  value.low = number();
  return value;
}

void BlobReader::copy_planes(std::span<std::byte> into, std::size_t width) {
  // count() has seen to it that they are there.
  const std::span<const std::byte> planes = std::span(bytes_).subspan(at_, into.size());
  width == sizeof(std::uint64_t) ? from_planes<std::uint64_t>(planes, into)
                                 : from_planes<std::uint32_t>(planes, into);
  at_ += into.size();
}

std::span<const std::uint8_t> BlobReader::bytes() {
  const std::size_t n = count(1);
  const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes_.data()) + at_;
  at_ += n;
  return {first, n};
}

std::vector<bool> BlobReader::flags() {
  const std::uint64_t n = number();
  const std::size_t left = bytes_.size() - at_;
  if (n / 8 > left || (n + 7) / 8 > left) refuse("it counts more than it holds");
  if (failed()) return {};
  std::vector<bool> values(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = (std::to_integer<unsigned>(bytes_[at_ + i / 8]) >> i % 8 & 1U) != 0;
  at_ += (values.size() + 7) / 8;
  return values;
}

std::vector<std::string> BlobReader::texts() {
  const std::vector<std::uint64_t> ends = column<std::uint64_t>();
  const std::size_t left = bytes_.size() - at_;
  if (!std::ranges::is_sorted(ends) || (!ends.empty() && ends.back() > left))
    refuse("it counts more than it holds");
  if (failed()) return {};
  std::vector<std::string> values;
  values.reserve(ends.size());
  const auto* const all = reinterpret_cast<const char*>(bytes_.data()) + at_;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : ends) {
    values.emplace_back(all + begin, static_cast<std::size_t>(end - begin));
    begin = end;
  }
  at_ += static_cast<std::size_t>(begin);
  return values;
}

void BlobReader::refuse(std::string_view why) {
  if (fault_.empty()) fault_ = why;
}

Status BlobReader::finish() {
  if (at_ != bytes_.size()) refuse("it holds more than it should");
  if (!failed()) return {};
  return Error{ErrorCode::input, "is damaged: " + fault_, what_,
               "take a copy of the project, or make it anew of its model files"};
}

}  // namespace strake::project
