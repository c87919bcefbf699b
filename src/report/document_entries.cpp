// SPDX-License-Identifier: Apache-2.0
#include "report/document_entries.hpp"

#include <cmath>

#include "strake/clash/identity.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

}  // namespace

std::string EntryReader::where() const {
  return std::string(section_) + "[" + std::to_string(at_) + "]";
}

DocumentEntry EntryReader::next() {
  if (json_.kind() != Kind::object) throw DocumentFault{where(), "is no object"};
  DocumentEntry entry;
  json_.members([&](std::string_view key) { take_member(key, entry); });
  return entry;
}

void EntryReader::take_member(std::string_view key, DocumentEntry& entry) {
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
  if (json_.kind() != Kind::string) throw is_not(where(), key, "text");
  return json_.text();
}

double EntryReader::millimetres(const char* key) {
  const double d = json_.kind() == Kind::number ? json_.number() : HUGE_VAL;
  if (!std::isfinite(d)) throw is_not(where(), key, "number");
  return d;
}

bool EntryReader::truth(const char* key) {
  if (json_.kind() != Kind::boolean) throw is_not(where(), key, "true or false");
  std::string said;
  json_.copy(said);
  return said == "true";
}

geometry::Vec3d EntryReader::point() {
  if (json_.kind() != Kind::array) throw is_not(where(), "point_mm", "point");
  geometry::Vec3d p;
  int k = 0;
  json_.items([&] {
    const double value = millimetres("point_mm");
    if (k < 3) p[k] = value;
    ++k;
  });
  if (k != 3) throw is_not(where(), "point_mm", "point");
  return p;
}

std::uint32_t EntryReader::whole(const char* key, const char* what) {
  const double value = json_.kind() == Kind::number ? json_.number() : -1;
  if (value < 0 || value > 0xffffffffU || value != std::floor(value))
    throw is_not(where(), key, what);
  return static_cast<std::uint32_t>(value);
}

Hash128 EntryReader::pair_key() {
  const auto key = clash::parse_key(text("key"));
  if (!key) throw is_not(where(), "key", "key of a pair");
  return *key;
}

clash::Class EntryReader::pair_class() {
  using enum clash::Class;
  const std::string_view said = text("class");
  for (const clash::Class cls : {contact, hit, clearance_violation})
    if (said == clash::name(cls)) return cls;
  throw is_not(where(), "class", "class of a result");
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
  if (json_.kind() != Kind::object) throw is_not(where(), side, "object");
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
    if (!there[i]) throw lacks(where(), kKeys[i]);
  return objects_.number({texts_[0], texts_[1], texts_[2]});
}

}  // namespace strake::report
