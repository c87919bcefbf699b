// SPDX-License-Identifier: Apache-2.0
#include "project/database/opening.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "project/database/file_facts.hpp"
#include "project/database/schema.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;

fs::path beside(const fs::path& file, const char* ending) {
  fs::path other = resolve_links(file);
  other += ending;
  return other;
}

/// Returns the head of a file that looks like a project, before SQLite has to do with it.
Result<FileHead> project_head(const fs::path& file) {
  const auto head = read_head(file);
  if (!head)
    return Error{ErrorCode::input,
                 "cannot be read: " + std::error_code(errno, std::generic_category()).message(),
                 file.string(), "check the path and the permissions"};
  if (!head->is_project)
    return Error{ErrorCode::input,
                 head->is_database ? "is a database of another program" : "is no project",
                 file.string(), "make one: strake project new"};
  // A journal of the older kind can name other files, which SQLite would delete. None is ours.
  std::error_code failed;
  if (fs::exists(beside(file, "-journal"), failed))
    return Error{ErrorCode::input, "is damaged: projects are in WAL mode, without a -journal",
                 file.string(), "take a copy of the project, or make it anew of its model files"};
  return *head;
}

/// Returns a name by which SQLite opens a file as if nobody wrote to it.
std::string immutable_name(const fs::path& file) {
  std::string name = "file:";
  for (const char c : fs::absolute(file).string()) {
    if (c == '%' || c == '?' || c == '#')
      name += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      name += c;
  }
  return name + "?immutable=1";
}

/// Whether a code says that the write log cannot be made, for want of rights.
bool needs_a_folder_to_write(int code) {
  return (code & 0xff) == SQLITE_CANTOPEN || (code & 0xff) == SQLITE_READONLY;
}

/// Whether opening the database, whose file may only be read, would leave a write log or its index
/// beside it: SQLite makes both, owned by whoever reads, and cannot take them away again.
bool would_leave_files(sqlite3* handle, const fs::path& file) {
  std::error_code failed;
  return sqlite3_db_readonly(handle, "main") == 1 &&
         !(fs::exists(beside(file, "-wal"), failed) && fs::exists(beside(file, "-shm"), failed));
}

