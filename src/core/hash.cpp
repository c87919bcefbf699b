// SPDX-License-Identifier: Apache-2.0
#include "strake/core/hash.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace strake {

struct Hasher::State {
  XXH3_state_t xxh;    // holds its own alignment, which operator new obeys
  bool begun = false;  ///< whether anything went into it: most hashes are of less than waits here
  /// What has been added last: XXH3 takes long runs several times faster than single numbers.
  std::array<std::byte, 1024> waiting;
  std::size_t size = 0;

  State() {}  // NOLINT(modernize-use-equals-default): that would fill a kilobyte with zeros

  void add(std::span<const std::byte> bytes) {
    if (bytes.size() > waiting.size() - size) {
      if (!begun) XXH3_128bits_reset(&xxh);
      begun = true;
      XXH3_128bits_update(&xxh, waiting.data(), size);
      size = 0;
    }
    if (bytes.size() > waiting.size()) {
      XXH3_128bits_update(&xxh, bytes.data(), bytes.size());
    } else {
      std::ranges::copy(bytes, waiting.begin() + static_cast<std::ptrdiff_t>(size));
      size += bytes.size();
    }
  }
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

Hasher& Hasher::add(std::uint64_t value) {
  std::array<std::byte, 8> bytes{};
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(value & 0xffU);
    value >>= 8U;
  }
  state_->add(bytes);
  return *this;
}

Hasher& Hasher::add(double value) {
  constexpr std::uint64_t kNan = 0x7ff8000000000000ULL;
  return add(std::isnan(value) ? kNan : std::bit_cast<std::uint64_t>(value + 0.0));
}

Hasher& Hasher::add(std::string_view text) { return add(std::as_bytes(std::span(text))); }

Hasher& Hasher::add(std::span<const std::byte> bytes) {
  add(std::uint64_t{bytes.size()});
  state_->add(bytes);
  return *this;
}

Hash128 Hasher::value() const {
  if (!state_->begun) return hash_bytes(std::span(state_->waiting).first(state_->size));
  State all = *state_;
  XXH3_128bits_update(&all.xxh, all.waiting.data(), all.size);
  const XXH128_hash_t hash = XXH3_128bits_digest(&all.xxh);
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
