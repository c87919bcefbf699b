// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace strake::report {

// These functions write what the JSON documents of this layer have in common.

/// Appends `"name": `.
void append_key(std::string& out, std::string_view name);

/// Appends the members that name an object: id, name and file.
void append_identity(std::string& out, std::string_view id, std::string_view name,
                     std::string_view file);

/// Appends the member `counts` of results by class, and of those that a rule allows where they are
/// given.
void append_counts(std::string& out, std::uint64_t hit, std::uint64_t contact,
                   std::uint64_t clearance_violation, std::optional<std::uint64_t> allowed = {});

/// Appends the member `name`, a list: write(item) appends each item. `line` comes before each item
/// where each begins a line.
template <class Items, class Write>
void append_list(std::string& out, std::string_view name, const Items& items, const Write& write,
                 std::string_view line = {}) {
  append_key(out, name);
  out += '[';
  bool first = true;
  for (const auto& item : items) {
    if (!first) out += line.empty() ? ", " : ",";
    first = false;
    out += line;
    write(item);
  }
  out += ']';
}

}  // namespace strake::report
