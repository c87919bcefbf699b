// SPDX-License-Identifier: Apache-2.0
// Reader of the tables of notes: levels, scale bar, north, lists, revisions.
#pragma once

#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"
#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Reads the tables of notes. The views that they name must be known.
class NoteReader {
 public:
  NoteReader(settings::ParseContext& reading, settings::NamedSets& sets, SheetSpec& found)
      : reading_(reading), sets_(sets), found_(found) {}

  void levels(const settings::Value& value);
  void scale_bar(const settings::Value& value);
  void north(const settings::Value& value);
  void parts_list(const settings::Value& value);
  void revision(const settings::Value& value);
  void dimension(const settings::Value& value);
  /// Checks that the views that a view names exist.
  void check_names(const ViewSpec& view, settings::SourcePosition at);

 private:
  DimensionEnd end_of_dimension(settings::TableReader& table, std::string_view key);
  void level(settings::TableReader& table, const settings::Value& value);
  std::optional<BalloonSpec> balloons(settings::TableReader& table);
  void column(settings::TableReader& table, const settings::Value& value, PartsListSpec& list);
  std::optional<PaperPoint> position(settings::TableReader& table);
  void know_view(const std::string& name, settings::SourcePosition at, const std::string& what);
  [[nodiscard]] std::string place(const settings::Value& value, std::string_view what) const {
    return reading_.file() + ", line " + std::to_string(value.at.line) + ": " + std::string(what);
  }

  settings::ParseContext& reading_;
  settings::NamedSets& sets_;
  SheetSpec& found_;
};

}  // namespace strake::sheets
