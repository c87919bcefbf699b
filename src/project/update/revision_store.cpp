// SPDX-License-Identifier: Apache-2.0
#include "project/update/revision_store.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <utility>

#include "core/seeded_hash.hpp"

namespace strake::project {
namespace {

Status store_files_of(Database& database, std::int64_t revision,
                      const std::vector<FileEvent>& files) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO changed_file (revision, what, file, before) VALUES (?1, ?2, ?3, ?4)");
  if (!insert) return insert.error();
  for (const FileEvent& event : files) {
    insert->bind(1, revision).bind(2, event.what).bind(3, std::string_view(event.file));
    if (event.before.empty())
      insert->bind_null(4);
    else
      insert->bind(4, std::string_view(event.before));
    if (const Status status = insert->run(); !status) return status;
  }
  return {};
}

/// Binds where an object was, or nothing where that is where it is.
void bind_before(Statement& insert, const ObjectChange& change) {
  const bool both = change.then != ObjectChange::kNone && change.now != ObjectChange::kNone;
  const auto bind = [&](int parameter, const std::string& before, const std::string& after) {
    if (both && before != after)
      insert.bind(parameter, std::string_view(before));
    else
      insert.bind_null(parameter);
  };
  bind(6, change.before.file, change.after.file);
  bind(7, change.before.id, change.after.id);
}

Status store_objects_of(Database& database, std::int64_t revision, const Changes& changes) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO changed_object (revision, kind, file, object, name, before_file, before_object) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  if (!insert) return insert.error();
  const std::unordered_set<std::string, SeededHash> whole_files = [&] {
    std::unordered_set<std::string, SeededHash> labels(changes.files.only_before.begin(),
                                                       changes.files.only_before.end());
    labels.insert(changes.files.only_after.begin(), changes.files.only_after.end());
    return labels;
  }();
  for (const ObjectChange& change : changes.objects) {
    const ObjectChange::Name& name = change.name();
    if (whole_files.contains(name.file)) continue;
    for (std::size_t k = 0; k < kChangeKinds; ++k) {
      const auto kind = static_cast<ChangeKind>(k);
      if (!change.is(kind)) continue;
      insert->bind(1, revision).bind(2, change_name(kind));
      insert->bind(3, std::string_view(name.file)).bind(4, std::string_view(name.id));
      insert->bind(5, std::string_view(name.name));
      bind_before(*insert, change);
      if (const Status status = insert->run(); !status) return status;
    }
  }
  return {};
}

}  // namespace

Status store_revision(Database& database, Revision& revision, const std::vector<FileEvent>& files,
                      const Changes& changes) {
  Result<Statement> insert = database.prepare(
      "INSERT INTO revision (at, what, added, removed, moved, reshaped, reattributed, renamed, "
      "unchanged) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)");
  if (!insert) return insert.error();
  insert->bind(1, std::string_view(revision.when)).bind(2, std::string_view(revision.what));
  int parameter = 3;
  for (const std::uint64_t count : revision.counts)
    insert->bind(parameter++, static_cast<std::int64_t>(count));
  insert->bind(parameter, static_cast<std::int64_t>(revision.unchanged));
  if (const Status status = insert->run(); !status) return status;
  revision.id = database.last_insert_id();
  if (const Status status = store_files_of(database, revision.id, files); !status) return status;
  return store_objects_of(database, revision.id, changes);
}

Result<std::vector<Revision>> revisions(Project& project) {
  Result<Statement> rows = project.database().prepare(
      "SELECT id, at, what, added, removed, moved, reshaped, reattributed, renamed, unchanged "
      "FROM revision ORDER BY id DESC");
  if (!rows) return rows.error();
  std::vector<Revision> found;
  for (;;) {
    const Result<bool> more = rows->step();
    if (!more) return more.error();
    if (!*more) return found;
    Revision revision;
    revision.id = rows->integer(0);
    revision.when = rows->text(1);
    revision.what = rows->text(2);
    int column = 3;
    for (std::uint64_t& count : revision.counts)
      count = static_cast<std::uint64_t>(rows->integer(column++));
    revision.unchanged = static_cast<std::uint64_t>(rows->integer(column));
    found.push_back(std::move(revision));
  }
}

}  // namespace strake::project
