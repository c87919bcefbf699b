// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/identity.hpp"

#include <tuple>

#include "strake/core/hash.hpp"
#include "strake/core/text.hpp"

namespace strake::clash {
namespace {

ElementName element(const model::Model& model, model::ObjectId id) {
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
  return Hasher()
      .add(std::string_view(valid_utf8(file_label)))
      .add(std::string_view(valid_utf8(id)))
      .value()
      .low;
}

std::uint64_t element_hash(const model::Model& model, model::ObjectId id) {
  const ElementName e = element(model, id);
  return element_hash(e.file_label, e.id);
}

std::string pair_key(std::string_view test, const ElementName& a, const ElementName& b) {
  const bool ordered = std::tie(a.file_label, a.id) <= std::tie(b.file_label, b.id);
  Hasher hasher;
  hasher.add(test);
  for (const ElementName& e : {ordered ? a : b, ordered ? b : a})
    for (const std::string_view text : {e.file_label, e.id})
      hasher.add(std::string_view(valid_utf8(text)));
  const Hash128 hash = hasher.value();
  return key_text(hash.high, hash.low);
}

std::string pair_key(std::string_view test, const model::Model& model, model::ObjectId a,
                     model::ObjectId b) {
  return pair_key(test, element(model, a), element(model, b));
}

}  // namespace strake::clash
