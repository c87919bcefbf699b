// SPDX-License-Identifier: Apache-2.0
#include <sqlite3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "project/database/database.hpp"

namespace strake::project {
namespace {

/// SQLite takes null for NULL, though an empty text or blob may well lie nowhere.
constexpr const char* kNowhere = "";

using HashBytes = std::array<std::byte, 16>;

/// The digits of hex() are those of Hash128::text().
HashBytes to_bytes(const Hash128& hash) {
  HashBytes bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint64_t word = i < bytes.size() / 2 ? hash.high : hash.low;
    bytes[i] = static_cast<std::byte>(word >> (56 - 8 * (i % 8)) & 0xffU);
  }
  return bytes;
}

}  // namespace

Statement::Statement(Database& database, sqlite3_stmt* statement)
    : database_(&database), statement_(statement) {}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement::Statement(Statement&& other) noexcept
    : database_(other.database_),
      statement_(std::exchange(other.statement_, nullptr)),
      fault_(other.fault_) {}

Statement& Statement::operator=(Statement&& other) noexcept {
  if (this == &other) return *this;
  sqlite3_finalize(statement_);
  database_ = other.database_;
  statement_ = std::exchange(other.statement_, nullptr);
  fault_ = other.fault_;
  return *this;
}

Statement& Statement::bound(int code) {
  if (fault_ == SQLITE_OK) fault_ = code;
  return *this;
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  return bound(sqlite3_bind_int64(statement_, parameter, value));
}

Statement& Statement::bind(int parameter, double value) {
  return bound(sqlite3_bind_double(statement_, parameter, value));
}

Statement& Statement::bind(int parameter, std::string_view text) {
  return bound(sqlite3_bind_text64(statement_, parameter,
                                   text.data() == nullptr ? kNowhere : text.data(), text.size(),
                                   SQLITE_STATIC, SQLITE_UTF8));
}

Statement& Statement::bind(int parameter, std::span<const std::byte> bytes) {
  const void* const from =
      bytes.data() == nullptr ? static_cast<const void*>(kNowhere) : bytes.data();
  return bound(sqlite3_bind_blob64(statement_, parameter, from, bytes.size(), SQLITE_STATIC));
}

Statement& Statement::bind(int parameter, const Hash128& hash) {
  const HashBytes bytes = to_bytes(hash);
  return bound(
      sqlite3_bind_blob64(statement_, parameter, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
}

Statement& Statement::bind_null(int parameter) {
  return bound(sqlite3_bind_null(statement_, parameter));
}

Result<bool> Statement::step() {
  if (fault_ != SQLITE_OK) return database_->error(fault_);
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return database_->error(code);
}

Status Statement::run() {
  const Result<bool> row = step();
  reset();
  if (!row) return row.error();
  return {};
}

void Statement::reset() {
  sqlite3_reset(statement_);
  fault_ = SQLITE_OK;
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const { return sqlite3_column_double(statement_, column); }

std::string_view Statement::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (text == nullptr) return {};
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::span<const std::byte> Statement::bytes(int column) const {
  const auto* const first = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  if (first == nullptr) return {};
  return {first, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::optional<Hash128> Statement::hash(int column) const {
  if (sqlite3_column_type(statement_, column) != SQLITE_BLOB) return std::nullopt;
  const std::span<const std::byte> found = bytes(column);
  if (found.size() != std::tuple_size_v<HashBytes>) return std::nullopt;
  Hash128 hash;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::uint64_t& word = i < found.size() / 2 ? hash.high : hash.low;
    word = word << 8U | std::to_integer<std::uint64_t>(found[i]);
  }
  return hash;
}

}  // namespace strake::project
