// SPDX-License-Identifier: Apache-2.0
#include "project/database/database.hpp"

#include <sqlite3.h>

#include <cerrno>
#include <memory>
#include <string>
#include <utility>

#include "project/database/file_facts.hpp"

namespace strake::project {
namespace {

/// The message for a code of SQLite.
struct Meaning {
  ErrorCode code = ErrorCode::internal;
  std::string message, mend;
};

/// `reason` is what the system said of a fault of input or output.
Meaning meaning_of(int code, int reason) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::output, "another program writes to the project",
              "try again when it is done, or wait for it (--wait SECONDS)"};
    case SQLITE_FULL:
      return {ErrorCode::output, "cannot be written: no space left on device",
              "make room or choose another disk; what was stored before is whole"};
    case SQLITE_READONLY:
      return {ErrorCode::output, "cannot be written: it, its folder or its disk is read-only",
              "copy it to where you may write"};
    case SQLITE_CANTOPEN:
      return {ErrorCode::output, "cannot be opened for writing beside itself (-wal, -shm)",
              "choose a folder you may write to"};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {ErrorCode::input, "is damaged",
              "take a copy of the project, or make it anew of its model files"};
    case SQLITE_NOMEM:
      return {ErrorCode::memory, out_of_memory().message, out_of_memory().mend};
    case SQLITE_TOOBIG:
      return {ErrorCode::output, "cannot hold a single value of more than a gigabyte",
              "split the model into files"};
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return {ErrorCode::input, "cannot be read: permission denied", "check the permissions"};
    case SQLITE_IOERR:
      if (reason == EFBIG)
        return {ErrorCode::output, "cannot be written: File too large",
                "raise the limit on the size of files (ulimit -f), or choose a disk that takes "
                "larger ones; what was stored before is whole"};
      return {ErrorCode::output, "cannot be read or written: the disk reports an error",
              "check the disk; what was stored before is whole"};
    default:
      return {};
  }
}

}  // namespace

Database::~Database() {
  if (handle_ != nullptr) sqlite3_close_v2(handle_);
}

Error Database::error(int code) const {
  // SQLite remembers no reason for a COMMIT that fails, after which nothing else has failed yet.
  const int last = errno;
  const int kept = handle_ != nullptr ? sqlite3_system_errno(handle_) : 0;
  Meaning meaning = meaning_of(code, kept != 0 ? kept : last);
  if (meaning.message.empty()) {
    meaning.message = "the database refuses: ";
    meaning.message += handle_ != nullptr ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
  }
  return {meaning.code, std::move(meaning.message), file_.string(), std::move(meaning.mend)};
}

Error Database::damaged(std::string_view what) const {
  Meaning meaning = meaning_of(SQLITE_CORRUPT, 0);
  meaning.message += ": ";
  meaning.message += what;
  return {meaning.code, std::move(meaning.message), file_.string(), std::move(meaning.mend)};
}

Result<Statement> Database::prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v2(handle_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  if (code != SQLITE_OK) return error(code);
  return Statement(*this, statement);
}

Status Database::execute(std::string_view sql) {
  const int code = sqlite3_exec(handle_, std::string(sql).c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return error(code);
  return {};
}

Status Database::rewrite_schema(std::string_view sql) {
  if (sql.empty()) return {};
  int was_defensive = 0;
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, -1, &was_defensive);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
  Status done = execute("PRAGMA writable_schema = ON");
  if (done) done = execute(sql);
  // What this connection knows of tables is read again.
  const Status ended = execute("PRAGMA writable_schema = RESET");
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, was_defensive, nullptr);
  return done ? ended : done;
}

std::int64_t Database::last_insert_id() const { return sqlite3_last_insert_rowid(handle_); }
std::int64_t Database::changes() const { return sqlite3_changes64(handle_); }

Result<std::unique_ptr<Database>> Database::in_memory() {
  std::unique_ptr<Database> database(new Database());
  const int code = sqlite3_open_v2(":memory:", &database->handle_,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) return database->error(code);
  return database;
}

Result<std::string> Database::serialized() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      sqlite3_serialize(handle_, "main", &size, 0), &sqlite3_free);
  if (bytes == nullptr) return out_of_memory();
  return std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size));
}

Status Database::check_unchanged() const {
  if (!immutable_ || size_and_time(file_) == immutable_) return {};
  return Error{ErrorCode::input, "was written to while it was read", file_.string(), "try again"};
}

Status Database::check_in_place() {
  int has_moved = 0;
  // A database in memory knows of no such question, and lies nowhere.
  const int code = sqlite3_file_control(handle_, "main", SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (code != SQLITE_OK || has_moved == 0) return {};
  return Error{ErrorCode::output, "was moved, deleted or replaced while it was open",
               file_.string(), "end this program, and start it on the project that is there now"};
}

Status Database::check_end() {
  const auto file = size_and_time(file_);
  if (!file) return {};
  // A page that a writer is putting into the file is in the write log still, which stays for as
  // long as this connection is open: it is looked at last.
  const auto log = size_and_time(sqlite3_filename_wal(sqlite3_db_filename(handle_, "main")));
  if (log && log->first > 0) return {};
  Result<Statement> page_size = prepare("PRAGMA page_size");
  if (!page_size) return page_size.error();
  const Result<bool> row = page_size->step();
  if (!row) return row.error();
  if (!*row || file->first % page_size->integer(0) == 0) return {};
  return damaged("its last page is cut off");
}

Result<std::vector<std::vector<std::byte>>> read_parts(Database& database, const char* table,
                                                       std::int64_t test, const std::string& what) {
  Result<Statement> select = database.prepare(std::string("SELECT part, data FROM ") + table +
                                              " WHERE test = ?1 ORDER BY part");
  if (!select) return select.error();
  select->bind(1, test);
  std::vector<std::vector<std::byte>> parts;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return parts;
    if (select->integer(0) != static_cast<std::int64_t>(parts.size()))
      return database.damaged("a part of " + what + " is missing");
    const std::span<const std::byte> data = select->bytes(1);
    parts.emplace_back(data.begin(), data.end());
  }
}

}  // namespace strake::project
