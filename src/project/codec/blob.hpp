// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"

/// Values in a row of the database: a head with version, size and hash, then columns, compressed by
/// zstd. Numbers are little-endian.
namespace strake::project {

/// Appends values.
class BlobWriter {
 public:
  void number(std::uint64_t value);
  void integer(std::int64_t value);
  void real(double value);
  void text(std::string_view value);
  void hash(const Hash128& value);
  /// Appends the count and the values; T is an arithmetic type, or a struct of such without
  /// padding.
  template <class T>
  void column(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>);
    number(values.size());
    raw(std::as_bytes(values));
  }
  void reals(std::span<const double> values);
  void reals(std::span<const float> values);
  /// Appends numbers that are much alike, so that they compress well: BlobReader::planes() has
  /// them.
  void planes(std::span<const double> values);
  void planes(std::span<const std::uint32_t> values);
  void flags(const std::vector<bool>& values);
  void texts(std::span<const std::string> values);
  /// Appends what text() does of texts(0), texts(1), … of so many put together.
  template <class Texts>
  void joined_text(std::size_t count, const Texts& texts) {
    std::uint64_t size = 0;
    for (std::size_t i = 0; i < count; ++i) size += std::string_view(texts(i)).size();
    number(size);
    bytes_.reserve(bytes_.size() + size);
    for (std::size_t i = 0; i < count; ++i) bytes_ += std::string_view(texts(i));
  }

  /// Returns the hash of what has been appended, as BlobReader::raw_hash() has it of finish().
  [[nodiscard]] Hash128 raw_hash() const;

  /// Returns the head and the compressed bytes; `level` is that of zstd. Errors: memory.
  [[nodiscard]] Result<std::vector<std::byte>> finish(int level = 1);

 private:
  void raw(std::span<const std::byte> bytes);
  void raw_planes(std::span<const std::byte> values, std::size_t width);
  std::string bytes_;
};

/// Takes values in the order in which they were written. After a fault every read gives an empty
/// value, and status() tells the first one; counts never make it reserve more than the bytes that
/// are there.
class BlobReader {
 public:
  /// `what` names the row for errors, as "the objects of a.rvm".
  [[nodiscard]] static Result<BlobReader> open(std::span<const std::byte> blob, std::string what);
  /// Returns how many bytes open() would unpack, so that room is made for no more than they can
  /// fill; 0 where the blob is none.
  [[nodiscard]] static std::uint64_t raw_size(std::span<const std::byte> blob);
  /// Returns the hash of what open() would unpack; zeros where the blob is none.
  [[nodiscard]] static Hash128 raw_hash(std::span<const std::byte> blob);
  [[nodiscard]] std::uint64_t number();
  [[nodiscard]] std::int64_t integer();
  [[nodiscard]] double real();
  [[nodiscard]] std::string text();
  [[nodiscard]] Hash128 hash();
  /// Returns values copied out of the bytes.
  template <class T>
  [[nodiscard]] std::vector<T> column() {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t n = count(sizeof(T));
    std::vector<T> values(n);
    copy(std::as_writable_bytes(std::span(values)));
    return values;
  }
  template <class T>
  [[nodiscard]] std::vector<T> planes() {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::uint32_t>);
    std::vector<T> values(count(sizeof(T)));
    copy_planes(std::as_writable_bytes(std::span(values)), sizeof(T));
    return values;
  }
  /// Returns a column of bytes where it lies, for as long as the reader does.
  [[nodiscard]] std::span<const std::uint8_t> bytes();
  [[nodiscard]] std::vector<bool> flags();
  [[nodiscard]] std::vector<std::string> texts();
  /// Reports a value that cannot be, found by who knows its meaning.
  void refuse(std::string_view why);
  /// An error of input where a value was missing or refused, or where bytes are left over.
  [[nodiscard]] Status finish();
  [[nodiscard]] bool failed() const { return !fault_.empty(); }

 private:
  [[nodiscard]] std::size_t count(std::size_t size_of_each);
  void copy(std::span<std::byte> into);
  void copy_planes(std::span<std::byte> into, std::size_t width);
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
  std::string what_, fault_;
};

}  // namespace strake::project
