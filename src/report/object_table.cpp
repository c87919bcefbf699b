// SPDX-License-Identifier: Apache-2.0
#include "report/object_table.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace strake::report {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16U;

std::size_t hash_of(const SeededHash& hash, const DocumentObject& o) {
  // An odd factor each, so that two texts that change places do not meet.
  return hash(o.id) + 3 * hash(o.name) + 5 * hash(o.file);
}

std::uint32_t tag_of(std::size_t hash) { return static_cast<std::uint32_t>(hash >> 32U); }

bool same(const DocumentObject& x, const DocumentObject& y) {
  return x.id == y.id && x.name == y.name && x.file == y.file;
}

}  // namespace

ObjectTable::ObjectTable(ClashDocument& document) : document_(document), slots_(1024) {}

std::uint32_t ObjectTable::number(const DocumentObject& object) {
  std::vector<DocumentObject>& objects = document_.objects;
  std::swap(last_, last_but_one_);
  if (last_ != kEmpty && same(objects[last_], object)) return last_;
  const std::size_t hash = hash_of(hash_, object);
  const Slot& found = slots_[slot(object, hash)];
  if (found.number != kEmpty) return last_ = found.number;
  last_ = static_cast<std::uint32_t>(objects.size());
  DocumentObject& own = objects.emplace_back();
  own.id = kept(object.id);
  // Names are mostly how ids end.
  own.name = own.id.ends_with(object.name) ? own.id.substr(own.id.size() - object.name.size())
                                           : kept(object.name);
  own.file = kept_label(object.file);
  if (2 * objects.size() > slots_.size())
    grow();
  else
    put(hash, last_);
  return last_;
}

/// Where an object stands, or an empty slot.
std::size_t ObjectTable::slot(const DocumentObject& object, std::size_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].number != kEmpty &&
         (slots_[at].tag != tag_of(hash) || !same(document_.objects[slots_[at].number], object)))
    at = (at + 1) & mask;
  return at;
}

/// Into the first empty slot: no other object is equal.
void ObjectTable::put(std::size_t hash, std::uint32_t number) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].number != kEmpty) at = (at + 1) & mask;
  slots_[at] = {number, tag_of(hash)};
}

void ObjectTable::grow() {
  slots_.assign(2 * slots_.size(), {});
  for (std::uint32_t i = 0; i < document_.objects.size(); ++i)
    put(hash_of(hash_, document_.objects[i]), i);
}

std::string_view ObjectTable::kept(std::string_view text) {
  if (text.size() > room_) {
    room_ = std::max(kChunk, text.size());
    free_ = document_.texts.emplace_back(std::make_unique_for_overwrite<char[]>(room_)).get();
  }
  char* const own = free_;
  std::copy(text.begin(), text.end(), own);
  free_ += text.size();
  room_ -= text.size();
  return {own, text.size()};
}

std::string_view ObjectTable::kept_label(std::string_view text) {
  const auto at = labels_.find(text);
  return at != labels_.end() ? *at : *labels_.insert(kept(text)).first;
}

}  // namespace strake::report
