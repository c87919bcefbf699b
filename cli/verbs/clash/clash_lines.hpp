// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/verbs/clash/clash_groups.hpp"
#include "project/results/clash_queries.hpp"

namespace strake::cli {

/// What a project remembers of clashes, in rows and columns.
class ClashLines {
 public:
  /// A cell: nothing, a text, a whole number, or millimetres or seconds.
  using Cell = std::variant<std::monostate, std::string, std::int64_t, double>;

  std::string_view kind;  ///< "clashes", "runs" or "events"
  std::vector<std::string_view> columns;
  std::vector<std::size_t> shown;  ///< columns of the table
  std::vector<std::vector<Cell>> rows;

  [[nodiscard]] std::string csv() const;
  [[nodiscard]] std::string json() const;
  [[nodiscard]] std::string table() const;
};

/// With the groups, if there are any, each clash has the number and the key of its own.
[[nodiscard]] ClashLines lines_of(const std::vector<project::ListedClash>& clashes,
                                  const std::vector<ProjectGroup>* groups = nullptr);
[[nodiscard]] ClashLines lines_of(const std::vector<project::TrendRow>& runs);
[[nodiscard]] ClashLines lines_of(const std::vector<project::ClashEvent>& events);

}  // namespace strake::cli
