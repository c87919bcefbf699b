// SPDX-License-Identifier: Apache-2.0
#include "report/text/uuid.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace strake::report {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdefABCDEF";
constexpr std::size_t kBlockBytes = 64, kUuidBytes = 16;

using ShaState = std::array<std::uint32_t, 5>;

std::uint32_t byte_of(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// Mixes a block of 64 bytes into the state (FIPS 180-4, 6.1.2).
void mix_block(ShaState& state, std::string_view block) {
  std::array<std::uint32_t, 80> words{};
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 4; ++k) words[t] = (words[t] << 8U) | byte_of(block, 4 * t + k);
  for (std::size_t t = 16; t < words.size(); ++t)
    words[t] = std::rotl(words[t - 3] ^ words[t - 8] ^ words[t - 14] ^ words[t - 16], 1);
  auto [a, b, c, d, e] = state;
  for (std::size_t t = 0; t < words.size(); ++t) {
    std::uint32_t f = 0, constant = 0;
    if (t < 20) {
      f = (b & c) | (~b & d);
      constant = 0x5A827999U;
    } else if (t < 40) {
      f = b ^ c ^ d;
      constant = 0x6ED9EBA1U;
    } else if (t < 60) {
      f = (b & c) | (b & d) | (c & d);
      constant = 0x8F1BBCDCU;
    } else {
      f = b ^ c ^ d;
      constant = 0xCA62C1D6U;
    }
    const std::uint32_t next = std::rotl(a, 5) + f + e + constant + words[t];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d, state[4] + e};
}

/// SHA-1 names things here; it guards nothing.
ShaState sha1(std::string text) {
  const std::uint64_t bits = std::uint64_t{text.size()} * 8;
  text += '\x80';
  while (text.size() % kBlockBytes != kBlockBytes - 8) text += '\0';
  for (unsigned shift = 64; shift > 0; shift -= 8)
    text += static_cast<char>((bits >> (shift - 8)) & 0xFFU);
  ShaState state{0x67452301U, 0xEFCDAB89U, 0x98BADCFEU, 0x10325476U, 0xC3D2E1F0U};
  for (std::size_t at = 0; at < text.size(); at += kBlockBytes)
    mix_block(state, std::string_view(text).substr(at, kBlockBytes));
  return state;
}

/// Returns the bytes that the digits of a UUID stand for.
std::string uuid_bytes(std::string_view uuid) {
  std::string bytes;
  std::uint32_t value = 0;
  bool half = false;
  for (const char c : uuid) {
    const std::size_t digit = kHexDigits.find(c);
    if (digit == std::string_view::npos) continue;
    const auto four_bits = static_cast<std::uint32_t>(digit < 16 ? digit : digit - 6);
    value = (value << 4U) | four_bits;
    if (half) bytes += static_cast<char>(value & 0xFFU);
    half = !half;
  }
  return bytes;
}

}  // namespace

std::string uuid_from_key(std::string_view name_space, std::string_view key) {
  const ShaState hash = sha1(uuid_bytes(name_space).append(key));
  std::string uuid;
  for (std::size_t i = 0; i < kUuidBytes; ++i) {
    std::uint32_t byte = (hash[i / 4] >> (24 - 8 * (i % 4))) & 0xFFU;
    if (i == 6) byte = (byte & 0x0FU) | 0x50U;
    if (i == 8) byte = (byte & 0x3FU) | 0x80U;
    if (i == 4 || i == 6 || i == 8 || i == 10) uuid += '-';
    uuid += kHexDigits[byte >> 4U];
    uuid += kHexDigits[byte & 0x0FU];
  }
  return uuid;
}

}  // namespace strake::report
