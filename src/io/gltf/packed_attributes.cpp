// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/packed_attributes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>

namespace strake::io::gltf {
namespace {

constexpr std::byte kVersion1{0xa1};
constexpr std::size_t kWidestElement = 256;  // bytes of an element
constexpr std::size_t kByteGroup = 16;       // bytes whose widths are said together
constexpr std::size_t kChannelBytes = 4;     // bytes of an element that are predicted alike

/// Elements of a block: as many as 8192 bytes hold, in whole groups, and 256 at most.
std::size_t block_elements(std::size_t stride) {
  constexpr std::size_t kBytes = 8192, kMax = 256;
  return std::min(kBytes / stride / kByteGroup * kByteGroup, kMax);
}

/// Takes bytes off the front; once there are too few, it is done for and gives zeros.
class PackedBytes {
 public:
  explicit PackedBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  std::span<const std::byte> take(std::size_t count) {
    if (count > bytes_.size()) {
      failed_ = true;
      return {};
    }
    const std::span<const std::byte> taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  unsigned one() {
    const std::span<const std::byte> taken = take(1);
    return taken.empty() ? 0U : std::to_integer<unsigned>(taken[0]);
  }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

/// Unpacks a group whose bytes take `bits` each; the greatest number stands for a whole byte that
/// comes behind the group. Single bits begin at the lowest of a byte, all others at the highest.
void unpack_group(PackedBytes& source, unsigned bits, std::span<std::uint8_t, kByteGroup> out) {
  std::ranges::fill(out, std::uint8_t{0});
  if (bits == 0) return;
  const std::span<const std::byte> packed = source.take(kByteGroup * bits / 8);
  if (packed.empty()) return;
  const unsigned escape = (1U << bits) - 1, each = 8 / bits;
  for (std::size_t i = 0; i < kByteGroup; ++i) {
    const auto byte = std::to_integer<unsigned>(packed[i / each]);
    const auto k = static_cast<unsigned>(i % each);
    const unsigned value = byte >> (bits == 1 ? k : 8 - bits * (k + 1)) & escape;
    const bool whole = bits < 8 && value == escape;
    out[i] = static_cast<std::uint8_t>(whole ? source.one() : value);
  }
}

using ByteLane = std::array<std::uint8_t, 256>;  // one byte of each element of a block

/// Unpacks one byte of each element; `control` says how.
void unpack_lane(PackedBytes& source, unsigned control, std::size_t count, ByteLane& lane) {
  constexpr unsigned kZeros = 2, kPlain = 3;
  constexpr std::array<unsigned, 5> kBits{0, 1, 2, 4, 8};  // four of them from `control` on
  lane.fill(0);
  if (control == kZeros) return;
  if (control == kPlain) {
    const std::span<const std::byte> plain = source.take(count);
    if (!plain.empty()) std::memcpy(lane.data(), plain.data(), count);
    return;
  }
  const std::size_t groups = (count + kByteGroup - 1) / kByteGroup;
  const std::span<const std::byte> widths = source.take((groups + 3) / 4);
  for (std::size_t g = 0; g < groups && !source.failed(); ++g) {
    const unsigned width =
        std::to_integer<unsigned>(widths[g / 4]) >> static_cast<unsigned>(2 * (g % 4)) & 3U;
    unpack_group(source, kBits[control + width],
                 std::span(lane).subspan(g * kByteGroup).first<kByteGroup>());
  }
}

/// Turns what the lanes say of each element into numbers of this type, each told by the one before,
/// which `last` is for the first of a block, and then the last.
template <std::unsigned_integral Number, class Decode>
void add_up(const std::array<ByteLane, kChannelBytes>& lanes, std::size_t count, std::size_t stride,
            std::byte* last, std::byte* out, Decode&& decode) {
  for (std::size_t byte = 0; byte < kChannelBytes; byte += sizeof(Number)) {
    Number before{};
    std::memcpy(&before, last + byte, sizeof before);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t stored = 0;
      for (std::size_t k = 0; k < sizeof(Number); ++k)
        stored |= std::uint32_t{lanes[byte + k][i]} << static_cast<unsigned>(8 * k);
      before = decode(static_cast<Number>(stored), before);
      std::memcpy(out + i * stride + byte, &before, sizeof before);
    }
    std::memcpy(last + byte, &before, sizeof before);
  }
}

/// Differences are told with their sign in the lowest bit.
template <std::unsigned_integral Number>
Number with_difference(Number stored, Number before) {
  const auto half = static_cast<Number>(stored >> 1U);
  return static_cast<Number>(before + ((stored & 1U) != 0 ? static_cast<Number>(~half) : half));
}

/// Puts four bytes of each element of a block in their places. False for a kind that there is not.
bool put_channel(unsigned kind, const std::array<ByteLane, kChannelBytes>& lanes, std::size_t count,
                 std::size_t stride, std::byte* last, std::byte* out) {
  static_assert(std::endian::native == std::endian::little, "numbers are put as they lie");
  switch (kind & 3U) {
    case 0:
      add_up<std::uint8_t>(lanes, count, stride, last, out, with_difference<std::uint8_t>);
      return true;
    case 1:
      add_up<std::uint16_t>(lanes, count, stride, last, out, with_difference<std::uint16_t>);
      return true;
    case 2:
      add_up<std::uint32_t>(
          lanes, count, stride, last, out,
          [turn = static_cast<int>(kind >> 4U)](std::uint32_t stored, std::uint32_t before) {
            return std::rotr(stored, turn) ^ before;
          });
      return true;
    default:
      return false;
  }
}

}  // namespace

bool is_attributes_version_1(std::span<const std::byte> packed) {
  return !packed.empty() && packed[0] == kVersion1;
}

bool unpack_attributes_version_1(std::span<const std::byte> packed, std::size_t stride,
                                 std::span<std::byte> out) {
  constexpr std::size_t kMinTail = 24;
  const std::size_t channels = stride / kChannelBytes, tail = stride + channels;
  if (!is_attributes_version_1(packed) || packed.size() < 1 + std::max(tail, kMinTail))
    return false;
  // Behind the blocks, at the very end: the element before the first one, and kinds of channels.
  std::array<std::byte, kWidestElement> last{};
  std::memcpy(last.data(), packed.data() + packed.size() - tail, stride);
  const std::span<const std::byte> kinds = packed.last(channels);
  PackedBytes source(packed.subspan(1, packed.size() - 1 - std::max(tail, kMinTail)));
  const std::size_t elements = out.size() / stride, largest = block_elements(stride);
  std::array<ByteLane, kChannelBytes> lanes{};
  for (std::size_t first = 0; first < elements; first += largest) {
    const std::size_t count = std::min(largest, elements - first);
    const std::span<const std::byte> controls = source.take(channels);
    for (std::size_t c = 0; c < channels && !source.failed(); ++c) {
      const auto control = std::to_integer<unsigned>(controls[c]);
      for (std::size_t k = 0; k < kChannelBytes; ++k)
        unpack_lane(source, control >> static_cast<unsigned>(2 * k) & 3U, count, lanes[k]);
      if (!put_channel(std::to_integer<unsigned>(kinds[c]), lanes, count, stride,
                       last.data() + c * kChannelBytes,
                       out.data() + first * stride + c * kChannelBytes))
        return false;
    }
    if (source.failed()) return false;
  }
  return source.left() == 0;
}

}  // namespace strake::io::gltf