/// Makes the connection safe with tables of which nothing is known.
void distrust(sqlite3* handle) {
  struct Setting {
    int what, value;
  };
  constexpr std::array<Setting, 6> kSettings{{{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                              {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                              {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0},
                                              {SQLITE_DBCONFIG_DQS_DML, 0},
                                              {SQLITE_DBCONFIG_DQS_DDL, 0},
                                              {SQLITE_DBCONFIG_ENABLE_FKEY, 1}}};
  for (const Setting& setting : kSettings)
    sqlite3_db_config(handle, setting.what, setting.value, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
}

int run_plain(sqlite3* handle, const char* sql) {
  return sqlite3_exec(handle, sql, nullptr, nullptr, nullptr);
}

}  // namespace

/// The steps to an open database.
class Opening {
 public:
  Opening(const fs::path& file, const OpenOptions& options) : file_(file), options_(options) {}

  Result<std::unique_ptr<Database>> run() {
    const Result<FileHead> head = project_head(file_);
    if (!head) return head.error();
    if (!head->has_write_log)
      if (const Status status = take_write_log(); !status && options_.access == Access::write)
        return status.error();
    Result<std::unique_ptr<Database>> database = connect(options_.access);
    if (!database) return database;
    const Result<bool> older = is_older(**database);
    if (!older) return older.error();
    if (*older) {
      database = connect(Access::write);
      if (!database) return database;
      const Status migrated = migrate(**database, kSchemaVersion, migration_steps());
      if (!migrated) return migrated.error();
      database = connect(options_.access);
      if (!database) return database;
    }
    if (const Status safe = check_tables(**database); !safe) return safe.error();
    if (const Status ready = settle(**database); !ready) return ready.error();
    return database;
  }

 private:
  /// Puts a file into WAL mode: VACUUM INTO of SQLite copies all of a project but that. A reader
  /// does so, too, where it may: a writer beside it could not, and it itself needs it only then.
  Status take_write_log() {
    const Result<std::unique_ptr<Database>> database = connect(Access::write);
    if (!database) return database.error();
    // The few bytes that change lie in one page: with a journal in memory there is never one beside
    // the file.
    if (const Status set = (*database)->execute("PRAGMA journal_mode = MEMORY"); !set) return set;
    Result<Statement> mode = (*database)->prepare("PRAGMA journal_mode = WAL");
    if (!mode) return mode.error();
    const Result<bool> there = mode->step();
    if (!there) return there.error();
    if (!*there || mode->text(0) != "wal") return (*database)->error(SQLITE_BUSY);
    return {};
  }

  Result<std::unique_ptr<Database>> connect(Access access) {
    std::unique_ptr<Database> database(new Database());
    int code = connect(*database, access, SQLITE_OPEN_READWRITE);
    if (access == Access::read && needs_a_folder_to_write(code)) {
      const auto log = size_and_time(beside(file_, "-wal"));
      if (log && log->first > 0)
        return Error{ErrorCode::input,
                     "was not closed, and what was written last cannot be read where nothing may "
                     "be written",
                     file_.string(),
                     "copy it with the file of its name and -wal to a folder you may write to"};
      database.reset(new Database());
      database->immutable_ = size_and_time(file_);
      code = connect(*database, access, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    }
    if (code != SQLITE_OK) return database->error(code);
    if (access == Access::write && sqlite3_db_readonly(database->handle_, "main") != 0)
      return database->error(SQLITE_READONLY);
    return database;
  }

  /// A reader opens for writing, too, where it may: only then does SQLite put the write log into
  /// the file, and take it away, when the reader is the last to close. Tables it does not change.
  int connect(Database& database, Access access, int mode) {
    database.file_ = file_;
    database.access_ = access;
    database.wait_ms_ = static_cast<int>(std::clamp(options_.wait_s, 0.0, 1e6) * 1000);
    const int flags = mode | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_PRIVATECACHE | SQLITE_OPEN_EXRESCODE;
    const bool is_immutable = (mode & SQLITE_OPEN_URI) != 0;
    const std::string name = is_immutable ? immutable_name(file_) : fs::absolute(file_).string();
    int code = sqlite3_open_v2(name.c_str(), &database.handle_, flags, nullptr);
    if (code != SQLITE_OK) return code;
    distrust(database.handle_);
    if (!is_immutable && would_leave_files(database.handle_, file_)) return SQLITE_READONLY;
    sqlite3_busy_timeout(database.handle_, kRecoveryMs);
    // A file that is mapped and shortened by somebody would end this program.
    code = run_plain(database.handle_,
                     "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA temp_store = 2;"
                     "SELECT count(*) FROM sqlite_schema");
    if (code != SQLITE_OK) return code;
    if (access == Access::read) return run_plain(database.handle_, "PRAGMA query_only = ON");
    // Keys of clashes come in no order: the first run of a million objects writes the pages of
    // their index, 70 MB, again and again where they have no room. Only what is used is taken.
    return run_plain(database.handle_,
                     "PRAGMA synchronous = FULL; PRAGMA cache_size = -262144;"
                     "PRAGMA journal_size_limit = 67108864");
  }

  Result<bool> is_older(Database& database) {
    const Result<std::int64_t> version = schema_version(database);
    if (!version) return version.error();
    if (*version > kSchemaVersion)
      return Error{ErrorCode::input,
                   fmt::format("is of a newer Strake: version {} of its tables, and this program "
                               "knows {}",
                               *version, kSchemaVersion),
                   file_.string(), "update Strake"};
    return *version < kSchemaVersion;
  }

  /// A reader sees one state of the project as long as it is open; a writer gets at once the error
  /// that another one is at work.
  Status settle(Database& database) {
    if (options_.access == Access::read)
      return database.execute("BEGIN; SELECT count(*) FROM sqlite_schema");
    Result<Transaction> probe = Transaction::begin(database);
    if (!probe) return probe.error();
    return probe->commit();
  }

  const fs::path& file_;
  const OpenOptions& options_;
};

Result<std::unique_ptr<Database>> Database::open(const fs::path& file, const OpenOptions& options) {
  return Opening(file, options).run();
}

Status make_project_file(const fs::path& file) {
  const Error exists{ErrorCode::output, "exists already", file.string(),
                     "choose another name, or add model files to it: strake project add"};
  std::error_code failed;
  if (fs::exists(fs::symlink_status(file, failed))) return exists;
  // SQLite would put what it finds there into the new project, and somebody may miss it.
  for (const char* const ending : {"-wal", "-shm", "-journal"})
    if (const fs::path left = beside(file, ending); fs::exists(left, failed))
      return Error{ErrorCode::output, "belongs to another project that lay here", left.string(),
                   "move it to where that project is, or remove it"};
  const Result<std::string> bytes = empty_project();
  if (!bytes) return bytes.error();
  fs::path written = file;
  written += fmt::format(".{}.new", ::getpid());
  if (const Status status = write_file(written, *bytes); !status) {
    Error error = status.error();
    error.where = file.string();
    return error;
  }
  // A link never replaces what somebody else has made meanwhile; a rename would.
  int reason = ::link(written.c_str(), file.c_str()) == 0 ? 0 : errno;
  if (reason == EPERM || reason == EOPNOTSUPP || reason == ENOSYS)
    reason = ::rename(written.c_str(), file.c_str()) == 0 ? 0 : errno;
  ::unlink(written.c_str());
  if (reason == EEXIST) return exists;
  if (reason != 0)
    return Error{ErrorCode::output,
                 "cannot be written: " + std::error_code(reason, std::generic_category()).message(),
                 file.string(), "choose a folder you may write to"};
  return {};
}

}  // namespace strake::project
