// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "io/gltf/json/json.hpp"

namespace strake::io::gltf {

/// An enumeration: what its values are called. Its columns share it.
struct Enumeration {
  JsonValue value_type;  ///< of its values, if it says so
  std::map<std::int64_t, std::string> words;
};

/// The schema of EXT_structural_metadata by names. Each part is read once, when it is requested: a
/// schema of few bytes may have thousands of properties, and tables that name them all.
class Schema {
 public:
  explicit Schema(const JsonValue& json);

  /// Returns what a class says of a property; a value that does not exist if nothing.
  [[nodiscard]] JsonValue property(const std::string& class_name, const std::string& name);
  /// Returns nothing where there is no such enumeration.
  [[nodiscard]] std::shared_ptr<const Enumeration> enumeration(const std::string& name);

 private:
  using Members = std::map<std::string, JsonValue>;

  Members classes_, enums_;
  std::map<std::string, Members> properties_;  ///< per class
  std::map<std::string, std::shared_ptr<const Enumeration>> enumerations_;
};

}  // namespace strake::io::gltf
