// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"
#include "sheets/description.hpp"

namespace strake::sheets {

/// Reads what is drawn beside the lines of the model: tags, grid lines and styles of lines. The
/// views that they name must be known.
class MarkReader {
 public:
  MarkReader(settings::Reading& reading, settings::NamedSets& sets, Description& found)
      : reading_(reading), sets_(sets), found_(found) {}

  void tag(const settings::Value& value);
  void grid(const settings::Value& value);
  void styles(const settings::Value& value);

 private:
  std::vector<std::string> views(settings::TableReader& table);
  void planes(settings::TableReader& table, std::uint8_t axis);
  void series(const settings::Value& value);
  void style(const settings::Entry& entry);
  [[nodiscard]] std::string place(settings::Place at) const {
    return reading_.file() + ", line " + std::to_string(at.line);
  }

  settings::Reading& reading_;
  settings::NamedSets& sets_;
  Description& found_;
};

}  // namespace strake::sheets
