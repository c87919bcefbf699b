// SPDX-License-Identifier: Apache-2.0
// The one source that includes toml++, which is large: everything else sees plain values.
#include "rules/document.hpp"

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace strake::rules {
namespace {

Place place_of(const toml::source_region& region) {
  return {region.begin.line, region.begin.column};
}

Value value_of(const toml::node& node);

Table table_of(const toml::table& table) {
  Table entries;
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), place_of(key.source()), value_of(node)});
  // The parser keeps keys by name.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
    return std::tie(x.at.line, x.at.column) < std::tie(y.at.line, y.at.column);
  });
  return entries;
}

Value value_of(const toml::node& node) {
  Value value{place_of(node.source()), Moment{}};
  if (const auto* const text = node.as_string())
    value.held = text->get();
  else if (const auto* const whole = node.as_integer())
    value.held = whole->get();
  else if (const auto* const number = node.as_floating_point())
    value.held = number->get();
  else if (const auto* const flag = node.as_boolean())
    value.held = flag->get();
  else if (const auto* const table = node.as_table())
    value.held = table_of(*table);
  else if (const auto* const array = node.as_array()) {
    Array values;
    for (const toml::node& inner : *array) values.push_back(value_of(inner));
    value.held = std::move(values);
  }
  return value;
}

}  // namespace

Error fault_at(std::string_view file, Place at, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message),
          std::string(file) + ", line " + std::to_string(at.line) + ", column " +
              std::to_string(at.column),
          std::move(mend)};
}

Result<Value> read_document(std::string_view text, std::string_view file) {
  const toml::parse_result parsed = toml::parse(text);
  if (parsed) return value_of(parsed.table());
  const toml::parse_error& error = parsed.error();
  return fault_at(file, place_of(error.source()), std::string(error.description()),
                  "the file is TOML: [tables], key = \"text\", key = [lists]");
}

}  // namespace strake::rules
