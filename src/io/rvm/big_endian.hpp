// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace strake::io::rvm {

using Bytes = std::span<const std::byte>;

[[nodiscard]] inline std::uint32_t load_u32(const std::byte* p) {
  return std::to_integer<std::uint32_t>(p[0]) << 24 | std::to_integer<std::uint32_t>(p[1]) << 16 |
         std::to_integer<std::uint32_t>(p[2]) << 8 | std::to_integer<std::uint32_t>(p[3]);
}

/// Reads big-endian values from a span and never past its end: a read that does not fit gives zero
/// and leaves the cursor failed, so that a body is read first and checked once.
class BigEndianCursor {
 public:
  explicit BigEndianCursor(Bytes bytes, std::size_t at = 0) : bytes_(bytes), at_(at) {
    if (at_ > bytes_.size()) fail();
  }

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  void fail() {
    failed_ = true;
    at_ = bytes_.size();
  }

  [[nodiscard]] Bytes take(std::size_t count) {
    if (failed_ || count > left()) {
      fail();
      return {};
    }
    const Bytes taken = bytes_.subspan(at_, count);
    at_ += count;
    return taken;
  }
  void skip(std::size_t count) { static_cast<void>(take(count)); }
  [[nodiscard]] std::uint32_t u32() {
    const Bytes b = take(4);
    return b.empty() ? 0 : load_u32(b.data());
  }
  [[nodiscard]] float f32() { return std::bit_cast<float>(u32()); }
  [[nodiscard]] std::uint8_t u8() {
    const Bytes b = take(1);
    return b.empty() ? std::uint8_t{0} : std::to_integer<std::uint8_t>(b[0]);
  }
  /// Reads the raw bytes of a counted string up to its first NUL.
  [[nodiscard]] Bytes string() {
    const std::size_t words = u32();
    const Bytes padded = take(words * 4);
    std::size_t length = 0;
    while (length < padded.size() && padded[length] != std::byte{0}) ++length;
    return padded.first(length);
  }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace strake::io::rvm
