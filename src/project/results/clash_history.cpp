// SPDX-License-Identifier: Apache-2.0
#include "project/results/clash_history.hpp"

#include <string_view>
#include <utility>

namespace strake::project {
namespace {

std::string_view sight_of(const ClashRow& row) {
  if (row.gone_run) return "gone";
  return row.unknown.empty() ? "found" : "cannot tell";
}

void bind_count(Statement& statement, int parameter, const std::optional<std::int64_t>& count) {
  if (count)
    statement.bind(parameter, *count);
  else
    statement.bind_null(parameter);
}

}  // namespace

ClashHistory::ClashHistory(Statement former, Statement find, Statement put, Statement remove)
    : former_(std::move(former)),
      find_(std::move(find)),
      put_(std::move(put)),
      remove_(std::move(remove)) {}

Result<ClashHistory> ClashHistory::of(Database& database) {
  Result<Statement> former = database.prepare(
      "INSERT INTO former (clash, run, sight, class, d_mm, regions, why) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  if (!former) return former.error();
  Result<Statement> find = database.prepare("SELECT a_open, b_open FROM unseen WHERE clash = ?1");
  if (!find) return find.error();
  Result<Statement> put =
      database.prepare("INSERT OR REPLACE INTO unseen (clash, a_open, b_open) VALUES (?1, ?2, ?3)");
  if (!put) return put.error();
  Result<Statement> remove = database.prepare("DELETE FROM unseen WHERE clash = ?1");
  if (!remove) return remove.error();
  return ClashHistory(std::move(*former), std::move(*find), std::move(*put), std::move(*remove));
}

Status ClashHistory::add_former(const ClashRow& before, std::int64_t run) {
  former_.bind(1, before.id).bind(2, run).bind(3, sight_of(before)).bind(4, name(before.now.cls));
  former_.bind(5, before.now.d_mm).bind(6, std::int64_t{before.now.regions});
  if (before.unknown.empty())
    former_.bind_null(7);
  else
    former_.bind(7, std::string_view(before.unknown));
  return former_.run();
}

Result<std::optional<OpenParts>> ClashHistory::unseen(std::int64_t clash) {
  const Result<bool> there = find_.bind(1, clash).step();
  if (!there) return there.error();
  std::optional<OpenParts> parts;
  if (*there) {
    parts.emplace();
    if (!find_.is_null(0)) parts->a = find_.integer(0);
    if (!find_.is_null(1)) parts->b = find_.integer(1);
  }
  find_.reset();
  return parts;
}

Status ClashHistory::set_unseen(std::int64_t clash, const OpenParts& parts) {
  put_.bind(1, clash);
  bind_count(put_, 2, parts.a);
  bind_count(put_, 3, parts.b);
  return put_.run();
}

Status ClashHistory::remove_unseen(std::int64_t clash) { return remove_.bind(1, clash).run(); }

}  // namespace strake::project
