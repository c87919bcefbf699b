// SPDX-License-Identifier: Apache-2.0
#include "clash/results/clash_key.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>

#include "core/text_encoding.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {
namespace {

constexpr std::string_view kDigits = "0123456789abcdefghjkmnpqrstvwxyz";
constexpr int kLength = 26, kBits = 5;
constexpr std::uint8_t kNoDigit = 255;

constexpr std::array<std::uint8_t, 256> kValues = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
  return values;
}();

ElementName element(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  return {model.files[object.file].label, object.id};
}

/// Returns the hash that Hasher has of texts, without memory from the heap where they are as short
/// as names are.
Hash128 hash_of_texts(std::initializer_list<std::string_view> texts) {
  std::array<std::byte, 512> bytes{};
  std::size_t size = 0;
  for (const std::string_view text : texts) size += sizeof(std::uint64_t) + text.size();
  if (size > bytes.size()) {
    Hasher hasher;
    for (const std::string_view text : texts) hasher.add(text);
    return hasher.value();
  }
  auto* end = bytes.data();
  for (const std::string_view text : texts) {
    for (unsigned shift = 0; shift < 64; shift += 8)
      *end++ = static_cast<std::byte>(std::uint64_t{text.size()} >> shift & 0xffU);
    end = std::ranges::copy(std::as_bytes(std::span(text)), end).out;
  }
  return hash_bytes(std::span(bytes).first(size));
}

}  // namespace

std::string key_text(Hash128 hash) {
  std::string text(kLength, '0');
  for (int i = kLength; i-- > 0;) {
    text[static_cast<std::size_t>(i)] = kDigits[hash.low & 31U];
    hash.low = (hash.low >> kBits) | (hash.high << (64 - kBits));
    hash.high >>= kBits;
  }
  return text;
}

std::optional<Hash128> parse_key(std::string_view text) {
  // 26 digits are two bits more than a hash has.
  if (text.size() != kLength || text.front() > '7') return std::nullopt;
  Hash128 hash;
  for (const char c : text) {
    const std::uint8_t digit = kValues[static_cast<unsigned char>(c)];
    if (digit == kNoDigit) return std::nullopt;
    hash.high = (hash.high << kBits) | (hash.low >> (64 - kBits));
    hash.low = (hash.low << kBits) | digit;
  }
  return hash;
}

std::uint64_t element_hash(std::string_view file_label, std::string_view id) {
  std::array<std::string, 2> rooms;
  return hash_of_texts({valid_utf8(file_label, rooms[0]), valid_utf8(id, rooms[1])}).low;
}

std::uint64_t element_hash(const model::Model& model, model::ObjectId id) {
  const ElementName e = element(model, id);
  return element_hash(e.file_label, e.id);
}

Hash128 pair_hash(std::string_view test, const ElementName& a, const ElementName& b) {
  std::array<std::string, 5> rooms;
  // They are ordered as shown, so that a reader of a file gets the same key.
  std::pair first(valid_utf8(a.file_label, rooms[0]), valid_utf8(a.id, rooms[1])),
      second(valid_utf8(b.file_label, rooms[2]), valid_utf8(b.id, rooms[3]));
  if (second < first) std::swap(first, second);
  return hash_of_texts(
      {valid_utf8(test, rooms[4]), first.first, first.second, second.first, second.second});
}

Hash128 pair_hash(std::string_view test, const model::Model& model, model::ObjectId a,
                  model::ObjectId b) {
  return pair_hash(test, element(model, a), element(model, b));
}

std::string pair_key(std::string_view test, const model::Model& model, model::ObjectId a,
                     model::ObjectId b) {
  return key_text(pair_hash(test, model, a, b));
}

}  // namespace strake::clash
