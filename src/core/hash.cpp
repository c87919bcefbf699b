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
  /// What has been added last: XXH3 takes long runs several times faster than single numbers.
  std::array<std::byte, 1024> waiting;
  std::size_t size = 0;
  /// What came before it. Most sequences are short and never need it: it is large, and aligned so
  /// that an allocation of it costs more than hashing two names.
  std::unique_ptr<XXH3_state_t> before;

  void add(std::span<const std::byte> bytes) {
    if (bytes.size() > waiting.size() - size) {
      take(std::span(waiting).first(size));
      size = 0;
    }
    if (bytes.size() > waiting.size()) {
      take(bytes);
    } else {
      std::ranges::copy(bytes, waiting.begin() + static_cast<std::ptrdiff_t>(size));
      size += bytes.size();
    }
  }

 private:
  void take(std::span<const std::byte> bytes) {
    if (before == nullptr) {
      before = std::make_unique<XXH3_state_t>();
      XXH3_128bits_reset(before.get());
    }
    XXH3_128bits_update(before.get(), bytes.data(), bytes.size());
  }
};

Hasher::Hasher() : state_(std::make_unique_for_overwrite<State>()) {}
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
  const auto waiting = std::span(state_->waiting).first(state_->size);
  if (state_->before == nullptr) return hash_bytes(waiting);
  XXH3_state_t all = *state_->before;
  XXH3_128bits_update(&all, waiting.data(), waiting.size());
  const XXH128_hash_t hash = XXH3_128bits_digest(&all);
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
