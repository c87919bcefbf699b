// SPDX-License-Identifier: Apache-2.0
#include "settings/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/text_encoding.hpp"
#include "core/units.hpp"

namespace strake::settings {
namespace {

std::string_view type_name(const Value& value) {
  struct Name {
    std::string_view operator()(const std::string&) const { return "a text"; }
    std::string_view operator()(std::int64_t) const { return "a whole number"; }
    std::string_view operator()(double) const { return "a number"; }
    std::string_view operator()(bool) const { return "true or false"; }
    std::string_view operator()(const DateTime&) const { return "a date or time"; }
    std::string_view operator()(const Array&) const { return "a list"; }
    std::string_view operator()(const Table&) const { return "a table"; }
  };
  return std::visit(Name{}, value.held);
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

/// Returns what a key of a table is written behind: "unit_groups." for "[unit_groups]".
std::string within(std::string_view table) {
  const std::size_t first = table.find_first_not_of('['), end = table.find(']');
  if (!table.starts_with('[') || end == std::string_view::npos) return {};
  return std::string(table.substr(first, end - first)) + ".";
}

}  // namespace

TableReader::TableReader(ParseContext& reading, const Value& table, std::string what)
    : reading_(reading),
      table_(std::get_if<Table>(&table.held)),
      at_(table.at),
      what_(std::move(what)) {
  if (table_ != nullptr)
    read_keys_.assign(table_->size(), false);
  else
    reading.fault(at_, what_ + " is " + std::string(type_name(table)) + ", not a table",
                  "write " + what_ + " on a line of its own and its keys below");
}

void TableReader::refuse_other_keys() {
  for (std::size_t k = 0; k < read_keys_.size(); ++k)
    if (!read_keys_[k])
      reading_.fault((*table_)[k].at, what_ + " has no key " + in_quotes((*table_)[k].key),
                     "its keys are " + listed(known_));
}

const Value* TableReader::value(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  for (std::size_t k = 0; k < read_keys_.size(); ++k)
    if ((*table_)[k].key == key) {
      read_keys_[k] = true;
      return &(*table_)[k].value;
    }
  return nullptr;
}

std::vector<const KeyValue*> TableReader::others() {
  std::vector<const KeyValue*> entries;
  for (std::size_t k = 0; k < read_keys_.size(); ++k) {
    if (!read_keys_[k]) entries.push_back(&(*table_)[k]);
    read_keys_[k] = true;
  }
  return entries;
}

void TableReader::wrong_type(const Value& value, std::string_view key, std::string_view wanted) {
  reading_.fault(value.at,
                 in_quotes(key) + " of " + what_ + " is " + std::string(type_name(value)) +
                     ", not " + std::string(wanted),
                 "write " + std::string(key) + " = " + std::string(wanted));
}

template <class T>
const T* TableReader::held(std::string_view key, std::string_view wanted) {
  const Value* const found = value(key);
  if (found == nullptr) return nullptr;
  const T* const of_type = std::get_if<T>(&found->held);
  if (of_type == nullptr) wrong_type(*found, key, wanted);
  return of_type;
}

std::optional<std::string> TableReader::text(std::string_view key) {
  const auto* const found = held<std::string>(key, "a text in quotes");
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

std::optional<bool> TableReader::flag(std::string_view key) {
  const bool* const found = held<bool>(key, "true or false");
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

std::optional<std::int64_t> TableReader::whole(std::string_view key) {
  const std::int64_t* const found = held<std::int64_t>(key, "a whole number");
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

std::optional<double> TableReader::length_mm(const Value& value, std::string_view key) {
  return parsed_mm(value, key, parse_length_mm);
}

std::optional<double> TableReader::coordinate_mm(const Value& value, std::string_view key) {
  if (const auto* const whole = std::get_if<std::int64_t>(&value.held))
    return static_cast<double>(*whole);
  if (const auto* const number = std::get_if<double>(&value.held);
      number != nullptr && std::isfinite(*number))
    return *number;
  return parsed_mm(value, key, parse_coordinate_mm);
}

std::optional<double> TableReader::parsed_mm(const Value& value, std::string_view key,
                                             Result<double> (*parse)(std::string_view)) {
  const auto* const zero = std::get_if<std::int64_t>(&value.held);
  if (zero != nullptr && *zero == 0) return 0.0;
  const auto* const text = std::get_if<std::string>(&value.held);
  if (text == nullptr) {
    wrong_type(value, key, "a length with its unit in quotes, as \"25mm\"");
    return std::nullopt;
  }
  const Result<double> length = parse(*text);
  if (length) return *length;
  reading_.fault(value.at, in_quotes(key) + " of " + what_ + ": " + length.error().message,
                 length.error().mend);
  return std::nullopt;
}

std::optional<double> TableReader::quantity(std::string_view key,
                                            Result<double> (*parse)(std::string_view),
                                            std::string_view wanted) {
  const Value* const found = value(key);
  if (found == nullptr) return std::nullopt;
  const auto* const text = std::get_if<std::string>(&found->held);
  if (text == nullptr) {
    wrong_type(*found, key, wanted);
    return std::nullopt;
  }
  const Result<double> quantity = parse(*text);
  if (quantity) return *quantity;
  reading_.fault(found->at, in_quotes(key) + " of " + what_ + ": " + quantity.error().message,
                 quantity.error().mend);
  return std::nullopt;
}

std::optional<double> TableReader::volume_mm3(std::string_view key) {
  const Value* const found = value(key);
  const auto* const zero = found != nullptr ? std::get_if<std::int64_t>(&found->held) : nullptr;
  if (zero != nullptr && *zero == 0) return 0.0;
  return quantity(key, parse_volume_mm3, "a volume with its unit in quotes, as \"5cm3\"");
}

std::optional<std::vector<double>> TableReader::lengths_mm(std::string_view key, std::size_t count,
                                                           std::string_view wanted) {
  const Value* const found = value(key);
  if (found == nullptr) return std::nullopt;
  const auto* const list = std::get_if<Array>(&found->held);
  if (list == nullptr || list->size() != count) {
    reading_.fault(found->at,
                   in_quotes(key) + " of " + what_ + " is no list of " + std::to_string(count),
                   "write " + std::string(key) + " = " + std::string(wanted));
    return std::nullopt;
  }
  std::vector<double> lengths;
  for (const Value& one : *list) {
    const auto length = length_mm(one, key);
    if (!length) return std::nullopt;
    lengths.push_back(*length);
  }
  return lengths;
}

std::optional<double> TableReader::tolerance_mm(std::string_view key) {
  const Value* const found = value(key);
  return found != nullptr ? parsed_mm(*found, key, parse_distance_mm) : std::nullopt;
}

std::optional<std::string> TableReader::word(std::string_view key,
                                             std::span<const std::string_view> words) {
  const Value* const found = value(key);
  if (found == nullptr) return std::nullopt;
  const auto* const text = std::get_if<std::string>(&found->held);
  if (text != nullptr && std::find(words.begin(), words.end(), *text) != words.end()) return *text;
  std::vector<std::string> choices;
  for (const std::string_view word : words) choices.push_back("\"" + std::string(word) + "\"");
  reading_.fault(found->at,
                 in_quotes(key) + " of " + what_ + " is " +
                     (text != nullptr ? in_quotes(*text) : std::string(type_name(*found))),
                 "write one of " + listed(choices));
  return std::nullopt;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
  const Value* const found = value(key);
  if (found == nullptr) return {};
  if (const auto* const one = std::get_if<std::string>(&found->held)) return {*one};
  std::vector<std::string> all;
  const auto* const list = std::get_if<Array>(&found->held);
  if (list == nullptr) wrong_type(*found, key, "a text in quotes, or a list of them");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const auto* const one = std::get_if<std::string>(&(*list)[i].held);
    if (one != nullptr)
      all.push_back(*one);
    else
      wrong_type((*list)[i], key, "a list of texts in quotes");
  }
  return all;
}

const Array* TableReader::three(std::string_view key) {
  const Value* const found = value(key);
  if (found == nullptr) return nullptr;
  const auto* const list = std::get_if<Array>(&found->held);
  if (list != nullptr && list->size() == 3) return list;
  reading_.fault(found->at, in_quotes(key) + " of " + what_ + " is no list of three",
                 "write " + std::string(key) + " = [x, y, z]");
  return nullptr;
}

std::optional<geometry::Vec3d> TableReader::point_mm(std::string_view key) {
  const Array* const list = three(key);
  if (list == nullptr) return std::nullopt;
  geometry::Vec3d point;
  for (int k = 0; k < 3; ++k) {
    const auto coordinate = coordinate_mm((*list)[static_cast<std::size_t>(k)], key);
    if (!coordinate) return std::nullopt;
    point[k] = *coordinate;
  }
  return point;
}

std::optional<geometry::Vec3d> TableReader::direction(std::string_view key) {
  const Array* const list = three(key);
  if (list == nullptr) return std::nullopt;
  geometry::Vec3d way;
  for (int k = 0; k < 3; ++k) {
    const Value& value = (*list)[static_cast<std::size_t>(k)];
    const auto* const whole = std::get_if<std::int64_t>(&value.held);
    const auto* const number = std::get_if<double>(&value.held);
    if (whole == nullptr && number == nullptr) {
      wrong_type(value, key, "a list of three numbers");
      return std::nullopt;
    }
    if (number != nullptr && !std::isfinite(*number)) {
      reading_.fault(value.at, in_quotes(key) + " of " + what_ + " has a number that is not finite",
                     "write a list of three numbers, as [0, 0, 1]");
      return std::nullopt;
    }
    way[k] = whole != nullptr ? static_cast<double>(*whole) : *number;
  }
  const double longest = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  // A subnormal number has too few digits left to scale it.
  if (std::isnormal(longest)) return way * (1 / longest);
  reading_.fault(value(key)->at, in_quotes(key) + " of " + what_ + " has no direction",
                 "write a list with a number that is not 0, as [0, 0, 1]");
  return std::nullopt;
}

const Value* TableReader::table(std::string_view key) {
  const Value* const found = value(key);
  if (found == nullptr || std::holds_alternative<Table>(found->held)) return found;
  reading_.fault(
      found->at,
      "'" + std::string(key) + "' is " + std::string(type_name(*found)) + ", not a table",
      "write [" + within(what_) + std::string(key) + "] with single brackets, and its keys below");
  return nullptr;
}

std::vector<const Value*> TableReader::tables(std::string_view key) {
  const Value* const found = value(key);
  if (found == nullptr) return {};
  const auto* const list = std::get_if<Array>(&found->held);
  std::vector<const Value*> all;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) all.push_back(&(*list)[i]);
  const bool tables = std::all_of(all.begin(), all.end(), [](const Value* v) {
    return std::holds_alternative<Table>(v->held);
  });
  if (list != nullptr && tables) return all;
  reading_.fault(found->at, in_quotes(key) + " is not a list of tables",
                 "write [[" + within(what_) + std::string(key) +
                     "]] with double brackets, and its keys below");
  return {};
}

std::string TableReader::required_text(std::string_view key) {
  const auto found = text(key);
  if (found && !found->empty()) return *found;
  const bool there = found.has_value();
  reading_.fault(at_, what_ + (there ? " has an empty " : " has no ") + in_quotes(key),
                 "write " + std::string(key) + " = \"...\"");
  return {};
}

}  // namespace strake::settings
