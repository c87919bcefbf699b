// SPDX-License-Identifier: Apache-2.0
#include "sheets/parse/paper_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "core/number.hpp"
#include "drawing/layout/paper_size.hpp"
#include "drawing/layout/view_plane.hpp"
#include "sheets/parse/table_readers.hpp"

namespace strake::sheets {

using settings::SourcePosition;
using settings::TableReader;
using settings::Value;

namespace {

constexpr double kFarthestMm = 1e6;

}  // namespace

void PaperReader::read(TableReader& table) {
  artwork(table);
  size(table);
  found_.frame = table.flag("frame").value_or(true);
  found_.scale = ViewReader::scale(table);
  constexpr std::array<std::string_view, 2> kHiddenLayers{"one", "two"};
  if (table.word("hidden_layers", kHiddenLayers).value_or("one") == "two")
    found_.split_hidden = true;
  constexpr std::string_view kBox = "[\"20mm\", \"10mm\", \"410mm\", \"230mm\"]";
  if (const auto box = table.lengths_mm("area", 4, kBox))
    found_.area = paper_box(table, "area", *box);
  keep_free(table);
}

PaperBox PaperReader::paper_box(TableReader& table, std::string_view key,
                                const std::vector<double>& sides) {
  const PaperBox box{sides[0], sides[1], sides[2], sides[3]};
  const bool near = std::all_of(sides.begin(), sides.end(),
                                [](double mm) { return std::fabs(mm) <= kFarthestMm; });
  if (!near || !(box.width() > 0 && box.height() > 0))
    reading_.fault(table.value(key)->at, "'" + std::string(key) + "' of [sheet] is no box of paper",
                   "write left, top, right, bottom, from the upper left corner of the sheet");
  return box;
}

void PaperReader::keep_free(TableReader& table) {
  const Value* const value = table.value("keep_free");
  if (value == nullptr) return;
  const std::string mend = "write keep_free = [[\"230mm\", \"240mm\", \"410mm\", \"287mm\"]]";
  const auto* const list = std::get_if<settings::Array>(&value->held);
  if (list == nullptr) {
    reading_.fault(value->at, "'keep_free' of [sheet] is no list of boxes", mend);
    return;
  }
  for (const Value& box : *list) {
    const auto* const sides = std::get_if<settings::Array>(&box.held);
    if (sides == nullptr || sides->size() != 4) {
      reading_.fault(box.at, "'keep_free' of [sheet] has something that is no box", mend);
      return;
    }
    std::vector<double> lengths;
    for (const Value& side : *sides)
      lengths.push_back(table.length_mm(side, "keep_free").value_or(0));
    found_.keep_free.push_back(paper_box(table, "keep_free", lengths));
  }
}

void PaperReader::artwork(TableReader& table) {
  const auto name = table.text("template");
  if (!name) return;
  const SourcePosition at = table.value("template")->at;
  const Result<std::string> text = read_template_(*name);
  if (!text) {
    const Error& error = text.error();
    reading_.fault(at, "the template '" + *name + "' " + error.message, error.mend);
    return;
  }
  Result<Template> parsed = parse_template(*text);
  if (!parsed) {
    Error error = parsed.error();
    error.where = *name + ", " + error.where + " (the template of " + reading_.file() + ")";
    reading_.fault(std::move(error));
    return;
  }
  found_.artwork = std::move(*parsed);
  found_.template_name = *name;
}

void PaperReader::size(TableReader& table) {
  const Value* const value = table.value("size");
  constexpr std::array<std::string_view, 2> kTextWays{"landscape", "portrait"};
  const auto orientation = table.word("orientation", kTextWays);
  const auto* const name = value != nullptr ? std::get_if<std::string>(&value->held) : nullptr;
  const bool standard = value == nullptr || name != nullptr;
  if (orientation && !standard)
    reading_.fault(table.at(), "'orientation' of [sheet] goes with the sizes A4 to A0",
                   "write the width before the height in size");
  if (value == nullptr && found_.artwork && !orientation) {
    take_size(found_.artwork->width_mm, found_.artwork->height_mm);
  } else if (standard) {
    named_size(table, name != nullptr ? *name : "A3", orientation == "portrait");
  } else if (const auto sides = table.lengths_mm("size", 2, "\"A3\", or [\"600mm\", \"300mm\"]")) {
    take_size((*sides)[0], (*sides)[1]);
  }
  const auto allowed = [](double mm) {
    return mm >= drawing::kMinPaperMm && mm <= drawing::kLargestPaperMm;
  };
  if (!allowed(found_.width_mm) || !allowed(found_.height_mm))
    reading_.fault(value != nullptr ? value->at : table.at(), "a sheet of " + found_.size + " mm",
                   "take 100mm to 20m");
  check_artwork(table);
}

void PaperReader::take_size(double width_mm, double height_mm) {
  const double width = drawing::rounded_paper(width_mm);
  const double height = drawing::rounded_paper(height_mm);
  found_.width_mm = width;
  found_.height_mm = height;
  found_.size = shortest(width) + " x " + shortest(height);
  for (const auto& [name, size] : drawing::kNamedPapers)
    if (std::max(width, height) == size.width_mm && std::min(width, height) == size.height_mm)
      found_.size = name;
}

void PaperReader::named_size(TableReader& table, const std::string& name, bool portrait) {
  for (const auto& [known, size] : drawing::kNamedPapers)
    if (known == name)
      return take_size(portrait ? size.height_mm : size.width_mm,
                       portrait ? size.width_mm : size.height_mm);
  reading_.fault(
      table.value("size")->at, "no sheet is called '" + name + "'",
      "write size = \"A4\", \"A3\", \"A2\", \"A1\" or \"A0\", or [\"600mm\", \"300mm\"]");
}

void PaperReader::check_artwork(TableReader& table) {
  if (!found_.artwork) return;
  const auto near = [](double a, double b) { return std::fabs(a - b) <= 0.5; };
  if (!near(found_.width_mm, found_.artwork->width_mm) ||
      !near(found_.height_mm, found_.artwork->height_mm))
    reading_.fault(table.at(),
                   "the template is " + shortest(found_.artwork->width_mm) + " x " +
                       shortest(found_.artwork->height_mm) + " mm, the sheet " +
                       shortest(found_.width_mm) + " x " + shortest(found_.height_mm),
                   "give the sheet the size of its template, or leave size out");
}

}  // namespace strake::sheets
