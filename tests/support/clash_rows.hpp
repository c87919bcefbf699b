// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>

#include "project/database/database.hpp"
#include "project/database/exchange_tables.hpp"
#include "project/database/history_tables.hpp"
#include "project/database/result_tables.hpp"
#include "project/database/view_tables.hpp"

namespace strake::test {

/// Returns the key of a clash of project_with_clashes().
inline std::string clash_key(int number) {
  std::string key = std::to_string(number);
  return std::string(26 - key.size(), '0') + key;
}

/// A run that finds nothing else than before.
inline void add_run(project::Database& database, int number) {
  const std::string id = std::to_string(number);
  EXPECT_TRUE(database.execute("INSERT INTO run VALUES (" + id +
                               ", '2026-01-01T00:00:00Z', '1', 'night', 1)"));
  EXPECT_TRUE(database.execute("UPDATE test SET run = " + id));
}

/// A project in memory of which run 1 found clashes.
inline std::unique_ptr<project::Database> project_with_clashes(int count) {
  std::unique_ptr<project::Database> database = std::move(project::Database::in_memory()).value();
  for (const std::string_view tables :
       {std::string_view(project::kResultTables), std::string_view(project::kViewTables),
        std::string_view(project::kHistoryTables), std::string_view(project::kExchangeTables)})
    EXPECT_TRUE(database->execute(tables));
  EXPECT_TRUE(database->execute(
      "INSERT INTO run VALUES (1, '2026-01-01T00:00:00Z', '1', 'night', 1);"
      "INSERT INTO test (id, name, settings, run, objects) VALUES (1, '', '', 1, 2)"));
  for (int i = 0; i < count; ++i)
    EXPECT_TRUE(database->execute(
        "INSERT INTO clash (id, key, test, a_file, a_id, a_name, b_file, b_id, b_name, class, "
        "relation, d_mm, x_mm, y_mm, z_mm, regions, first_run, new_run) VALUES (" +
        std::to_string(i + 1) + ", '" + clash_key(i) +
        "', 1, 'f', 'a', 'a', 'f', 'b', 'b', 'HIT', 'INTERFERE', -1, 0, 0, 0, 1, 1, 1)"));
  return database;
}

}  // namespace strake::test
