// SPDX-License-Identifier: Apache-2.0
#include "core/seeded_hash.hpp"

#include <random>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace strake {

namespace {

std::uint64_t new_seed() {
  std::random_device device;
  return std::uint64_t{device()} << 32U | device();
}

}  // namespace

SeededHash::SeededHash() : seed_(new_seed()) {}

std::size_t SeededHash::of(std::span<const std::byte> bytes) const {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed_);
}

}  // namespace strake
