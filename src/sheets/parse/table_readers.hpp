// SPDX-License-Identifier: Apache-2.0
// Readers of the tables of a sheet description: of views, and of tags, grid lines and styles.
#pragma once

#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"
#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Reads the tables of views. Settings that a table does not contain stay as they are.
class ViewReader {
 public:
  ViewReader(settings::ParseContext& reading, settings::NamedSets& sets)
      : reading_(reading), sets_(sets) {}

  /// Reads what may be set for all views at once: what is drawn, and how.
  void content(settings::TableReader& table, ViewSpec& view);
  /// Reads direction and up.
  void direction(settings::TableReader& table, ViewSpec& view);
  /// Reads direction and up, or an eye instead of the direction, with target, near plane and field
  /// of view.
  void read_perspective(settings::TableReader& table, ViewSpec& view);
  /// Places the section planes that a view has read, once it is known from where it looks.
  void place_sections(ViewSpec& view);
  /// Reads a scale such as "1:50".
  static std::optional<double> scale(settings::TableReader& table);

  /// Reads a point of the model, grid units.
  std::optional<geometry::Vec3l> point(settings::TableReader& table, std::string_view key);

 private:
  std::optional<geometry::Vec3l> vector(settings::TableReader& table, std::string_view key,
                                        bool names);
  void up(settings::TableReader& table, ViewSpec& view);
  void perspective(settings::TableReader& table, ViewSpec& view);
  void limits(settings::TableReader& table, ViewSpec& view);
  void sections(settings::TableReader& table, ViewSpec& view);
  std::vector<settings::Chooser> choosers(settings::TableReader& table, const std::string& key);
  void select(settings::TableReader& table, ViewSpec& view);
  void uncut(settings::TableReader& table, ViewSpec& view);
  void hatches(settings::TableReader& table, ViewSpec& view);
  void conventions(settings::TableReader& table, ViewSpec& view);
  void hatch(const settings::Value& value, const std::string& outer, ViewSpec& view);

  settings::ParseContext& reading_;
  settings::NamedSets& sets_;
};

/// Reads the tables of tags, grid lines and line styles. The views that they name must be known.
class MarkReader {
 public:
  MarkReader(settings::ParseContext& reading, settings::NamedSets& sets, SheetSpec& found)
      : reading_(reading), sets_(sets), found_(found) {}

  void tag(const settings::Value& value);
  void grid(const settings::Value& value);
  void styles(const settings::Value& value);

 private:
  std::vector<std::string> views(settings::TableReader& table);
  void planes(settings::TableReader& table, std::uint8_t axis);
  void series(const settings::Value& value);
  void style(const settings::KeyValue& entry);
  [[nodiscard]] std::string place(settings::SourcePosition at) const {
    return reading_.file() + ", line " + std::to_string(at.line);
  }

  settings::ParseContext& reading_;
  settings::NamedSets& sets_;
  SheetSpec& found_;
};

}  // namespace strake::sheets
