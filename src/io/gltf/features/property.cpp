// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/features/property.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace strake::io::gltf {
namespace {

/// Longer texts are of no use, as in extras.
constexpr std::size_t kMaxPropertyBytes = 4096;

constexpr std::array<std::pair<std::string_view, Property::Number>, 10> kNumbers{
    {{"INT8", Property::Number::i8},
     {"UINT8", Property::Number::u8},
     {"INT16", Property::Number::i16},
     {"UINT16", Property::Number::u16},
     {"INT32", Property::Number::i32},
     {"UINT32", Property::Number::u32},
     {"INT64", Property::Number::i64},
     {"UINT64", Property::Number::u64},
     {"FLOAT32", Property::Number::f32},
     {"FLOAT64", Property::Number::f64}}};

std::optional<Property::Number> number_named(std::string_view name) {
  for (const auto& [word, number] : kNumbers)
    if (word == name) return number;
  return std::nullopt;
}

std::size_t bytes_of_number(Property::Number number) {
  constexpr std::array<std::size_t, 10> kBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(number)];
}

/// Calls visit(value) with a number in its own type.
template <class Visit>
auto visit_number(Property::Number number, const std::byte* at, Visit&& visit) {
  const auto load = [at]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    return value;
  };
  switch (number) {
    case Property::Number::i8:
      return visit(load(std::int8_t{}));
    case Property::Number::u8:
      return visit(load(std::uint8_t{}));
    case Property::Number::i16:
      return visit(load(std::int16_t{}));
    case Property::Number::u16:
      return visit(load(std::uint16_t{}));
    case Property::Number::i32:
      return visit(load(std::int32_t{}));
    case Property::Number::u32:
      return visit(load(std::uint32_t{}));
    case Property::Number::i64:
      return visit(load(std::int64_t{}));
    case Property::Number::u64:
      return visit(load(std::uint64_t{}));
    case Property::Number::f32:
      return visit(load(float{}));
    case Property::Number::f64:
      break;
  }
  return visit(load(double{}));
}

std::size_t width_of(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kTypes{{{"SCALAR", 1},
                                                                            {"VEC2", 2},
                                                                            {"VEC3", 3},
                                                                            {"VEC4", 4},
                                                                            {"MAT2", 4},
                                                                            {"MAT3", 9},
                                                                            {"MAT4", 16}}};
  for (const auto& [name, width] : kTypes)
    if (name == type) return width;
  return 0;
}

/// Returns an entry of a table of offsets.
std::optional<std::uint64_t> entry(std::span<const std::byte> table, std::size_t bytes_each,
                                   std::uint64_t index) {
  if (index >= table.size() / bytes_each) return std::nullopt;
  std::uint64_t value = 0;
  std::memcpy(&value, table.data() + index * bytes_each, bytes_each);
  return value;
}

std::size_t offset_bytes(const JsonValue& type) {
  if (type.is_text("UINT8")) return 1;
  if (type.is_text("UINT16")) return 2;
  return type.is_text("UINT64") ? 8 : 4;
}

/// Returns a number of the schema as the text of one that is stored.
std::string number_of_schema(const JsonValue& json, Property::Number number) {
  const double value = json.number().value_or(NAN);
  constexpr double kMaxExact = 9007199254740992.0;  // 2^53
  if (number == Property::Number::f64 && std::isfinite(value)) return fmt::format("{}", value);
  if (number == Property::Number::f32 && std::fabs(value) <= std::numeric_limits<float>::max())
    return fmt::format("{}", static_cast<float>(value));
  if (std::fabs(value) < kMaxExact && value == std::floor(value))
    return fmt::format("{}", static_cast<std::int64_t>(value));
  return std::string(json.raw());
}

/// Returns a value of the schema as text() gives values.
std::string schema_text(const JsonValue& json, const Property& property,
                        std::string_view separator) {
  if (json.is_string()) return json.text_value();
  if (!json.is_array())
    return property.kind == Property::Kind::number ? number_of_schema(json, property.number)
                                                   : std::string(json.raw());
  std::string all;
  bool first = true;
  json.elements([&](const JsonValue& item) {
    if (!std::exchange(first, false)) all += separator;
    all += schema_text(item, property, ", ");
  });
  return all;
}

}  // namespace

std::optional<std::string> Property::number_text(std::uint64_t index, bool stored) const {
  const std::size_t bytes_each = bytes_of_number(number);
  std::string all;
  for (std::size_t k = 0; k < width; ++k) {
    const std::uint64_t at = index * width + k;
    if (at >= values.size() / bytes_each) return std::nullopt;
    if (k > 0) all += ", ";
    all += visit_number(number, values.data() + at * bytes_each, [&](auto value) {
      if (stored || !is_derived()) return fmt::format("{}", value);
      double real = static_cast<double>(value);
      if (normalized)
        real =
            std::max(real / static_cast<double>(std::numeric_limits<decltype(value)>::max()), -1.0);
      return fmt::format("{}", real * scale.value_or(1) + offset.value_or(0));
    });
  }
  return all;
}

