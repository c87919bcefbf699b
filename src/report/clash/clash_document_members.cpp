// SPDX-License-Identifier: Apache-2.0
#include "report/clash/clash_document_members.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "report/document/document_reader.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16U;

std::size_t hash_of(const SeededHash& hash, const DocumentObject& o) {
  // Each has an odd factor, so that two texts that are swapped do not collide.
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
  const HashSlot& found = slots_[slot(object, hash)];
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

/// Returns the slot of an object, or an empty slot.
std::size_t ObjectTable::slot(const DocumentObject& object, std::size_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].number != kEmpty &&
         (slots_[at].tag != tag_of(hash) || !same(document_.objects[slots_[at].number], object)))
    at = (at + 1) & mask;
  return at;
}

/// Puts an object into the first empty slot: no other object is equal.
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

namespace {

using Kind = JsonReader::Kind;

}  // namespace

std::string EntryReader::where() const {
  return std::string(section_) + "[" + std::to_string(at_) + "]";
}

DocumentEntry EntryReader::next() {
  if (json_.kind() != Kind::object) throw DocumentFault{where(), "is no object"};
  DocumentEntry entry;
  json_.members([&](std::string_view key) { read_member(key, entry); });
  return entry;
}

void EntryReader::read_member(std::string_view key, DocumentEntry& entry) {
  if (key == "a")
    entry.a = object("a");
  else if (key == "b")
    entry.b = object("b");
  else if (key == "test")
    entry.test = whole("test", "number of a test");
  else if (key == "key")
    entry.key = pair_key();
  else if (key == "class")
    entry.cls = pair_class();
  else if (key == "d_mm")
    entry.d_mm = millimetres("d_mm");
  else if (key == "point_mm")
    entry.point_mm = point();
  else if (key == rule_)
    entry.rule = rule();
  else if (key == "region_count" && json_.kind() != Kind::null)
    entry.regions = whole("region_count", "number of places");
  else if (key == "allowed_region_count")
    entry.allowed_regions = whole("allowed_region_count", "number of places");
  else if (key == "depth_complete")
    entry.depth_complete = truth("depth_complete");
  else
    json_.skip();
}

std::string_view EntryReader::text(const char* key) {
  if (json_.kind() != Kind::string) throw wrong_type(where(), key, "text");
  return json_.text();
}

double EntryReader::millimetres(const char* key) {
  const double d = json_.kind() == Kind::number ? json_.number() : HUGE_VAL;
  if (!std::isfinite(d)) throw wrong_type(where(), key, "number");
  return d;
}

bool EntryReader::truth(const char* key) {
  if (json_.kind() != Kind::boolean) throw wrong_type(where(), key, "true or false");
  std::string stated;
  json_.copy(stated);
  return stated == "true";
}

geometry::Vec3d EntryReader::point() {
  if (json_.kind() != Kind::array) throw wrong_type(where(), "point_mm", "point");
  geometry::Vec3d p;
  int k = 0;
  json_.items([&] {
    const double value = millimetres("point_mm");
    if (k < 3) p[k] = value;
    ++k;
  });
  if (k != 3) throw wrong_type(where(), "point_mm", "point");
  return p;
}

std::uint32_t EntryReader::whole(const char* key, const char* what) {
  const double value = json_.kind() == Kind::number ? json_.number() : -1;
  if (value < 0 || value > 0xffffffffU || value != std::floor(value))
    throw wrong_type(where(), key, what);
  return static_cast<std::uint32_t>(value);
}

Hash128 EntryReader::pair_key() {
  const auto key = clash::parse_key(text("key"));
  if (!key) throw wrong_type(where(), "key", "key of a pair");
  return *key;
}

clash::Class EntryReader::pair_class() {
  using enum clash::Class;
  const std::string_view stated = text("class");
  for (const clash::Class cls : {contact, hit, clearance_violation})
    if (stated == clash::name(cls)) return cls;
  throw wrong_type(where(), "class", "class of a result");
}

std::uint32_t EntryReader::rule() {
  const std::string_view name = text(rule_);
  if (name.empty()) return 0;
  const auto at = rules_.find(name);
  if (at != rules_.end()) return at->second;
  const auto number = static_cast<std::uint32_t>(document_.rules.size());
  document_.rules.emplace_back(name);
  rules_.emplace(name, number);
  return number;
}

std::uint32_t EntryReader::object(const char* side) {
  if (json_.kind() != Kind::object) throw wrong_type(where(), side, "object");
  constexpr std::array<const char*, 3> kKeys{"id", "name", "file"};
  std::array<bool, kKeys.size()> there{};
  json_.members([&](std::string_view key) {
    for (std::size_t i = 0; i < kKeys.size(); ++i)
      if (key == kKeys[i]) {
        texts_[i] = text(kKeys[i]);
        there[i] = true;
        return;
      }
    json_.skip();
  });
  for (std::size_t i = 0; i < kKeys.size(); ++i)
    if (!there[i]) throw missing_key(where(), kKeys[i]);
  return objects_.number({texts_[0], texts_[1], texts_[2]});
}

namespace {

using Json = nlohmann::json;

const char* value_name(Json::value_t type) {
  return type == Json::value_t::object ? "object" : type == Json::value_t::array ? "list" : "truth";
}

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto it = object.find(key);
  if (it == object.end()) throw missing_key(where, key);
  return *it;
}

std::string text(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_string()) throw wrong_type(where, key, "text");
  return value.get<std::string>();
}

double number(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number()) throw wrong_type(where, key, "number");
  return value.get<double>();
}

