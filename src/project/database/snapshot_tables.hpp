// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace strake::project {

/// What results were computed from, in parts, so that a night on which little changed writes
/// little. Version 4 brought them: of a test that has not run since, `report.snapshot` has all.
inline constexpr const char* kSnapshotTables = R"sql(
CREATE TABLE snapshot_part (        -- hashes of names and contents of 4096 objects
  test INTEGER NOT NULL REFERENCES test(id),
  part INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (test, part)
) STRICT;
)sql";

}  // namespace strake::project
