// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace strake {

/// 128 bits that stay the same on every machine and in every version of the program.
struct Hash128 {
  std::uint64_t high = 0, low = 0;

  /// Returns 32 lower-case hexadecimal digits.
  [[nodiscard]] std::string text() const;
  friend auto operator<=>(const Hash128&, const Hash128&) = default;
};

/// A stable 128-bit hash of a sequence of values (XXH3; not cryptographic).
///
/// The sequence counts, not only the bytes: strings carry their length, so that "ab","c" and
/// "a","bc" differ. Numbers are hashed as little-endian 64-bit words whatever the machine; doubles
/// by their bits, with one zero and one NaN.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  Hasher& add(std::uint64_t value);
  Hasher& add(std::int64_t value) { return add(static_cast<std::uint64_t>(value)); }
  Hasher& add(std::uint32_t value) { return add(static_cast<std::uint64_t>(value)); }
  Hasher& add(std::int32_t value) { return add(static_cast<std::int64_t>(value)); }
  Hasher& add(double value);
  Hasher& add(std::string_view text);
  Hasher& add(std::span<const std::byte> bytes);

  [[nodiscard]] Hash128 value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the hash of one run of bytes.
[[nodiscard]] Hash128 hash_bytes(std::span<const std::byte> bytes);

/// A stable 128-bit hash of some words, in a few tens of nanoseconds and without memory of its own:
/// for a hash of each of very many things. The sequence of words counts; doubles go by their bits,
/// with one zero and one NaN. It is not that of Hasher.
class WordHash {
 public:
  template <std::integral Word>
  WordHash& add(Word word) {
    if (size_ == kRoom) fold();
    words_[size_++] = little(static_cast<std::uint64_t>(word));
    ++count_;
    return *this;
  }
  WordHash& add(const Hash128& hash) { return add(hash.high).add(hash.low); }
  WordHash& add(double value) {
    constexpr std::uint64_t kNan = 0x7ff8000000000000ULL;
    return add(std::isnan(value) ? kNan : std::bit_cast<std::uint64_t>(value + 0.0));
  }
  WordHash& add(std::string_view text) { return add(hash_bytes(std::as_bytes(std::span(text)))); }

  /// Returns the hash of the words so far; more may follow.
  [[nodiscard]] Hash128 value() {
    words_[0] = little(count_);
    return hash_bytes(std::as_bytes(std::span(words_.data(), size_)));
  }

 private:
  static constexpr std::size_t kRoom = 64;

  static std::uint64_t little(std::uint64_t word) {
    if constexpr (std::endian::native == std::endian::little) return word;
    std::uint64_t turned = 0;
    for (int byte = 0; byte < 8; ++byte, word >>= 8U) turned = (turned << 8U) | (word & 0xffU);
    return turned;
  }
  void fold() {
    const Hash128 all = value();
    words_[1] = little(all.high);
    words_[2] = little(all.low);
    size_ = 3;
  }

  // Zeros would take as long as all the rest.
  std::array<std::uint64_t, kRoom> words_;  ///< their number, then the words
  std::size_t size_ = 1;
  std::uint64_t count_ = 0;
};

}  // namespace strake