std::uint64_t count(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number_unsigned()) throw wrong_type(where, key, "count");
  return value.get<std::uint64_t>();
}

const Json& held(const Json& object, const char* key, Json::value_t type,
                 const std::string& where) {
  const Json& value = member(object, key, where);
  if (value.type() != type) throw wrong_type(where, key, value_name(type));
  return value;
}

std::vector<std::uint8_t> bytes(std::string_view base64, const char* key,
                                const std::string& where) {
  auto parsed = parse_base64(base64);
  if (!parsed) throw wrong_type(where, key, "base64");
  return std::move(*parsed);
}

void read_matrix(const Json& json, DocumentTest& t, const std::string& where) {
  t.has_matrix = true;
  for (const Json& cell : held(json, "cells", Json::value_t::array, where)) {
    const Json settings = cell.contains("settings") ? cell["settings"] : Json("not checked");
    t.settings["matrix, " + text(cell, "a", where) + " and " + text(cell, "b", where)] =
        settings.dump();
  }
}

/// Reads a test of a model with so many elements.
DocumentTest read_test(const Json& json, std::size_t elements, const std::string& where) {
  if (!json.is_object()) throw DocumentFault{where, "is no object"};
  DocumentTest t;
  t.name = text(json, "name", where);
  t.hash = text(json, "hash", where);
  const Json& counts = held(json, "counts", Json::value_t::object, where);
  t.counts = {count(counts, "HIT", where), count(counts, "CONTACT", where),
              count(counts, "CLEARANCE_VIOLATION", where), count(counts, "ALLOWED", where)};
  if (json.contains("unlisted")) {
    const Json& unlisted = held(json, "unlisted", Json::value_t::object, where);
    t.unlisted.emplace();
    t.unlisted->contact = count(unlisted, "CONTACT", where);
    t.unlisted->allowed = count(unlisted, "ALLOWED", where);
  }
  if (json.contains("not_reported"))
    for (const Json& reason : held(json, "not_reported", Json::value_t::array, where)) {
      const Json& left_out = held(reason, "counts", Json::value_t::object, where);
      for (const char* const name : {"HIT", "CONTACT", "CLEARANCE_VIOLATION", "ALLOWED"})
        t.not_reported += count(left_out, name, where);
    }
  const Json& settings = held(json, "settings", Json::value_t::object, where);
  t.settings["curves"] = "false";  // older results do not state it
  for (const auto& [key, value] : settings.items()) t.settings[key] = value.dump();
  t.clearance_mm = number(settings, "clearance_mm", where);
  t.touch_gap_mm = number(settings, "touch_gap_mm", where);
  const Json& tested = held(json, "tested", Json::value_t::object, where);
  t.in_a = bytes(text(tested, "a", where), "a", where);
  t.in_b = bytes(text(tested, "b", where), "b", where);
  const std::size_t size = (elements + 7) / 8;
  if (t.in_a.size() != size || t.in_b.size() != size)
    throw DocumentFault{where, "\"tested\" does not go with \"elements\""};
  t.within_files = held(tested, "within_files", Json::value_t::boolean, where).get<bool>();
  for (const Json& rule : held(json, "exempted", Json::value_t::array, where))
    t.exempted_pairs += count(rule, "pairs", where);
  for (const Json& rule : held(json, "allowed", Json::value_t::array, where))
    if (rule.contains("places"))
      t.allowed_other_regions = t.allowed_other_regions.value_or(0) + count(rule, "places", where);
  if (json.contains("matrix"))
    read_matrix(held(json, "matrix", Json::value_t::object, where), t, where);
  return t;
}

}  // namespace

std::vector<std::uint64_t> read_elements(std::string_view base64) {
  const std::vector<std::uint8_t> raw = bytes(base64, "elements", "the document");
  if (raw.size() % 8 != 0) throw DocumentFault{"the document", "\"elements\" is cut off"};
  std::vector<std::uint64_t> elements;
  elements.reserve(raw.size() / 8);
  for (std::size_t i = 0; i < raw.size(); i += 8) {
    std::uint64_t hash = 0;
    for (unsigned k = 0; k < 8; ++k) hash |= std::uint64_t{raw[i + k]} << (8 * k);
    elements.push_back(hash);
  }
  if (!std::ranges::is_sorted(elements))
    throw DocumentFault{"the document", "\"elements\" are not in order"};
  return elements;
}

std::vector<std::uint8_t> read_sheets(std::string_view base64, std::size_t elements) {
  std::vector<std::uint8_t> sheets = bytes(base64, "sheets", "the document");
  if (sheets.size() != elements)
    throw DocumentFault{"the document", "\"sheets\" does not go with \"elements\""};
  return sheets;
}

std::vector<std::uint8_t> read_positional_ids(std::string_view base64, std::size_t elements) {
  std::vector<std::uint8_t> bits = bytes(base64, "positional_ids", "the document");
  if (bits.size() != (elements + 7) / 8)
    throw DocumentFault{"the document", "\"positional_ids\" does not go with \"elements\""};
  return bits;
}

std::vector<DocumentTest> read_tests(std::string_view json, std::size_t elements) {
  try {
    const Json list = Json::parse(json);
    if (!list.is_array()) throw wrong_type("the document", "tests", "list");
    std::vector<DocumentTest> tests;
    for (std::size_t t = 0; t < list.size(); ++t)
      tests.push_back(read_test(list[t], elements, "tests[" + std::to_string(t) + "]"));
    return tests;
  } catch (const Json::exception&) {
    throw DocumentFault{"the document", "has \"tests\" that cannot be read"};
  }
}

}  // namespace strake::report
