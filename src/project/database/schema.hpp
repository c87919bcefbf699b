// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"

/// The tables of a project, and how those of earlier versions become them.
namespace strake::project {

inline constexpr std::uint32_t kApplicationId = 0x5354524B;  ///< "STRK"
/// The version of the tables; every change of them is a new one, with a step that leads there.
inline constexpr std::int64_t kSchemaVersion = 5;

/// Returns the statements that make all tables.
[[nodiscard]] std::string all_tables();

/// Statements that make version `from + 1` of version `from`.
struct MigrationStep {
  std::int64_t from = 0;
  const char* statements = "";
  /// Statements that write into the table of tables itself, after those above, which tell other
  /// connections that tables have changed.
  const char* rewriting = "";
};

/// Returns the steps from the first version to this one.
[[nodiscard]] std::span<const MigrationStep> migration_steps();

/// Brings the tables to version `to`, in one transaction, for which it waits up to kRecoveryMs
/// where another process writes. Errors: those of the database; input for a version that no step
/// starts from.
[[nodiscard]] Status migrate(Database& database, std::int64_t to,
                             std::span<const MigrationStep> steps);

[[nodiscard]] Result<std::int64_t> schema_version(Database& database);

/// Whether the tables, indices, views and triggers are those of this version, word for word, and no
/// others: statements are only safe to run on tables that we have made. Errors: input.
[[nodiscard]] Status check_tables(Database& database);

/// Returns the bytes of a project without anything in it.
[[nodiscard]] Result<std::string> empty_project();

}  // namespace strake::project
