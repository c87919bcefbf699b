// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/features/property.hpp"
#include "io/gltf/features/schema.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/model/model.hpp"

/// What EXT_structural_metadata says of the features that EXT_instance_features and
/// EXT_mesh_features number.
namespace strake::io::gltf {

/// What a row of a table says of an object.
struct FeatureRow {
  std::string name, id;  ///< properties whose semantic is NAME or ID; else empty
  model::Attributes attributes;
};

class PropertyTables {
 public:
  /// Reads the tables of a document; what is wrong with one of their columns is a fault, and the
  /// others are read.
  PropertyTables(const JsonValue& root, const Buffers& buffers);

  /// Appends what the row of a table says, if there is such a row.
  void add_row(std::uint64_t table, std::uint64_t row, FeatureRow& out) const;
  /// Returns at most how many bytes add_row() adds.
  [[nodiscard]] std::uint64_t row_bytes(std::uint64_t table, std::uint64_t row) const;
  [[nodiscard]] const std::vector<GltfFault>& faults() const { return faults_; }

 private:
  struct Table {
    std::uint64_t rows = 0;
    std::vector<Property> columns;
  };
  void read_table(Schema& schema, const JsonValue& json, std::size_t index, const Buffers& buffers);

  std::vector<Table> tables_;
  std::vector<GltfFault> faults_;
};

/// A set of feature ids of a node's instances or of a mesh: a table, and which of its rows.
struct FeatureIds {
  std::size_t place = 0;  ///< among the sets that are stated
  std::uint64_t table = 0;
  std::optional<std::uint64_t> null_id;
  std::optional<Accessor> ids;  ///< none: each element is numbered by its place
  [[nodiscard]] std::optional<std::uint64_t> of(std::size_t element) const;
};

/// Reads the sets of an extension that have a property table; `attributes` are those in which
/// _FEATURE_ID_n is looked up. Sets that are in textures, or do not fit, are left out.
[[nodiscard]] std::vector<FeatureIds> read_feature_ids(const JsonValue& extension,
                                                       const JsonValue& attributes,
                                                       const Accessors& accessors);

}  // namespace strake::io::gltf
