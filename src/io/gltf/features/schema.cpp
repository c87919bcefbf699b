// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/features/schema.hpp"

#include <cmath>
#include <optional>

namespace strake::io::gltf {
namespace {

/// Of repeated keys the first counts.
std::map<std::string, JsonValue> members_of(const JsonValue& object) {
  std::map<std::string, JsonValue> members;
  object.members([&](const JsonValue& key, const JsonValue& value) {
    members.try_emplace(key.text_value(), value);
  });
  return members;
}

std::shared_ptr<const Enumeration> read_enumeration(const JsonValue& json) {
  constexpr double kMaxExact = 1e15;
  const auto [type, values] = json.pick<2>({"valueType", "values"});
  const auto made = std::make_shared<Enumeration>();
  made->value_type = type;
  values.elements([&](const JsonValue& value) {
    const auto [name, number] = value.pick<2>({"name", "value"});
    const std::optional<double> code = number.number();
    if (code && std::fabs(*code) < kMaxExact)
      made->words[static_cast<std::int64_t>(*code)] = name.text_value();
  });
  return made;
}

}  // namespace

Schema::Schema(const JsonValue& json) {
  const auto [classes, enums] = json.pick<2>({"classes", "enums"});
  classes_ = members_of(classes);
  enums_ = members_of(enums);
}

JsonValue Schema::property(const std::string& class_name, const std::string& name) {
  const auto stated = classes_.find(class_name);
  if (stated == classes_.end()) return {};
  const auto [known, is_new] = properties_.try_emplace(class_name);
  if (is_new) known->second = members_of(stated->second["properties"]);
  const auto found = known->second.find(name);
  return found == known->second.end() ? JsonValue() : found->second;
}

std::shared_ptr<const Enumeration> Schema::enumeration(const std::string& name) {
  const auto stated = enums_.find(name);
  if (stated == enums_.end()) return nullptr;
  std::shared_ptr<const Enumeration>& known = enumerations_[name];
  if (!known) known = read_enumeration(stated->second);
  return known;
}

}  // namespace strake::io::gltf
