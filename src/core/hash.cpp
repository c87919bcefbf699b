// SPDX-License-Identifier: Apache-2.0
#include "strake/core/hash.hpp"

#include <array>
#include <bit>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace strake {

struct Hasher::State {
  XXH3_state_t xxh;  // holds its own alignment, which operator new obeys
};

Hasher::Hasher() : state_(std::make_unique<State>()) { XXH3_128bits_reset(&state_->xxh); }
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::add_raw(const void* bytes, std::size_t size) {
  XXH3_128bits_update(&state_->xxh, bytes, size);
}

Hasher& Hasher::add(std::uint64_t value) {
  std::array<unsigned char, 8> bytes{};
  for (unsigned char& byte : bytes) {
    byte = static_cast<unsigned char>(value & 0xffU);
    value >>= 8U;
  }
  add_raw(bytes.data(), bytes.size());
  return *this;
}

Hasher& Hasher::add(double value) {
  constexpr std::uint64_t kNan = 0x7ff8000000000000ULL;
  return add(std::isnan(value) ? kNan : std::bit_cast<std::uint64_t>(value + 0.0));
}

Hasher& Hasher::add(std::string_view text) { return add(std::as_bytes(std::span(text))); }

Hasher& Hasher::add(std::span<const std::byte> bytes) {
  add(std::uint64_t{bytes.size()});
  add_raw(bytes.data(), bytes.size());
  return *this;
}

Hash128 Hasher::value() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh);
  return {hash.high64, hash.low64};
}

std::string Hash128::text() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const std::uint64_t word : {high, low})
    for (unsigned shift = 64; shift > 0; shift -= 4) out += kDigits[(word >> (shift - 4)) & 0xfU];
  return out;
}

Hash128 hash_bytes(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

}  // namespace strake
