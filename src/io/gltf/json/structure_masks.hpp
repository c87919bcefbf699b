// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "io/gltf/json/quote_state.hpp"

namespace strake::io::gltf {

/// Which of 64 bytes of a JSON text are structure: bit i stands for byte i.
struct StructureMasks {
  std::uint64_t opens = 0;   ///< [ and {
  std::uint64_t closes = 0;  ///< ] and }
  std::uint64_t commas = 0;

  [[nodiscard]] int depth_change() const { return std::popcount(opens) - std::popcount(closes); }
};

namespace detail {

struct ByteMasks {
  std::uint64_t quotes = 0, backslashes = 0;
  StructureMasks structure;
};

/// Classifies 64 bytes wherever they are, in strings or not.
inline ByteMasks byte_masks(const char* bytes) {
  ByteMasks masks;
#if defined(__SSE2__)
  for (unsigned at = 0; at < 64; at += 16) {
    const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + at));
    // [ and { differ in this bit alone, as do ] and }.
    const __m128i curly = _mm_or_si128(b, _mm_set1_epi8(0x20));
    const auto equal = [at](__m128i x, char c) {
      const auto bits =
          static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(x, _mm_set1_epi8(c))));
      return std::uint64_t{bits} << at;
    };
    masks.quotes |= equal(b, '"');
    masks.backslashes |= equal(b, '\\');
    masks.structure.opens |= equal(curly, '{');
    masks.structure.closes |= equal(curly, '}');
    masks.structure.commas |= equal(b, ',');
  }
#else
  for (unsigned at = 0; at < 64; ++at) {
    const char c = bytes[at];
    const std::uint64_t bit = std::uint64_t{1} << at;
    if (c == '"') masks.quotes |= bit;
    if (c == '\\') masks.backslashes |= bit;
    if (c == '[' || c == '{') masks.structure.opens |= bit;
    if (c == ']' || c == '}') masks.structure.closes |= bit;
    if (c == ',') masks.structure.commas |= bit;
  }
#endif
  return masks;
}

/// Returns the bits that lie in strings, a string's opening quote among them, and moves the state
/// behind the bytes.
inline std::uint64_t string_bits(const char* bytes, const ByteMasks& masks, QuoteState& state) {
  std::uint64_t inside = 0;
  if (masks.backslashes != 0 || state.escaped) {
    for (unsigned at = 0; at < 64; ++at) {
      state.pass(bytes[at]);
      inside |= std::uint64_t{state.in_string} << at;
    }
    return inside;
  }
  // Each bit becomes the parity of the quotes up to it.
  inside = masks.quotes;
  for (unsigned shift = 1; shift < 64; shift *= 2) inside ^= inside << shift;
  if (state.in_string) inside = ~inside;
  state.in_string = (inside >> 63U) != 0;
  return inside;
}

}  // namespace detail

/// Calls visit(offset, masks) for each 64 bytes of a block of text that begins in `state`; what is
/// in strings is no structure. The last bytes are filled up with blanks.
template <class Visit>
void scan_structure(std::string_view block, QuoteState state, Visit&& visit) {
  const auto scan = [&](std::size_t offset, const char* bytes) {
    const detail::ByteMasks masks = detail::byte_masks(bytes);
    const std::uint64_t outside = ~detail::string_bits(bytes, masks, state);
    visit(offset, StructureMasks{masks.structure.opens & outside, masks.structure.closes & outside,
                                 masks.structure.commas & outside});
  };
  std::size_t at = 0;
  for (; at + 64 <= block.size(); at += 64) scan(at, block.data() + at);
  if (at == block.size()) return;
  char rest[64];
  std::memset(rest, ' ', sizeof rest);
  std::memcpy(rest, block.data() + at, block.size() - at);
  scan(at, rest);
}

}  // namespace strake::io::gltf
