// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/gltf/accessor.hpp"
#include "io/gltf/features/schema.hpp"
#include "io/gltf/json/json.hpp"

namespace strake::io::gltf {

/// One column of a property table of EXT_structural_metadata.
struct Property {
  enum class Kind : std::uint8_t { number, text, boolean, enumeration };
  enum class Number : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

  std::string name;      ///< "Class.property"
  std::string semantic;  ///< "NAME", "ID" or anything else
  Kind kind = Kind::number;
  Number number = Number::f32;  ///< of a number, or behind an enumeration
  std::size_t width = 1;        ///< numbers of a vector or matrix
  bool normalized = false, array = false;
  std::uint64_t fixed_count = 1;  ///< of an array without offsets
  std::optional<double> offset, scale;
  std::optional<std::string> no_data;        ///< as stored, before normalized, offset and scale
  std::optional<std::string> default_text;   ///< as it is, after these
  std::shared_ptr<const Enumeration> words;  ///< of an enumeration
  std::span<const std::byte> values, array_offsets, string_offsets;
  std::size_t array_offset_bytes = 4, string_offset_bytes = 4;

  /// Returns the value of a row as text: numbers of a vector with commas between them, elements of
  /// an array with semicolons. Nothing where there is none, or bytes lack.
  [[nodiscard]] std::optional<std::string> text(std::uint64_t row) const;
  /// Returns at most how many bytes text() has.
  [[nodiscard]] std::uint64_t text_bytes(std::uint64_t row) const;

 private:
  struct Range {
    std::uint64_t begin = 0, end = 0;
  };
  [[nodiscard]] std::optional<Range> elements(std::uint64_t row) const;
  /// Whether values are not the numbers that are stored.
  [[nodiscard]] bool is_derived() const { return normalized || offset || scale; }
  /// Returns the value of a row, or what is stored of it, as text.
  [[nodiscard]] std::optional<std::string> row_text(std::uint64_t row, bool stored) const;
  [[nodiscard]] std::optional<std::string> element(std::uint64_t index, bool stored) const;
  [[nodiscard]] std::optional<std::string> number_text(std::uint64_t index, bool stored) const;
};

/// Reads what a schema says of a property of a class, without its values. Nothing where it is of no
/// known type.
[[nodiscard]] std::optional<Property> read_property(Schema& schema, const std::string& class_name,
                                                    const std::string& name);

/// Adds what a table says of the property: its values. A fault where they are not there.
[[nodiscard]] std::optional<GltfFault> read_values(const Buffers& buffers, const JsonValue& json,
                                                   Property& property);

}  // namespace strake::io::gltf
