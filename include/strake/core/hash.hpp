// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
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

}  // namespace strake
