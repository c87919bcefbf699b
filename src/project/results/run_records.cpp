// SPDX-License-Identifier: Apache-2.0
#include "project/results/run_records.hpp"

#include <string_view>
#include <utility>

namespace strake::project {

Status write_run_record(Database& database, std::int64_t run, const RunRecord& record) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO run_report (run, rules_file, rules_hash, rules_profile, group_by, "
      "group_distance, group_contacts, classes, sort, last_event) VALUES "
      "(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, (SELECT coalesce(max(id), 0) FROM event))");
  if (!insert) return insert.error();
  insert->bind(1, run);
  if (record.rules) {
    insert->bind(2, std::string_view(record.rules->file)).bind(3, record.rules->hash);
    insert->bind(4, std::string_view(record.rules->profile));
  } else {
    for (const int column : {2, 3, 4}) insert->bind_null(column);
  }
  const RunGrouping& grouping = record.grouping;
  insert->bind(5, std::string_view(grouping.by)).bind(6, std::string_view(grouping.distance));
  insert->bind(7, std::int64_t{grouping.contacts ? 1 : 0});
  insert->bind(8, std::string_view(grouping.classes)).bind(9, std::string_view(grouping.sort));
  return insert->run();
}

Status write_run_result(Database& database, std::int64_t run, const RunResult& result) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO run_result (run, test, settings, hash) VALUES (?1, ?2, ?3, ?4)");
  if (!insert) return insert.error();
  insert->bind(1, run).bind(2, result.test).bind(3, std::string_view(result.settings));
  return insert->bind(4, std::string_view(result.hash)).run();
}

Result<std::optional<RunRecord>> read_run_record(Database& database, std::int64_t run) {
  Result<Statement> select = database.prepare(
      "SELECT rules_file, rules_hash, rules_profile, group_by, group_distance, group_contacts, "
      "classes, sort, last_event FROM run_report WHERE run = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, run).step();
  if (!there) return there.error();
  if (!*there) return std::optional<RunRecord>();
  RunRecord record;
  if (!select->is_null(0)) {
    const std::optional<Hash128> hash = select->hash(1);
    if (!hash) return database.damaged("a run has rules without a hash");
    record.rules = {std::string(select->text(0)), *hash, std::string(select->text(2))};
  }
  record.grouping = {std::string(select->text(3)), std::string(select->text(4)),
                     std::string(select->text(6)), std::string(select->text(7)),
                     select->integer(5) != 0};
  record.last_event = select->integer(8);
  return std::optional(std::move(record));
}

Result<std::vector<RunResult>> read_run_results(Database& database, std::int64_t run) {
  Result<Statement> select = database.prepare(
      "SELECT test.id, test.name, run_result.settings, run_result.hash FROM run_result JOIN test "
      "ON test.id = run_result.test WHERE run_result.run = ?1 ORDER BY test.id");
  if (!select) return select.error();
  select->bind(1, run);
  std::vector<RunResult> results;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return results;
    results.push_back({select->integer(0), std::string(select->text(1)),
                       std::string(select->text(2)), std::string(select->text(3))});
  }
}

Result<std::optional<std::int64_t>> last_run(Database& database) {
  Result<Statement> select = database.prepare("SELECT max(id) FROM run");
  if (!select) return select.error();
  const Result<bool> there = select->step();
  if (!there) return there.error();
  if (!*there || select->is_null(0)) return std::optional<std::int64_t>();
  return std::optional(select->integer(0));
}

}  // namespace strake::project
