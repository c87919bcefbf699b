// SPDX-License-Identifier: Apache-2.0
#include "core/checksum.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace strake {

struct Checksum::State {
  XXH3_state_t xxh;  // holds its own alignment, which operator new obeys
};

Checksum::Checksum() : state_(std::make_unique<State>()) { XXH3_128bits_reset(&state_->xxh); }
Checksum::~Checksum() = default;

void Checksum::add(std::string_view bytes) {
  XXH3_128bits_update(&state_->xxh, bytes.data(), bytes.size());
}

Hash128 Checksum::value() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh);
  return {hash.high64, hash.low64};
}

}  // namespace strake
