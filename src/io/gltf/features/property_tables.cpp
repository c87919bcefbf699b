// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/features/property_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace strake::io::gltf {

PropertyTables::PropertyTables(const JsonValue& root, const Buffers& buffers) {
  const JsonValue metadata = root["extensions"]["EXT_structural_metadata"];
  if (!metadata.exists()) return;
  const auto [schema, uri, tables] = metadata.pick<3>({"schema", "schemaUri", "propertyTables"});
  if (uri.exists() && !schema.exists())
    faults_.push_back({"/extensions/EXT_structural_metadata/schemaUri",
                       "a schema in a file of its own is not read"});
  Schema by_name(schema);
  tables.elements(
      [&](const JsonValue& json) { read_table(by_name, json, tables_.size(), buffers); });
}

void PropertyTables::read_table(Schema& schema, const JsonValue& json, std::size_t index,
                                const Buffers& buffers) {
  const auto [class_json, count, values] = json.pick<3>({"class", "count", "properties"});
  Table table;
  table.rows = count.index().value_or(0);
  const std::string class_name = class_json.text_value();
  const std::string pointer =
      fmt::format("/extensions/EXT_structural_metadata/propertyTables/{}/properties/", index);
  values.members([&](const JsonValue& key, const JsonValue& value) {
    const std::string name = key.text_value();
    std::optional<Property> property = read_property(schema, class_name, name);
    if (!property) {
      faults_.push_back({pointer + name, "is of no type that is known"});
      return;
    }
    if (std::optional<GltfFault> fault = read_values(buffers, value, *property)) {
      faults_.push_back({pointer + name, std::move(fault->message)});
      return;
    }
    table.columns.push_back(std::move(*property));
  });
  tables_.push_back(std::move(table));
}

void PropertyTables::add_row(std::uint64_t table, std::uint64_t row, FeatureRow& out) const {
  if (table >= tables_.size() || row >= tables_[table].rows) return;
  for (const Property& column : tables_[table].columns) {
    std::optional<std::string> text = column.text(row);
    if (!text || text->empty()) continue;
    if (column.semantic == "NAME") out.name = *text;
    if (column.semantic == "ID") out.id = *text;
    out.attributes.emplace_back(column.name, std::move(*text));
  }
}

std::uint64_t PropertyTables::row_bytes(std::uint64_t table, std::uint64_t row) const {
  if (table >= tables_.size() || row >= tables_[table].rows) return 0;
  std::uint64_t bytes = 0;
  for (const Property& column : tables_[table].columns)
    bytes += sizeof(model::Attributes::value_type) + column.name.size() + column.text_bytes(row);
  return bytes;
}

std::optional<std::uint64_t> FeatureIds::of(std::size_t element) const {
  std::uint64_t id = element;
  if (ids) {
    std::array<double, 4> number{};
    if (element >= ids->count) return std::nullopt;
    ids->element(element, number.data());
    if (!(number[0] >= 0 && number[0] < 9e15)) return std::nullopt;
    id = static_cast<std::uint64_t>(std::llround(number[0]));
  }
  return id == null_id ? std::nullopt : std::optional(id);
}

std::vector<FeatureIds> read_feature_ids(const JsonValue& extension, const JsonValue& attributes,
                                         const Accessors& accessors) {
  constexpr std::size_t kMaxSets = 16;
  std::vector<FeatureIds> sets;
  std::size_t stated = 0;
  extension["featureIds"].elements([&](const JsonValue& json) {
    const std::size_t place = stated++;
    if (sets.size() == kMaxSets) return;
    const auto [attribute, texture, table, null_id] =
        json.pick<4>({"attribute", "texture", "propertyTable", "nullFeatureId"});
    if (texture.exists() || !table.exists()) return;
    FeatureIds set;
    set.place = place;
    set.table = table.index().value_or(UINT64_MAX);
    set.null_id = null_id.index();
    if (attribute.exists()) {
      const std::string name =
          fmt::format("_FEATURE_ID_{}", attribute.index().value_or(UINT64_MAX));
      Checked<Accessor> opened = accessors.open(attributes[name]);
      if (fault_of(opened) != nullptr || std::get<Accessor>(opened).width != 1) return;
      set.ids = std::move(std::get<Accessor>(opened));
    }
    sets.push_back(std::move(set));
  });
  return sets;
}

}  // namespace strake::io::gltf
