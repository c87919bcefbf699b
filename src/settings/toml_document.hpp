// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::settings {

/// Where something stands in a file, from 1; columns in bytes.
struct SourcePosition {
  std::uint32_t line = 0, column = 0;
};

struct Value;

/// A key of a table and what it is set to.
struct KeyValue;

using Array = std::vector<Value>;
using Table = std::vector<KeyValue>;  ///< in the order of the file

/// A date or a time: known to the format, of no use here.
struct DateTime {};

struct Value {
  SourcePosition at;
  std::variant<std::string, std::int64_t, double, bool, DateTime, Array, Table> held;
};

struct KeyValue {
  std::string key;
  SourcePosition at;
  Value value;
};

/// An error about a place of a file.
[[nodiscard]] Error fault_at(std::string_view file, SourcePosition at, std::string message,
                             std::string mend);

/// The text of a TOML 1.0 file; the value is a Table. Errors (input) name file, line and column.
[[nodiscard]] Result<Value> parse_toml(std::string_view text, std::string_view file);

/// Where a TOML text has a dotted key of more than `most` parts, as a.b.c has three. Each part is a
/// table within a table, and the parser, which limits the nesting of values, takes a key of any
/// depth and ends with the stack. Of a text that is no TOML this looks at the part before the first
/// fault at least, which is as far as the parser gets.
[[nodiscard]] std::optional<SourcePosition> first_deep_key(std::string_view text, std::size_t most);

}  // namespace strake::settings
