// SPDX-License-Identifier: Apache-2.0
#include "sheets/parse/style_reader.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

using settings::ParseContext;
using settings::TableReader;
using settings::Value;

namespace {

/// Reads a text of a table by a function of drawings.
template <class T>
std::optional<T> parsed(ParseContext& reading, TableReader& table, std::string_view key,
                        Result<T> (*parse)(std::string_view)) {
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  const Result<T> value = parse(*text);
  if (value) return *value;
  reading.fault(table.value(key)->at,
                "'" + std::string(key) + "' of " + table.what() + ": " + value.error().message,
                value.error().mend);
  return std::nullopt;
}

/// Reads the type of a line: a word, or a list of lengths as [styles] has.
std::optional<drawing::LineType> line_type(ParseContext& reading, TableReader& table) {
  const Value* const value = table.value("line");
  const auto* const list = value != nullptr ? std::get_if<settings::Array>(&value->held) : nullptr;
  if (list == nullptr) return parsed(reading, table, "line", drawing::parse_line_type);
  if (list->empty()) return drawing::LineType{};
  std::string lengths;
  for (const Value& one : *list) {
    const auto* const length = std::get_if<std::string>(&one.held);
    lengths += (lengths.empty() ? "" : " ") + (length != nullptr ? *length : std::string("?"));
  }
  const auto line = drawing::parse_line_type(lengths);
  if (line && !line->in_widths) return *line;
  reading.fault(value->at, "'line' of " + table.what() + " is no list of dashes and gaps",
                "write line = [\"3mm\", \"1mm\"], or line = \"dashed\"");
  return std::nullopt;
}

}  // namespace

ObjectStyleSpec read_object_style(ParseContext& reading, settings::NamedSets& sets,
                                  const Value& value) {
  TableReader table(reading, value, "[[style]]");
  ObjectStyleSpec spec;
  spec.where = reading.file() + ", line " + std::to_string(value.at.line) + ": [[style]]";
  spec.style.name = on_one_line(table.text("name").value_or(""));
  if (!spec.style.name.empty()) table.call(spec.style.name);
  spec.select = sets.required(table, "select");
  spec.style.color = parsed(reading, table, "color", drawing::parse_color);
  spec.style.pen_mm = parsed(reading, table, "pen", drawing::parse_pen_mm);
  spec.style.line = line_type(reading, table);
  return spec;
}

}  // namespace strake::sheets
