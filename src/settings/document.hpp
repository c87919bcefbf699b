// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::settings {

/// Where something stands in a file, from 1; columns in bytes.
struct Place {
  std::uint32_t line = 0, column = 0;
};

struct Value;

/// A key of a table and what it is set to.
struct Entry;

using Array = std::vector<Value>;
using Table = std::vector<Entry>;  ///< in the order of the file

/// A date or a time: known to the format, of no use here.
struct Moment {};

struct Value {
  Place at;
  std::variant<std::string, std::int64_t, double, bool, Moment, Array, Table> held;
};

struct Entry {
  std::string key;
  Place at;
  Value value;
};

/// An error about a place of a file.
[[nodiscard]] Error fault_at(std::string_view file, Place at, std::string message,
                             std::string mend);

/// The text of a TOML 1.0 file; the value is a Table. Errors (input) name file, line and column.
[[nodiscard]] Result<Value> read_document(std::string_view text, std::string_view file);

}  // namespace strake::settings
