// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/project/project.hpp"

struct sqlite3;
struct sqlite3_stmt;

/// SQLite behind values that close themselves, with our errors.
namespace strake::project {

/// One prepared statement. Parameters count from 1, columns from 0. A fault of binding is told by
/// the next step.
class Statement {
 public:
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement& operator=(Statement&& other) noexcept;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  /// The text or bytes must last until the statement is reset.
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::span<const std::byte> bytes);
  Statement& bind(int parameter, const Hash128& hash);  ///< as a blob of 16 bytes
  Statement& bind_null(int parameter);

  /// Goes to the next row; false where there is none.
  [[nodiscard]] Result<bool> step();
  /// Runs a statement that has no rows, and resets it.
  [[nodiscard]] Status run();
  void reset();

  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;
  /// Text and bytes last until the next step or reset.
  [[nodiscard]] std::string_view text(int column) const;
  [[nodiscard]] std::span<const std::byte> bytes(int column) const;
  /// Returns nothing where the column is no blob of 16 bytes.
  [[nodiscard]] std::optional<Hash128> hash(int column) const;

 private:
  friend class Database;
  Statement(Database& database, sqlite3_stmt* statement);
  Statement& bound(int code);
  Database* database_ = nullptr;
  sqlite3_stmt* statement_ = nullptr;
  int fault_ = 0;
};

/// A connection, whose tables are known to be those of a project of this version.
class Database {
 public:
  /// Opens a project. Older versions are brought up to this one, for which they must be writable.
  /// Errors: those of Project::open().
  [[nodiscard]] static Result<std::unique_ptr<Database>> open(const std::filesystem::path& file,
                                                              const OpenOptions& options);
  /// Returns a database in memory, without tables. Errors: memory.
  [[nodiscard]] static Result<std::unique_ptr<Database>> in_memory();
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  Database(Database&&) = delete;
  Database& operator=(Database&&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// Returns how long a transaction waits for another process that writes.
  [[nodiscard]] std::chrono::milliseconds wait() const {
    return std::chrono::milliseconds(wait_ms_);
  }
  [[nodiscard]] Result<Statement> prepare(std::string_view sql);
  /// Runs statements without parameters or rows.
  [[nodiscard]] Status execute(std::string_view sql);
  /// Runs statements that write into the table of tables, sqlite_schema, which all others must not.
  [[nodiscard]] Status rewrite_schema(std::string_view sql);
  [[nodiscard]] std::int64_t last_insert_id() const;
  [[nodiscard]] std::int64_t changes() const;
  /// Returns the error for what SQLite said last: it names the file, and how to mend it.
  [[nodiscard]] Error error(int code) const;
  /// Returns the error for another process that writes.
  [[nodiscard]] Error busy() const;
  /// Returns the error for something in the tables that no version of the program has stored.
  [[nodiscard]] Error damaged(std::string_view what) const;
  /// Returns the bytes of a file with the same contents. Errors: memory.
  [[nodiscard]] Result<std::string> serialized() const;
  /// Whether what was read is of one moment, where SQLite cannot see to it: on read-only media,
  /// which somebody else may still write to. Errors: input.
  [[nodiscard]] Status check_unchanged() const;
  /// Whether the file is still where it was opened: what is written to one that was moved, deleted
  /// or replaced, nobody finds again. Errors: output.
  [[nodiscard]] Status check_in_place();
  /// Whether the file ends with a whole page. SQLite takes what a last page lacks for zeros and
  /// says nothing. Errors: input.
  [[nodiscard]] Status check_end();

 private:
  friend class Statement;
  friend class Transaction;
  friend class ReadScope;
  friend class Opening;
  Database() = default;
  sqlite3* handle_ = nullptr;
  std::filesystem::path file_;
  Access access_ = Access::write;
  int wait_ms_ = 0;
  /// Size and time of change of a file that is read as if nobody wrote to it.
  std::optional<std::pair<std::int64_t, std::int64_t>> immutable_;
};

/// Returns the parts of a test in their order, of a table with the columns test, part and data.
/// Errors: input where one is missing; `what` is what they are parts of.
[[nodiscard]] Result<std::vector<std::vector<std::byte>>> read_parts(Database& database,
                                                                     const char* table,
                                                                     std::int64_t test,
                                                                     const std::string& what);

/// Reads of one moment, unless a transaction sees to that already.
class ReadScope {
 public:
  [[nodiscard]] static Result<ReadScope> begin(Database& database);
  ~ReadScope();
  ReadScope(ReadScope&& other) noexcept;
  ReadScope& operator=(ReadScope&&) = delete;
  ReadScope(const ReadScope&) = delete;
  ReadScope& operator=(const ReadScope&) = delete;

 private:
  explicit ReadScope(Database* database) : database_(database) {}
  Database* database_ = nullptr;  ///< null: somebody else's transaction
};

/// All that is written between begin() and commit(), or nothing of it.
class Transaction {
 public:
  /// Errors: that another process writes (after the connection's time to wait), that the project
  /// is open for reading only, or that it is on read-only media. `min_wait_ms`: it waits so long
  /// even where the connection would not.
  [[nodiscard]] static Result<Transaction> begin(Database& database, int min_wait_ms = 0);
  /// The same without waiting: nothing where another process writes.
  [[nodiscard]] static Result<std::optional<Transaction>> begin_at_once(Database& database);
  ~Transaction();
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  [[nodiscard]] Status commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_ = nullptr;
};

}  // namespace strake::project
