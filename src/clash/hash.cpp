// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "clash/reduce.hpp"

namespace strake::clash {
namespace {

/// Feeds values as little-endian bytes, so that the hash is the same on every machine.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState()) { XXH3_128bits_reset(state_.get()); }

  void add(std::uint64_t value) {
    std::array<unsigned char, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<unsigned char>(value >> (8 * i));
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }
  /// Both zeros are one number.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    XXH3_128bits_update(state_.get(), text.data(), text.size());
  }

  [[nodiscard]] std::string hex() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    std::string text;
    for (const unsigned char byte : canonical.digest) {
      text += kDigits[byte >> 4U];
      text += kDigits[byte & 15U];
    }
    return text;
  }

 private:
  static constexpr std::string_view kDigits = "0123456789abcdef";
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

}  // namespace

std::string hash_of(const std::vector<Pair>& pairs, const model::Model& model) {
  Hasher hasher;
  const auto add_object = [&](model::ObjectId id) {
    const model::Object& object = model.object(id);
    hasher.add(std::string_view(model.files[object.file].label));
    hasher.add(std::string_view(object.id));
  };
  for (const Pair& pair : pairs) {
    add_object(pair.a);
    add_object(pair.b);
    hasher.add(std::uint64_t{static_cast<std::uint8_t>(pair.cls)});
    hasher.add(std::uint64_t{static_cast<std::uint8_t>(pair.relation)});
    hasher.add(pair.d_mm);
    for (int k = 0; k < 3; ++k) hasher.add(pair.point_mm[k]);
  }
  return hasher.hex();
}

}  // namespace strake::clash
