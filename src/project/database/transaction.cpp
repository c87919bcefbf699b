// SPDX-License-Identifier: Apache-2.0
#include <sqlite3.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "project/database/database.hpp"
#include "project/database/opening.hpp"

namespace strake::project {

Result<ReadScope> ReadScope::begin(Database& database) {
  if (sqlite3_get_autocommit(database.handle_) == 0) return ReadScope(nullptr);
  if (const Status begun = database.execute("BEGIN"); !begun) return begun.error();
  return ReadScope(&database);
}

ReadScope::~ReadScope() {
  if (database_ != nullptr && sqlite3_get_autocommit(database_->handle_) == 0)
    static_cast<void>(database_->execute("COMMIT"));
}

ReadScope::ReadScope(ReadScope&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)) {}

Result<Transaction> Transaction::begin(Database& database, int min_wait_ms) {
  if (database.access_ == Access::read) return database.error(SQLITE_READONLY);
  sqlite3_busy_timeout(database.handle_, std::max(database.wait_ms_, min_wait_ms));
  const Status begun = database.execute("BEGIN IMMEDIATE");
  sqlite3_busy_timeout(database.handle_, kRecoveryMs);
  if (!begun) return begun.error();
  return Transaction(database);
}

Error Database::busy() const { return error(SQLITE_BUSY); }

Result<std::optional<Transaction>> Transaction::begin_at_once(Database& database) {
  if (database.access_ == Access::read) return database.error(SQLITE_READONLY);
  sqlite3_busy_timeout(database.handle_, 0);
  const Status begun = database.execute("BEGIN IMMEDIATE");
  const bool is_busy = !begun && (sqlite3_errcode(database.handle_) & 0xff) == SQLITE_BUSY;
  sqlite3_busy_timeout(database.handle_, kRecoveryMs);
  if (is_busy) return std::optional<Transaction>();
  if (!begun) return begun.error();
  return std::optional(Transaction(database));
}

Transaction::~Transaction() {
  // Where a fault has ended it already, there is nothing to take back.
  if (database_ != nullptr && sqlite3_get_autocommit(database_->handle_) == 0)
    static_cast<void>(database_->execute("ROLLBACK"));
}

Transaction::Transaction(Transaction&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)) {}

Status Transaction::commit() {
  const Status committed = database_->execute("COMMIT");
  if (!committed) return committed.error();
  database_ = nullptr;
  return {};
}

}  // namespace strake::project
