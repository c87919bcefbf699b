// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"
#include "sheets/description.hpp"

namespace strake::sheets {

/// Reads what tables say of views. What a table does not say stays as it is.
class ViewReader {
 public:
  ViewReader(settings::Reading& reading, settings::NamedSets& sets)
      : reading_(reading), sets_(sets) {}

  /// What may be said of all views at once: what is drawn, and how.
  void content(settings::TableReader& table, ViewWish& view);
  /// Direction and up.
  void direction(settings::TableReader& table, ViewWish& view);
  /// The same, or an eye instead of the direction, with its target and what it sees.
  void seen_from(settings::TableReader& table, ViewWish& view);
  /// "1:50".
  static std::optional<double> scale(settings::TableReader& table);

  /// A point of the model, grid units.
  std::optional<geometry::Vec3l> point(settings::TableReader& table, std::string_view key);

 private:
  std::optional<geometry::Vec3l> vector(settings::TableReader& table, std::string_view key,
                                        bool names);
  void up(settings::TableReader& table, ViewWish& view);
  void perspective(settings::TableReader& table, ViewWish& view);
  void limits(settings::TableReader& table, ViewWish& view);
  void sections(settings::TableReader& table, ViewWish& view);
  void select(settings::TableReader& table, ViewWish& view);
  std::vector<settings::Chooser> choosers(settings::TableReader& table);
  void hatches(settings::TableReader& table, ViewWish& view);
  void hatch(const settings::Value& value, const std::string& outer, ViewWish& view);

  settings::Reading& reading_;
  settings::NamedSets& sets_;
};

}  // namespace strake::sheets
