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

/// Values of a TOML file with their positions, and the parser that reads them.
namespace strake::settings {

/// A position in a file, counted from 1; columns in bytes.
struct SourcePosition {
  std::uint32_t line = 0, column = 0;
};

struct Value;

/// A key of a table and its value.
struct KeyValue;

using Array = std::vector<Value>;
using Table = std::vector<KeyValue>;  ///< in the order of the file

/// A date or a time, which the format knows but no file uses here.
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

/// Returns an error about a position in a file.
[[nodiscard]] Error fault_at(std::string_view file, SourcePosition at, std::string message,
                             std::string mend);

/// Parses the text of a TOML 1.0 file; the value is a Table. Errors (input) name file, line and
/// column.
[[nodiscard]] Result<Value> parse_toml(std::string_view text, std::string_view file);

/// Returns the position of a dotted key of more than `limit` parts, as a.b.c has three. Each part
/// is a table within a table, and the parser, which limits the nesting of values, takes a key of
/// any depth and overflows the stack. Of a text that is no TOML this checks the part before the
/// first fault at least, which is as far as the parser gets.
[[nodiscard]] std::optional<SourcePosition> first_deep_key(std::string_view text,
                                                           std::size_t limit);

}  // namespace strake::settings
