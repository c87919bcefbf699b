// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/identity.hpp"

#include <tuple>
#include <utility>

#include "strake/core/hash.hpp"

namespace strake::clash {
namespace {

using Element = std::pair<std::string_view, std::string_view>;

Element element(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  return {model.files[object.file].label, object.id};
}

}  // namespace

std::string key_text(std::uint64_t high, std::uint64_t low) {
  constexpr std::string_view kDigits = "0123456789abcdefghjkmnpqrstvwxyz";
  constexpr int kLength = 26, kBits = 5;
  std::string text(kLength, '0');
  for (int i = kLength; i-- > 0;) {
    text[static_cast<std::size_t>(i)] = kDigits[low & 31U];
    low = (low >> kBits) | (high << (64 - kBits));
    high >>= kBits;
  }
  return text;
}

std::uint64_t element_hash(std::string_view file_label, std::string_view id) {
  return Hasher().add(file_label).add(id).value().low;
}

std::uint64_t element_hash(const model::Model& model, model::ObjectId id) {
  const Element e = element(model, id);
  return element_hash(e.first, e.second);
}

std::string pair_key(std::string_view test, const model::Model& model, model::ObjectId a,
                     model::ObjectId b) {
  Element first = element(model, a), second = element(model, b);
  if (second < first) std::swap(first, second);
  Hasher hasher;
  hasher.add(test);
  for (const Element& e : {first, second}) hasher.add(e.first).add(e.second);
  const Hash128 hash = hasher.value();
  return key_text(hash.high, hash.low);
}

}  // namespace strake::clash