std::optional<std::string> Property::element(std::uint64_t index, bool stored) const {
  switch (kind) {
    case Kind::number:
      return number_text(index, stored);
    case Kind::boolean: {
      if (index / 8 >= values.size()) return std::nullopt;
      const auto bits = std::to_integer<unsigned>(values[index / 8]);
      return (bits >> (index % 8) & 1U) != 0 ? "true" : "false";
    }
    case Kind::enumeration: {
      const std::size_t bytes_each = bytes_of_number(number);
      if (index >= values.size() / bytes_each) return std::nullopt;
      const auto value = visit_number(number, values.data() + index * bytes_each,
                                      [](auto one) { return static_cast<std::int64_t>(one); });
      const auto word = words->words.find(value);
      return word == words->words.end() ? fmt::format("{}", value) : word->second;
    }
    case Kind::text:
      break;
  }
  const auto begin = entry(string_offsets, string_offset_bytes, index),
             end = entry(string_offsets, string_offset_bytes, index + 1);
  if (!begin || !end || *begin > *end || *end > values.size()) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(values.data()) + *begin,
                     std::min<std::uint64_t>(*end - *begin, kMaxPropertyBytes));
}

std::optional<Property::Range> Property::elements(std::uint64_t row) const {
  if (!array) return Range{row, row + 1};
  if (array_offsets.empty()) return Range{row * fixed_count, (row + 1) * fixed_count};
  const auto begin = entry(array_offsets, array_offset_bytes, row),
             end = entry(array_offsets, array_offset_bytes, row + 1);
  if (!begin || !end || *begin > *end) return std::nullopt;
  return Range{*begin, *end};
}

std::optional<std::string> Property::row_text(std::uint64_t row, bool stored) const {
  const std::optional<Range> range = elements(row);
  if (!range) return std::nullopt;
  std::string all;
  for (std::uint64_t i = range->begin; i < range->end && all.size() < kMaxPropertyBytes; ++i) {
    const std::optional<std::string> one = element(i, stored);
    if (!one) return std::nullopt;
    if (i > range->begin) all += "; ";
    all += *one;
  }
  return all;
}

std::optional<std::string> Property::text(std::uint64_t row) const {
  std::optional<std::string> all = row_text(row, false);
  if (!all || !no_data) return all;
  const bool none = is_derived() ? row_text(row, true) == no_data : all == no_data;
  return none ? default_text : all;
}

std::uint64_t Property::text_bytes(std::uint64_t row) const {
  constexpr std::uint64_t kNumber = 32;
  const std::optional<Range> range = elements(row);
  if (!range) return 0;
  std::uint64_t largest = (range->end - range->begin) * width * kNumber;
  if (kind == Kind::text && !array) {
    const auto begin = entry(string_offsets, string_offset_bytes, row),
               end = entry(string_offsets, string_offset_bytes, row + 1);
    largest = begin && end && *begin <= *end ? *end - *begin : 0;
  }
  return array ? 2 * kMaxPropertyBytes : std::min<std::uint64_t>(largest, kMaxPropertyBytes);
}

std::optional<Property> read_property(Schema& schema, const std::string& class_name,
                                      const std::string& name) {
  const JsonValue json = schema.property(class_name, name);
  const auto [type, component, enum_type, array, count, normalized, offset, scale, no_data,
              fallback, semantic] =
      json.pick<11>({"type", "componentType", "enumType", "array", "count", "normalized", "offset",
                     "scale", "noData", "default", "semantic"});
  Property property;
  property.name = class_name + '.' + name;
  property.semantic = semantic.text_value();
  property.array = array.boolean().value_or(false);
  property.fixed_count = std::min<std::uint64_t>(count.index().value_or(1), 1U << 16U);
  property.normalized = normalized.boolean().value_or(false);
  property.offset = offset.number();
  property.scale = scale.number();
  const std::string type_name = type.text_value();
  std::optional<Property::Number> number;
  if (type_name == "STRING") {
    property.kind = Property::Kind::text;
  } else if (type_name == "BOOLEAN") {
    property.kind = Property::Kind::boolean;
  } else if (type_name == "ENUM") {
    property.kind = Property::Kind::enumeration;
    property.words = schema.enumeration(enum_type.text_value());
    if (!property.words) return std::nullopt;
    const std::string value_type = property.words->value_type.text_value();
    number = number_named(value_type.empty() ? "UINT16" : value_type);
    if (!number || *number >= Property::Number::f32) return std::nullopt;
  } else {
    property.width = width_of(type_name);
    number = number_named(component.text_value());
    if (property.width == 0 || !number) return std::nullopt;
  }
  property.number = number.value_or(property.number);
  const std::string_view separator = property.array ? "; " : ", ";
  if (no_data.exists()) property.no_data = schema_text(no_data, property, separator);
  if (fallback.exists()) property.default_text = schema_text(fallback, property, separator);
  return property;
}

std::optional<GltfFault> read_values(const Buffers& buffers, const JsonValue& json,
                                     Property& property) {
  const auto [values, arrays, strings, array_type, string_type, offset, scale] =
      json.pick<7>({"values", "arrayOffsets", "stringOffsets", "arrayOffsetType",
                    "stringOffsetType", "offset", "scale"});
  if (offset.exists()) property.offset = offset.number();
  if (scale.exists()) property.scale = scale.number();
  property.array_offset_bytes = offset_bytes(array_type);
  property.string_offset_bytes = offset_bytes(string_type);
  const auto open = [&](const JsonValue& number, std::span<const std::byte>& bytes) {
    const Checked<Buffers::BufferView> view = buffers.view(number);
    if (const GltfFault* const fault = fault_of(view)) return std::optional<GltfFault>(*fault);
    bytes = std::get<Buffers::BufferView>(view).bytes;
    return std::optional<GltfFault>();
  };
  if (auto fault = open(values, property.values)) return fault;
  if (arrays.exists())
    if (auto fault = open(arrays, property.array_offsets)) return fault;
  if (property.kind == Property::Kind::text) return open(strings, property.string_offsets);
  return std::nullopt;
}

}  // namespace strake::io::gltf
