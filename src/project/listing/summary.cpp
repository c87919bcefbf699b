// SPDX-License-Identifier: Apache-2.0
#include "strake/project/summary.hpp"

#include <string_view>
#include <utility>

#include "project/database/database.hpp"

namespace strake::project {
namespace {

/// Reads the number that a query gives.
Status read_count(Database& database, std::string_view sql, std::uint64_t& count) {
  Result<Statement> row = database.prepare(sql);
  if (!row) return row.error();
  const Result<bool> found = row->step();
  if (!found) return found.error();
  if (*found) count = static_cast<std::uint64_t>(row->integer(0));
  return {};
}

}  // namespace

Result<Summary> summary(Project& project) {
  Summary summary;
  Result<std::vector<StoredFile>> files = project.files();
  if (!files) return files.error();
  summary.files = std::move(*files);
  for (const StoredFile& file : summary.files) {
    summary.objects += file.objects;
    summary.bodies += file.bodies;
  }
  Result<std::vector<Revision>> known = revisions(project);
  if (!known) return known.error();
  summary.revisions = known->size();
  if (!known->empty()) summary.last_revision = std::move(known->front());
  std::uint64_t version = 0;
  for (const auto& [sql, count] :
       {std::pair("PRAGMA user_version", &version),
        std::pair("SELECT page_count * page_size FROM pragma_page_count, pragma_page_size",
                  &summary.bytes),
        std::pair("SELECT count(*) FROM test", &summary.tests),
        std::pair("SELECT count(*) FROM run", &summary.runs),
        std::pair("SELECT count(*) FROM clash", &summary.clashes),
        std::pair("SELECT count(*) FROM view", &summary.views)})
    if (Status status = read_count(project.database(), sql, *count); !status) return status.error();
  summary.schema_version = static_cast<std::int64_t>(version);
  return summary;
}

}  // namespace strake::project
