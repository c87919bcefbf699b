// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "report/document_fault.hpp"
#include "report/json_reader.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::report {

/// The value of an enumeration that has this name; name(value) is empty beyond the last.
template <class Enum, class Name>
std::optional<Enum> named(std::string_view text, Name&& name) {
  for (std::uint8_t i = 0; !name(static_cast<Enum>(i)).empty(); ++i)
    if (name(static_cast<Enum>(i)) == text) return static_cast<Enum>(i);
  return std::nullopt;
}

/// Takes values that must be of some kind; `where` and `key` are what a DocumentFault names.
class DocumentFields {
 public:
  /// No number of a drawing is larger. Nothing can be placed farther out than geometry::kMaxGridMm;
  /// where placed bodies meet sections and limits, twice that is plenty.
  static constexpr double kFarthestMm = 2 * geometry::kMaxGridMm;

  explicit DocumentFields(JsonReader& json) : json_(json) {}

  void must_be(JsonReader::Kind kind, const std::string& where, std::string_view key,
               const char* what) {
    if (json_.kind() != kind) throw is_not(where, key, what);
  }

  [[nodiscard]] std::string text(const std::string& where, std::string_view key) {
    must_be(JsonReader::Kind::string, where, key, "text");
    return std::string(json_.text());
  }

  [[nodiscard]] double number(const std::string& where, std::string_view key) {
    const double value = json_.kind() == JsonReader::Kind::number ? json_.number() : HUGE_VAL;
    if (!(std::fabs(value) <= kFarthestMm)) throw is_not(where, key, "number that makes sense");
    return value;
  }

  /// A whole number from 0 on.
  [[nodiscard]] std::uint64_t count(const std::string& where, std::string_view key) {
    const double value = number(where, key);
    if (!(value >= 0) || value != std::floor(value)) throw is_not(where, key, "whole number");
    return static_cast<std::uint64_t>(value);
  }

  /// So many numbers up to `farthest`; where() is asked only where something is wrong.
  template <std::size_t N, class Where>
  [[nodiscard]] std::array<double, N> numbers(Where&& where, std::string_view key,
                                              double farthest) {
    if (json_.kind() != JsonReader::Kind::array) throw is_not(where(), key, "point");
    std::array<double, N> values{};
    std::size_t k = 0;
    json_.items([&] {
      const double value = json_.kind() == JsonReader::Kind::number ? json_.number() : HUGE_VAL;
      if (!(std::fabs(value) <= farthest) || k >= N) throw is_not(where(), key, "point");
      values.at(k++) = value;
    });
    if (k != N) throw is_not(where(), key, "point");
    return values;
  }

 private:
  JsonReader& json_;
};

}  // namespace strake::report
