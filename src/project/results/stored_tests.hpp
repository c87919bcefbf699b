// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "project/database/database.hpp"
#include "project/snapshot/snapshot.hpp"
#include "project/snapshot/stored_snapshot.hpp"
#include "project/stored_report/report_codec.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// What a project remembers of a test: its last result, and what that was computed from.
struct StoredTest {
  std::int64_t id = 0;
  std::int64_t run = 0;  ///< the last one
  std::string name;
  Snapshot snapshot;
  std::vector<Hash128> snapshot_parts;  ///< StoredSnapshot::parts
  bool parts_have_elements = false;     ///< whether these have StoredSnapshot::elements
  RememberedReport results;
};

/// Returns the names of the tests that were run, in the order of their first runs.
[[nodiscard]] Result<std::vector<std::string>> test_names(Database& database);
/// Returns the names of the tests of the last run, in its order.
[[nodiscard]] Result<std::vector<std::string>> last_tests(Database& database);

/// A test and its last run.
struct TestRow {
  std::int64_t id = 0, run = 0;
  bool is_new = false;  ///< no run before this one ran it
};
/// Returns nothing where the test was never run.
[[nodiscard]] Result<std::optional<TestRow>> find_test(Database& database, const std::string& name);

/// Returns what the last result of a test was computed from; nothing where it was never run.
[[nodiscard]] Result<std::optional<StoredSnapshot>> find_snapshot(Database& database,
                                                                  const std::string& test);

/// Reads a test; nothing where it was never run. Errors: input for a damaged project, cancelled.
[[nodiscard]] Result<std::optional<StoredTest>> read_test(Database& database,
                                                          const std::string& name,
                                                          const parallel::Context& context);

/// Returns the objects of the model that a test ran over last, as decode_names() has them; nothing
/// where no version of the program that keeps them ran it. Errors: input for a damaged project.
[[nodiscard]] Result<std::optional<model::Model>> read_test_objects(Database& database,
                                                                    const StoredTest& test);

/// Writes the objects of the model that a test ran over, where other ones are stored. With
/// `are_known` those that are stored, if any are, are known to be the same.
[[nodiscard]] Status write_test_objects(Database& database, std::int64_t test,
                                        const model::Model& model, bool are_known);

/// What is to be written of a test.
struct TestToWrite {
  std::int64_t id = 0, run = 0;
  std::string settings;  ///< for people
  const Snapshot& snapshot;
  ReportRows results;
  bool is_unchanged = false;  ///< the report is the one that is stored
  /// What the run did to the results that are stored; null: they are to be compared.
  const clash::PairChanges* changes = nullptr;
};

/// Writes a test over `before`, which is null where there is none: of the parts of its report those
/// that differ. The row is there already.
[[nodiscard]] Status write_test(Database& database, const TestToWrite& test,
                                const StoredTest* before, const parallel::Context& context);

}  // namespace strake::project
