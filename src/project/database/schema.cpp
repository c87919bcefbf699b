// SPDX-License-Identifier: Apache-2.0
#include "project/database/schema.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "project/database/exchange_tables.hpp"
#include "project/database/history_tables.hpp"
#include "project/database/map_and_drawing_tables.hpp"
#include "project/database/model_tables.hpp"
#include "project/database/opening.hpp"
#include "project/database/result_tables.hpp"
#include "project/database/revision_tables.hpp"
#include "project/database/snapshot_tables.hpp"
#include "project/database/view_tables.hpp"

namespace strake::project {
namespace {

/// A table, index, view or trigger: its kind, its name, the table it is of, and its SQL.
using SchemaEntry = std::tuple<std::string, std::string, std::string, std::string>;

/// Returns what the tables are, without what SQLite makes for itself: indices of UNIQUE, statistics
/// that somebody requested.
Result<std::vector<SchemaEntry>> schema_entries(Database& database) {
  Result<Statement> rows = database.prepare(
      "SELECT type, name, tbl_name, coalesce(sql, '') FROM sqlite_schema WHERE NOT (type = 'index' "
      "AND sql IS NULL) AND NOT (type = 'table' AND name IN ('sqlite_sequence', 'sqlite_stat1', "
      "'sqlite_stat4')) ORDER BY type, name");
  if (!rows) return rows.error();
  std::vector<SchemaEntry> entries;
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return row.error();
    if (!*row) return entries;
    entries.emplace_back(rows->text(0), rows->text(1), rows->text(2), rows->text(3));
  }
}

Result<std::unique_ptr<Database>> empty_tables() {
  Result<std::unique_ptr<Database>> database = Database::in_memory();
  if (!database) return database.error();
  // Values of many pages are common, and each page costs a look-up.
  const Status made = (*database)->execute(fmt::format(
      "PRAGMA page_size = 8192; PRAGMA application_id = {}; PRAGMA user_version = {};\n{}",
      kApplicationId, kSchemaVersion, all_tables()));
  if (!made) return made.error();
  return database;
}

}  // namespace

std::string all_tables() {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", kModelTables, kRevisionTables, kResultTables,
                     kViewTables, kHistoryTables, kExchangeTables, kSnapshotTables,
                     kMapAndDrawingTables);
}

std::span<const MigrationStep> migration_steps() {
  static constexpr std::array<MigrationStep, 4> kSteps{{{1, kHistoryTables},
                                                        {2, kExchangeTables},
                                                        {3, kSnapshotTables},
                                                        {4, kMapAndDrawingTables, kNameKeyIndex}}};
  return kSteps;
}

Result<std::int64_t> schema_version(Database& database) {
  Result<Statement> row = database.prepare("PRAGMA user_version");
  if (!row) return row.error();
  const Result<bool> found = row->step();
  if (!found) return found.error();
  return row->integer(0);
}

Status migrate(Database& database, std::int64_t to, std::span<const MigrationStep> steps) {
  // Whoever opens a project waits for another process that does the same for it.
  Result<Transaction> transaction = Transaction::begin(database, kRecoveryMs);
  if (!transaction) return transaction.error();
  // It is asked again: another process may have come first.
  Result<std::int64_t> version = schema_version(database);
  if (!version) return version.error();
  while (*version < to) {
    const MigrationStep* step = nullptr;
    for (const MigrationStep& one : steps)
      if (one.from == *version) step = &one;
    if (step == nullptr)
      return database.damaged(fmt::format("no version {} has ever been written", *version));
    if (const Status done = database.execute(step->statements); !done) return done.error();
    if (const Status done = database.rewrite_schema(step->rewriting); !done) return done.error();
    ++*version;
    const Status noted = database.execute(fmt::format("PRAGMA user_version = {}", *version));
    if (!noted) return noted.error();
  }
  return transaction->commit();
}

Status check_tables(Database& database) {
  const Result<std::unique_ptr<Database>> ours = empty_tables();
  if (!ours) return ours.error();
  const Result<std::vector<SchemaEntry>> expected = schema_entries(**ours);
  if (!expected) return expected.error();
  const Result<std::vector<SchemaEntry>> found = schema_entries(database);
  if (!found) return found.error();
  if (*found == *expected) return {};
  for (const SchemaEntry& entry : *found) {
    bool known = false;
    for (const SchemaEntry& one : *expected) known = known || one == entry;
    if (!known)
      return database.damaged(fmt::format("the {} '{}' is none that Strake makes",
                                          std::get<0>(entry), std::get<1>(entry)));
  }
  return database.damaged("tables are missing");
}

Result<std::string> empty_project() {
  const Result<std::unique_ptr<Database>> database = empty_tables();
  if (!database) return database.error();
  Result<std::string> bytes = (*database)->serialized();
  if (!bytes) return bytes;
  // What is in memory is never in WAL mode; these two bytes of the file's head put it there.
  constexpr std::size_t kWriteVersion = 18, kReadVersion = 19;
  constexpr char kWriteLog = 2;
  (*bytes)[kWriteVersion] = (*bytes)[kReadVersion] = kWriteLog;
  return bytes;
}

}  // namespace strake::project
