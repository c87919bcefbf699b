// SPDX-License-Identifier: Apache-2.0
// Reader of what a file says of the paper of a sheet: size, template, scale, where views may lie.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "settings/table_reader.hpp"
#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Reads the keys of [sheet], or those of a [[sheet]].
class PaperReader {
 public:
  PaperReader(settings::ParseContext& reading, ReadTemplate read_template, SheetSpec& found)
      : reading_(reading), read_template_(read_template), found_(found) {}

  void read(settings::TableReader& table);

 private:
  PaperBox paper_box(settings::TableReader& table, std::string_view key,
                     const std::vector<double>& sides);
  void keep_free(settings::TableReader& table);
  void artwork(settings::TableReader& table);
  void size(settings::TableReader& table);
  void take_size(double width_mm, double height_mm);
  void named_size(settings::TableReader& table, const std::string& name, bool portrait);
  void check_artwork(settings::TableReader& table);

  settings::ParseContext& reading_;
  ReadTemplate read_template_;
  SheetSpec& found_;
};

}  // namespace strake::sheets
