// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/project.hpp"

/// What is in a project, as lists for people and scripts.
namespace strake::project {

enum class ListKind : std::uint8_t { files, shapes, revisions, tests, runs, clashes, views };
/// How the command line and outputs spell them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 7> kListNames{
    "files", "shapes", "revisions", "tests", "runs", "clashes", "views"};

/// A value of a list; nothing: there is none.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Listing {
  std::vector<std::string> columns;  ///< names in snake_case
  std::vector<std::vector<Cell>> rows;
  std::uint64_t all = 0;  ///< rows that there are, shown or not
};

/// Returns the first rows of a list: files, tests and views by name, shapes by how many bodies have
/// them, revisions and runs the latest first, clashes the deepest first. `limit` 0: all rows.
/// Errors: input for a damaged project; cancelled.
[[nodiscard]] Result<Listing> list(Project& project, ListKind kind, std::uint64_t limit,
                                   const parallel::Context& context);

}  // namespace strake::project
