// SPDX-License-Identifier: Apache-2.0
#include "project/new_rows/first_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "project/database/result_tables.hpp"
#include "project/new_rows/shown_side.hpp"

namespace strake::project {
namespace {

using clash::Pair;

// Decision 0122 says why rows come so, and what else was tried.

/// Rows of one statement. With 16 a row costs two thirds of what it does alone, since SQLite opens
/// the table and its indices, and what they refer to, once for all of them; with 64 little less.
constexpr std::size_t kRowsAtOnce = 16;
constexpr int kColumnsOfRow = 14;  ///< but the test and the run, which all rows share

/// Returns a statement that adds so many rows, which have no id yet and none that decided.
std::string insert_of(std::size_t count) {
  std::string sql =
      "INSERT INTO clash (test, first_run, new_run, key, a_file, a_id, a_name, b_file, b_id, "
      "b_name, class, d_mm, regions, relation, x_mm, y_mm, z_mm) VALUES ";
  int next = 3;
  for (std::size_t row = 0; row < count; ++row) {
    sql += row == 0 ? "(?1,?2,?2" : ",(?1,?2,?2";
    for (int column = 0; column < kColumnsOfRow; ++column) sql += fmt::format(",?{}", next++);
    sql += ')';
  }
  return sql;
}

/// What a row shows, which has to last until its statement is run.
struct ShownRow {
  ShownRow(const model::Model& model, const Pair& pair, const Hash128& hash)
      : key(clash::key_text(hash)), a(model, pair.a), b(model, pair.b) {}
  std::string key;
  ShownSide a, b;
};

/// Adds the rows of results, a fixed number at a time.
class RowsAtOnce {
 public:
  RowsAtOnce(Database& database, const FirstResults& results, std::span<std::int64_t> rows)
      : database_(database), results_(results), rows_(rows) {}

  /// Adds rows for the results of these numbers.
  Status add(std::span<const std::size_t> numbers) {
    const std::size_t whole = numbers.size() / kRowsAtOnce * kRowsAtOnce;
    if (const Status done = add(numbers.first(whole), kRowsAtOnce); !done) return done;
    return add(numbers.subspan(whole), numbers.size() - whole);
  }

 private:
  Status add(std::span<const std::size_t> numbers, std::size_t at_once) {
    if (numbers.empty()) return {};
    Result<Statement> insert = database_.prepare(insert_of(at_once));
    if (!insert) return insert.error();
    insert->bind(1, results_.test).bind(2, results_.run);
    for (; !numbers.empty(); numbers = numbers.subspan(at_once))
      if (const Status done = run(*insert, numbers.first(at_once)); !done) return done;
    return {};
  }

  Status run(Statement& insert, std::span<const std::size_t> numbers) {
    std::deque<ShownRow> shown;
    int next = 3;
    for (const std::size_t i : numbers) {
      const Pair& pair = results_.report.pairs[i];
      const ShownRow& row = shown.emplace_back(results_.model, pair, results_.keys[i]);
      insert.bind(next++, std::string_view(row.key));
      for (const ShownTexts* const side : {&row.a.texts(), &row.b.texts()})
        for (const std::string_view text : {side->file, side->id, side->name})
          insert.bind(next++, text);
      insert.bind(next++, name(pair.cls));
      insert.bind(next++, pair.d_mm);
      insert.bind(next++, std::int64_t{pair.regions});
      insert.bind(next++, name(pair.relation));
      for (const double mm : {pair.point_mm.x, pair.point_mm.y, pair.point_mm.z})
        insert.bind(next++, mm);
    }
    if (const Status done = insert.run(); !done) return done;
    // A table whose ids are those of rows counts on from its last one.
    std::int64_t row = database_.last_insert_id() - static_cast<std::int64_t>(numbers.size());
    for (const std::size_t i : numbers) rows_[i] = ++row;
    return {};
  }

  Database& database_;
  const FirstResults& results_;
  std::span<std::int64_t> rows_;
};

/// Returns the lower halves of the keys of results, in order.
std::vector<std::uint64_t> sorted_halves(const FirstResults& results,
                                         std::span<const std::size_t> numbers) {
  std::vector<std::uint64_t> halves;
  halves.reserve(numbers.size());
  for (const std::size_t i : numbers) halves.push_back(results.keys[i].low);
  std::ranges::sort(halves);
  return halves;
}

/// Whether a row that is there may have the key of a result: none has, since the name of the test
/// is part of it, but where somebody else wrote that into the project.
Result<bool> may_be_there(Database& database, std::span<const std::uint64_t> halves) {
  Result<Statement> select = database.prepare("SELECT key FROM clash");
  if (!select) return select.error();
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return false;
    const std::optional<Hash128> key = clash::parse_key(select->text(0));
    if (key && std::ranges::binary_search(halves, key->low)) return true;
  }
}

Result<std::int64_t> last_row(Database& database) {
  Result<Statement> select = database.prepare("SELECT coalesce(max(id), 0) FROM clash");
  if (!select) return select.error();
  if (const Result<bool> there = select->step(); !there) return there.error();
  return select->integer(0);
}

}  // namespace

Result<bool> add_first_rows(Database& database, const FirstResults& results,
                            std::span<std::int64_t> rows) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < results.report.pairs.size(); ++i)
    if (results.report.pairs[i].allowed < 0) numbers.push_back(i);
  if (numbers.empty()) return true;
  const Result<std::int64_t> last = last_row(database);
  if (!last) return last.error();
  if (std::cmp_less(numbers.size(), *last)) return false;
  const std::vector<std::uint64_t> halves = sorted_halves(results, numbers);
  if (std::ranges::adjacent_find(halves) != halves.end()) return false;
  const Result<bool> known = may_be_there(database, halves);
  if (!known) return known.error();
  if (*known) return false;
  if (const Status dropped = database.execute(kDropKeyIndex); !dropped) return dropped.error();
  const Status added = RowsAtOnce(database, results, rows).add(numbers);
  if (!added) return added.error();
  if (const Status made = database.execute(kMakeKeyIndex); !made) {
    // Keys of ours are no others': those that were there contradict each other.
    if (made.error().message.find("UNIQUE") != std::string::npos)
      return database.damaged("two clashes have one key");
    return made.error();
  }
  return true;
}

}  // namespace strake::project
